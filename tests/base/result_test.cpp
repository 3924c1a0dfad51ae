#include "base/result.h"

#include <gtest/gtest.h>

#include <memory>

namespace orthonav {
namespace {

TEST(Result, HoldsAValueOrAnError) {
  const Result<int> value = 7;
  EXPECT_TRUE(value.ok());
  EXPECT_EQ(*value, 7);
  const Result<int> error = Error{"width 3 px, limit 4 px"};
  EXPECT_FALSE(error.ok());
  EXPECT_FALSE(static_cast<bool>(error));
  EXPECT_EQ(error.error().message, "width 3 px, limit 4 px");
}

TEST(Result, MovesItsValueOut) {
  Result<std::unique_ptr<int>> made = std::make_unique<int>(3);
  const std::unique_ptr<int> taken = *std::move(made);
  EXPECT_EQ(*taken, 3);
}

TEST(Result, TellsAnErrorFromAValueOfTheSameText) {
  const Result<std::string> value = std::string("text");
  EXPECT_TRUE(value.ok());
  const Result<std::string> error = Error{"text"};
  EXPECT_FALSE(error.ok());
}

TEST(Result, CarriesACodeToBranchOn) {
  const Result<int> error = Error{"scan.stl: no such file", ErrorCode::kNotFound};
  EXPECT_EQ(error.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(Error{"width 3 px, limit 4 px"}.code, ErrorCode::kInvalid);
}

// Also in release builds an absent value is never read.
TEST(ResultDeathTest, EndsTheProgramWhereTheAbsentSideIsRead) {
  const Result<int> error = Error{"width 3 px, limit 4 px"};
  const Result<int> value = 7;
  const Status done;
  EXPECT_DEATH(static_cast<void>(*error), "internal error: .* does not hold .*base/result.h:");
  EXPECT_DEATH(static_cast<void>(value.error()), "internal error");
  EXPECT_DEATH(static_cast<void>(done.error()), "internal error");
}

TEST(Status, IsSuccessUnlessMadeOfAnError) {
  EXPECT_TRUE(Status{}.ok());
  const Status failed = Error{"disk full"};
  EXPECT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().message, "disk full");
}

}  // namespace
}  // namespace orthonav
