#pragma once
// The text of the Error that an action throws; a remark when it throws none.
#include <string>

#include "sculpt/base/error.hpp"

namespace sculpt {

template <class Act>
std::string message_of(Act&& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace sculpt
