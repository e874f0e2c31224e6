#include <gtest/gtest.h>

#include "sculpt/base/error.hpp"
#include "sculpt/base/log.hpp"
#include "sculpt/base/vec3.hpp"

namespace sculpt {
namespace {

TEST(Vec3, Products) {
  const Vec3 a{1, 2, 3}, b{4, -5, 6};
  EXPECT_EQ(dot(a, b), 12);
  EXPECT_EQ(cross(a, b), (Vec3{27, 6, -13}));
  EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(scaled(a, b), (Vec3{4, -10, 18}));
  EXPECT_EQ(norm(Vec3{2, -3, 6}), 7);
  EXPECT_EQ(largest(b), 6);
  EXPECT_EQ(largest(Vec3{1, -7, 6}), 7);
}

TEST(Vec3, IsIndexedByAxis) {
  Vec3 a{1, 2, 3};
  a[1] = 7;
  EXPECT_EQ(a, (Vec3{1, 7, 3}));
  EXPECT_EQ(a[2], 3);
}

TEST(Vec3, UnitOfNothingIsNothing) {
  EXPECT_EQ(unit(Vec3{}), Vec3{});
  EXPECT_EQ(unit(Vec3{0, -4, 0}), (Vec3{0, -1, 0}));
  EXPECT_EQ(unit(Vec3{0, 0, 1e-200}), Vec3{}) << "its square has no place in a double";
}

TEST(Check, TellsWhichPromiseBroke) {
  EXPECT_NO_THROW(check(true, "fine"));
  try {
    check(false, "water flows uphill");
    FAIL();
  } catch (const BrokenPromise& e) {
    EXPECT_STREQ(e.what(), "internal error: water flows uphill");
  }
}

TEST(Log, SpeaksOnlyWhenItMay) {
  testing::internal::CaptureStdout();
  Log(true).line("{} of {}", 1, 2);
  Log(true).line();
  Log(false).line("nothing");
  Log().line("nothing");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "1 of 2\n\n");
}

}  // namespace
}  // namespace sculpt
