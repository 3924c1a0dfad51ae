#include "hal/hl2ss/depth_format.h"

#include <gmock/gmock.h>

#include "base/random.h"
#include "hal/hl2ss/depth_calibration.h"
#include "hal/hl2ss/png_decoder.h"
#include "hal/hl2ss/server/depth_bytes.h"

namespace orthonav::hl2ss::depth_parser_test {
namespace {

using ::testing::HasSubstr;

TEST(DepthRanges, AreMillimetresAndNothingWhereNothingWasMeasured) {
  DepthDescription camera;
  camera.camera.stream = DepthStream::kAhat;
  camera.units_per_m = 2000.0;
  const auto ahat = millimetres_of(camera);
  EXPECT_EQ(ahat[0], 0);
  EXPECT_EQ(ahat[4000], 2000);
  EXPECT_EQ(ahat[4089], 2045);
  EXPECT_EQ(ahat[4090], 0);
  EXPECT_EQ(ahat[65535], 0);
  camera.camera.stream = DepthStream::kLongThrow;
  camera.units_per_m = 500.0;
  const auto long_throw = millimetres_of(camera);
  EXPECT_EQ(long_throw[4090], 8180);
  EXPECT_EQ(long_throw[65535], 0) << "no 16 bits of millimetres";
}

TEST(DepthPayload, WhoseSizesContradictIsRefused) {
  const auto split = [](std::uint32_t depth, std::uint32_t rest, std::size_t bytes) {
    std::vector<std::uint8_t> payload;
    append(payload, depth);
    append(payload, rest);
    payload.resize(payload.size() + bytes + 8);
    const auto picture = split_depth(DepthStream::kAhat, payload);
    return !picture ? picture.error().message
                    : (*picture ? std::to_string((*picture)->size()) : "nothing");
  };
  EXPECT_EQ(split(0, 100, 100), "100");
  EXPECT_EQ(split(0, 0, 100), "nothing");
  EXPECT_THAT(split(0, 101, 100), HasSubstr("sizes 0 and 101 of a picture of 100 bytes"));
  EXPECT_THAT(split(0xFFFFFFFF, 0xFFFFFFFF, 100), HasSubstr("sizes 4294967295 and 4294967295"));
  EXPECT_THAT(split(0xFFFFFFFF, 101, 100), HasSubstr("of a picture of 100"));
  EXPECT_FALSE(split_depth(DepthStream::kAhat, std::vector<std::uint8_t>(12)).ok());
  EXPECT_FALSE(split_depth(DepthStream::kAhat, std::vector<std::uint8_t>(8))->has_value());
}

TEST(DepthPng, OfAnotherSizeOrDamagedIsRefused) {
  auto decoder = PngDecoder::create(320, 288);
  ASSERT_TRUE(decoder.ok());
  std::vector<std::uint8_t> bgra;
  DepthFrame frame;
  frame.range_mm = DepthImage(320, 288, 812);
  frame.brightness = DepthImage(320, 288, 99);
  const auto png = long_throw_png(frame);
  ASSERT_TRUE(png.ok());
  for (int again = 0; again < 2; ++again) {
    ASSERT_TRUE((*decoder)->decode(*png, bgra).ok());
    EXPECT_EQ(bgra, raw_depth_bytes(DepthStream::kLongThrow, frame)) << "picture " << again;
  }
  for (const auto& [width, height] :
       {std::pair{288, 320}, {320, 144}, {640, 576}, {40000, 40000}}) {
    auto other = *png;
    // The header's own sizes, whose checksum then fails as well; the smaller ones are made anew.
    for (int i = 0; i < 4; ++i) {
      other[static_cast<std::size_t>(16 + i)] = static_cast<std::uint8_t>(width >> (24 - 8 * i));
      other[static_cast<std::size_t>(20 + i)] = static_cast<std::uint8_t>(height >> (24 - 8 * i));
    }
    EXPECT_FALSE((*decoder)->decode(other, bgra).ok()) << width;
  }
  frame.range_mm = DepthImage(160, 144, 812);
  frame.brightness = DepthImage(160, 144, 99);
  const Status small = (*decoder)->decode(*long_throw_png(frame), bgra);
  ASSERT_FALSE(small.ok());
  EXPECT_THAT(small.error().message, HasSubstr("PNG is 160x144 px"));
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    auto damaged = *png;
    damaged[8 + random.next() % (damaged.size() - 8)] ^= 0x40;
    damaged.resize(damaged.size() - random.next() % 3);
    (void)(*decoder)->decode(damaged, bgra);
  }
  EXPECT_TRUE((*decoder)->decode(*png, bgra).ok()) << "damage is forgotten";
}

}  // namespace
}  // namespace orthonav::hl2ss::depth_parser_test
