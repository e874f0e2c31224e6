#include "adapt/template_store.hpp"

#include <unordered_map>

#include "sculpt/base/error.hpp"

namespace sculpt {
namespace {

const BlockTemplate* stored(BlockPattern pattern, unsigned ends) {
  static std::unordered_map<std::uint32_t, std::unique_ptr<const BlockTemplate>> store;
  const auto [entry, is_new] = store.try_emplace(pattern | ends << kBlockNeighbours);
  if (is_new) entry->second = block_template(pattern, ends);
  return entry->second.get();
}

}  // namespace

bool transition_exists(BlockPattern pattern, unsigned ends) { return stored(pattern, ends) != nullptr; }

const BlockTemplate& transition(BlockPattern pattern, unsigned ends) {
  const BlockTemplate* t = stored(pattern, ends);
  check(t != nullptr, "a block without a valid transition");
  return *t;
}

}  // namespace sculpt
