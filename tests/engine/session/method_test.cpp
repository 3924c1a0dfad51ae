#include "engine/session/method.h"

#include <gmock/gmock.h>

namespace orthonav::engine::method_test {
namespace {

using ::testing::HasSubstr;

TEST(Method, AnUnknownOneIsRefusedInOneLine) {
  EXPECT_TRUE(method_named("best").ok());
  const auto other = method_named("fastest");
  ASSERT_FALSE(other.ok());
  EXPECT_THAT(other.error().message, HasSubstr("available: best, paper"));
  EXPECT_THAT(registrar_named("fastest").error().message, HasSubstr("available: best, paper"));
  EXPECT_TRUE(registrar_named("best").ok());
  EXPECT_TRUE(registrar_named("paper").ok());
  EXPECT_TRUE(method_named("paper").ok());
  EXPECT_FALSE(method_named("Paper ").ok());
}

TEST(Method, OnlyThePublishedOneIsVerifiedByEyeAlone) {
  EXPECT_EQ(method_named("best")->verification, Verification::kByTouch);
  EXPECT_EQ(method_named("paper")->verification, Verification::kByEye);
  EXPECT_EQ(Method{}.verification, Verification::kByTouch) << "nobody forgets it";
  EXPECT_TRUE(method_named("best")->coaching);
  EXPECT_FALSE(method_named("paper")->coaching);
}

}  // namespace
}  // namespace orthonav::engine::method_test
