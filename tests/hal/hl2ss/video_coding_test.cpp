#include <gmock/gmock.h>

#include <cmath>

#include "hal/hl2ss/server/video_encoder.h"
#include "hal/hl2ss/video_decoder.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::uint32_t kBitrate = 12'000'000;

/// A bright square that wanders over a textured ground.
GreyImage picture(int number) {
  GreyImage image(640, 480);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      image.at(x, y) = static_cast<std::uint8_t>(40 + (x * 7 + y * 3) % 31);
    }
  }
  const int left = 20 + 9 * (number % 40);
  for (int y = 200; y < 280; ++y) {
    for (int x = left; x < left + 80; ++x) {
      image.at(x, y) = 220;
    }
  }
  return image;
}

double rms(const GreyImage& a, const GreyImage& b) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double off = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(a.pixels.size()));
}

// The encoder's own error at this rate; a neighbouring picture is 15 off.
constexpr double kCodecNoise = 4.0;

std::vector<std::vector<std::uint8_t>> encoded(int count, int slices) {
  auto encoder = VideoEncoder::create({kBitrate, 30, slices});
  EXPECT_TRUE(encoder.ok());
  std::vector<std::vector<std::uint8_t>> units;
  for (int i = 0; i < count; ++i) {
    auto unit = (*encoder)->encode(picture(i));
    EXPECT_TRUE(unit.ok());
    units.push_back(std::move(*unit));
  }
  return units;
}

/// What came out, by the number of its unit; errors are counted.
struct Decoded {
  std::vector<std::int64_t> units;
  int errors = 0;
  double worst_rms = 0.0;
};

Decoded decode(const std::vector<std::pair<int, std::vector<std::uint8_t>>>& units) {
  auto decoder = VideoDecoder::create(kImageWidthPx, kImageHeightPx);
  EXPECT_TRUE(decoder.ok());
  Decoded decoded;
  GreyImage image;
  for (const auto& [number, bytes] : units) {
    const auto unit = (*decoder)->decode(bytes, number, image);
    decoded.errors += unit ? 0 : 1;
    if (!unit || !*unit) {
      continue;
    }
    decoded.units.push_back(**unit);
    decoded.worst_rms = std::max(decoded.worst_rms, rms(image, picture(static_cast<int>(**unit))));
  }
  return decoded;
}

std::vector<std::pair<int, std::vector<std::uint8_t>>> numbered(int count, int slices = 1) {
  auto units = encoded(count, slices);
  std::vector<std::pair<int, std::vector<std::uint8_t>>> all;
  for (int i = 0; i < count; ++i) {
    all.emplace_back(i, std::move(units[static_cast<std::size_t>(i)]));
  }
  return all;
}

/// Where each unit of a stream begins, by its start code of three bytes.
std::vector<std::size_t> starts_of(const std::vector<std::uint8_t>& stream) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i + 3 < stream.size(); ++i) {
    if (stream[i] == 0 && stream[i + 1] == 0 && stream[i + 2] == 1) {
      starts.push_back(i);
    }
  }
  return starts;
}

TEST(H264, EveryPictureComesOutAtOnce) {
  const Decoded decoded = decode(numbered(40));
  ASSERT_EQ(decoded.units.size(), 40u);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(decoded.units[i], static_cast<std::int64_t>(i));
  }
  EXPECT_LT(decoded.worst_rms, kCodecNoise);
  EXPECT_EQ(decoded.errors, 0);
  EXPECT_GT(rms(picture(3), picture(4)), kCodecNoise) << "the twin: a picture late would be caught";
}

/// A wrong picture is worse than none: pictures that depend on one that could not be read must not
/// be delivered.
TEST(H264, AfterAUnitWithoutAPictureNothingComesUntilTheNextKeyFrame) {
  auto units = numbered(40);
  auto& bytes = units[10].second;
  ASSERT_EQ(starts_of(bytes).size(), 1u);
  bytes[starts_of(bytes)[0] + 3] = 0x0c;  // the slice is said to be filler data
  const Decoded decoded = decode(units);
  EXPECT_LT(decoded.worst_rms, kCodecNoise);
  EXPECT_GE(decoded.errors, 1);
  EXPECT_EQ(std::count_if(decoded.units.begin(), decoded.units.end(),
                          [](std::int64_t unit) { return unit >= 10 && unit < 30; }),
            0);
  EXPECT_EQ(decoded.units.back(), 39);
}

