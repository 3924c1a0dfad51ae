#include "hal/hl2ss/depth_calibration.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "tests/hal/hl2ss/ahat_answer.h"

namespace orthonav::hl2ss::depth_parser_test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

std::string refusal_with(std::size_t at, float value) {
  auto answer = ahat_answer();
  std::memcpy(answer.data() + at, &value, sizeof(value));
  const auto read = read_depth_calibration(DepthStream::kAhat, answer);
  return read ? "accepted" : read.error().message;
}

TEST(DepthCalibration, IsRefusedWhereANumberCannotBe) {
  constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal_with(kScaleAt, 1000.0F), "accepted");
  EXPECT_THAT(refusal_with(kScaleAt, 0.0F), HasSubstr("scale 0, must lie in [100, 100000]"));
  EXPECT_THAT(refusal_with(kScaleAt, kNotANumber), HasSubstr("scale nan"));
  EXPECT_THAT(refusal_with(kScaleAt, -1000.0F), HasSubstr("scale -1000"));
  EXPECT_THAT(refusal_with(kAliasAt, 0.0F), HasSubstr("alias 0, must be positive"));
  EXPECT_THAT(refusal_with(kAliasAt, kNotANumber), HasSubstr("alias nan"));
  EXPECT_THAT(refusal_with(kExtrinsicsAt, kNotANumber), HasSubstr("extrinsics"));
  EXPECT_THAT(refusal_with(kExtrinsicsAt, 2.0F), HasSubstr("extrinsics"));
}

TEST(DepthCalibration, OfTheWrongSizeIsRefused) {
  auto answer = ahat_answer();
  ASSERT_THAT(answer, SizeIs(depth_calibration_bytes(DepthStream::kAhat)));
  answer.pop_back();
  const auto read = read_depth_calibration(DepthStream::kAhat, answer);
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().message, HasSubstr("bytes, must be 4194392"));
  EXPECT_FALSE(read_depth_calibration(DepthStream::kLongThrow, ahat_answer()).ok());
}

/// A NaN pixel has no direction, and neither have those whose centre needs it; if all are NaN,
/// there is no camera.
TEST(DepthCalibration, WithoutDirectionsIsNoCamera) {
  auto answer = ahat_answer();
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  const std::size_t middle = std::size_t{4} * (256 * 512 + 256);
  std::memcpy(answer.data() + middle, &nothing, sizeof(nothing));
  const auto holed = read_depth_calibration(DepthStream::kAhat, answer);
  ASSERT_TRUE(holed.ok()) << holed.error().message;
  EXPECT_EQ(holed->camera.rays[256 * 512 + 256][2], 0.0F);
  EXPECT_GT(holed->camera.rays[260 * 512 + 260][2], 0.0F);
  std::fill_n(answer.begin(), kExtrinsicsAt, std::uint8_t{0xff});
  const auto none = read_depth_calibration(DepthStream::kAhat, answer);
  ASSERT_FALSE(none.ok());
  EXPECT_THAT(none.error().message, HasSubstr("no pixel has a direction"));
}

}  // namespace
}  // namespace orthonav::hl2ss::depth_parser_test
