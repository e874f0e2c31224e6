// main() of all test programs: starts MPI, runs the tests on every rank, and fails when they fail on any
// rank. Rank 0 speaks as GoogleTest does; the other ranks print their failures only, with their rank.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <memory>

#include "sculpt/par/comm.hpp"

namespace sculpt::test {
namespace {

class FailuresOnly : public testing::EmptyTestEventListener {
 public:
  explicit FailuresOnly(int rank) : rank_(rank) {}

 private:
  void OnTestStart(const testing::TestInfo& info) override {
    name_ = fmt::format("{}.{}", info.test_suite_name(), info.name());
  }
  void OnTestPartResult(const testing::TestPartResult& result) override {
    if (!result.failed()) return;
    fmt::print("[rank {}] {}: {}:{}: {}\n", rank_, name_,
               result.file_name() != nullptr ? result.file_name() : "unknown file", result.line_number(),
               result.message());
    std::fflush(stdout);
  }

  int rank_;
  std::string name_;
};

int run_on_all_ranks(const Comm& comm) {
  if (comm.rank() != 0) {
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new FailuresOnly(comm.rank()));
  }
  if (comm.size() == 1) return RUN_ALL_TESTS();
  // An exception that no test expects would leave the other ranks waiting.
  testing::GTEST_FLAG(catch_exceptions) = false;
  try {
    return static_cast<int>(comm.max(std::int64_t{RUN_ALL_TESTS()}));
  } catch (...) {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    fmt::print("[rank {}] {}: unexpected exception: {}\n", comm.rank(), test != nullptr ? test->name() : "",
               current_exception_text());
    std::fflush(stdout);
    MPI_Abort(comm.handle(), 1);
    return 1;
  }
}

}  // namespace
}  // namespace sculpt::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const sculpt::MpiSession session(argc, argv);
  return sculpt::test::run_on_all_ranks(sculpt::Comm::world());
}
