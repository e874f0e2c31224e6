#include "sculpt/pipeline/stages.hpp"

#include <gtest/gtest.h>

#include <regex>

namespace sculpt {
namespace {

std::string printed(const Stages& stages, std::int64_t hexes) {
  testing::internal::CaptureStdout();
  stages.print(Comm::self(), Log(true), hexes);
  return testing::internal::GetCapturedStdout();
}

TEST(Stages, PrintsALinePerStageAndTheTotal) {
  Stages stages;
  stages.end("read input");
  stages.end("smooth volume");
  const std::string text = printed(stages, 1000);
  EXPECT_TRUE(std::regex_search(text, std::regex("  read input +0\\.\\d{3} +[0-9.]+% +[0-9.]+ +[0-9.]+\n")))
      << text;
  EXPECT_LT(text.find("read input"), text.find("smooth volume"));
  EXPECT_TRUE(std::regex_search(text, std::regex("Total +0\\.\\d{3} +\\d+ hexes/s/rank, \\d+ bytes/hex")))
      << text;
}

TEST(Stages, OfAnEmptyMeshHaveNoRates) {
  Stages stages;
  stages.end("read input");
  EXPECT_EQ(printed(stages, 0).find("bytes/hex"), std::string::npos);
  EXPECT_GE(stages.seconds(), 0);
}

TEST(Stages, AreSilentWhenTheLogIs) {
  Stages stages;
  stages.end("read input");
  testing::internal::CaptureStdout();
  stages.print(Comm::self(), Log(false), 10);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace sculpt