TEST(H264, ADamagedPictureIsNotPassedOn) {
  for (const std::size_t at : {6u, 40u, 200u}) {
    auto units = numbered(40);
    auto& bytes = units[12].second;
    for (std::size_t i = at; i < std::min(at + 60, bytes.size()); ++i) {
      bytes[i] ^= 0x5a;
    }
    const Decoded decoded = decode(units);
    EXPECT_LT(decoded.worst_rms, kCodecNoise) << at;
    EXPECT_EQ(decoded.units.back(), 39) << at;
  }
}

TEST(H264, ATornPictureIsNotPassedOn) {
  auto units = numbered(40);
  units[7].second.resize(units[7].second.size() / 2);
  const Decoded decoded = decode(units);
  EXPECT_LT(decoded.worst_rms, kCodecNoise);
  EXPECT_EQ(decoded.units.back(), 39);
}

TEST(H264, JoinsAStreamAtItsNextKeyFrame) {
  auto units = numbered(40);
  units.erase(units.begin(), units.begin() + 5);
  const Decoded decoded = decode(units);
  EXPECT_LT(decoded.worst_rms, kCodecNoise);
  ASSERT_FALSE(decoded.units.empty());
  EXPECT_EQ(decoded.units.front(), 30);
}

TEST(H264, PicturesOfSeveralSlicesComeOutWhole) {
  const auto units = numbered(40, 4);
  EXPECT_EQ(starts_of(units[12].second).size(), 4u) << "the encoder makes slices";
  const Decoded decoded = decode(units);
  EXPECT_EQ(decoded.units.size(), 40u);
  EXPECT_EQ(decoded.errors, 0);
  EXPECT_LT(decoded.worst_rms, kCodecNoise);
}

TEST(H264, APictureWithoutOneOfItsSlicesIsNotPassedOn) {
  for (const std::size_t lost : {0u, 1u, 2u, 3u}) {
    auto units = numbered(40, 4);
    auto& bytes = units[12].second;
    const auto starts = starts_of(bytes);
    ASSERT_EQ(starts.size(), 4u);
    const auto at = [&](std::size_t i) {
      return bytes.begin() + static_cast<std::ptrdiff_t>(i < 4 ? starts[i] : bytes.size());
    };
    bytes.erase(at(lost), at(lost + 1));
    const Decoded decoded = decode(units);
    EXPECT_LT(decoded.worst_rms, kCodecNoise) << lost;
    EXPECT_GE(decoded.errors, 1) << lost;
    EXPECT_EQ(std::count(decoded.units.begin(), decoded.units.end(), 12), 0) << lost;
    EXPECT_EQ(decoded.units.back(), 39) << lost;
  }
}

TEST(H264, ADamagedSliceIsNotPassedOn) {
  for (const std::size_t into : {10u, 100u, 400u}) {
    auto units = numbered(40, 4);
    auto& bytes = units[12].second;
    const std::size_t at = starts_of(bytes)[2] + into;
    for (std::size_t i = at; i < std::min(at + 40, bytes.size()); ++i) {
      bytes[i] ^= 0x5a;
    }
    const Decoded decoded = decode(units);
    EXPECT_LT(decoded.worst_rms, kCodecNoise) << into;
    EXPECT_EQ(decoded.units.back(), 39) << into;
  }
}

TEST(H264, RefusesGarbage) {
  auto decoder = VideoDecoder::create(kImageWidthPx, kImageHeightPx);
  ASSERT_TRUE(decoder.ok());
  GreyImage image;
  std::vector<std::uint8_t> garbage(5000);
  for (std::size_t i = 0; i < garbage.size(); ++i) {
    garbage[i] = static_cast<std::uint8_t>(i * 37 % 251);
  }
  const auto unit = (*decoder)->decode(garbage, 1, image);
  EXPECT_TRUE(!unit || !*unit);
  EXPECT_TRUE(image.pixels.empty());
}

}  // namespace
}  // namespace orthonav::hl2ss
