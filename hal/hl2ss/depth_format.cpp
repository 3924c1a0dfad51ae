#include "hal/hl2ss/depth_format.h"

#include <string>

namespace orthonav::hl2ss {
namespace {

constexpr std::size_t kTicksBytes = 8;
constexpr std::size_t kSizesBytes = 8;
/// One key frame per second.
constexpr std::uint64_t kAhatGopSize = 45;
constexpr std::uint8_t kDefaultLevel = 255;
/// Depth and brightness in one coded picture; the alternative would be Zdepth.
constexpr std::uint8_t kDepthWithBrightness = 0;
constexpr int kQuarter = 4;
constexpr int kMiddleOfQuarter = 2;
constexpr int kNearestCoded = 64;

std::uint16_t squared(std::uint8_t root) {
  return static_cast<std::uint16_t>(unsigned{root} * unsigned{root});
}

}  // namespace

DepthFormat format_of(DepthStream stream) {
  if (stream == DepthStream::kAhat) {
    return {Service::kAhat, 512, 512, std::chrono::nanoseconds(22'222'222), true};
  }
  return {Service::kLongThrow, 320, 288, std::chrono::milliseconds(200), false};
}

std::vector<std::uint8_t> request_bytes(const DepthWish& wish, std::uint32_t bitrate) {
  std::vector<std::uint8_t> bytes = {static_cast<std::uint8_t>(Mode::kVideoAndPose), 1};
  if (wish.stream == DepthStream::kLongThrow) {
    // The PNG's filter: 0 leaves the choice to the device, 255 in the low byte asks for none.
    append(bytes, std::uint32_t{wish.coding == DepthCoding::kPng ? 0U : 255U});
    return bytes;
  }
  append(bytes, kDepthWithBrightness);
  append(bytes,
         static_cast<std::uint8_t>(wish.coding == DepthCoding::kH264 ? VideoProfile::kH264Base
                                                                     : VideoProfile::kRaw));
  append(bytes, kDefaultLevel);
  append(bytes, bitrate);
  append(bytes, std::uint8_t{1});
  append(bytes, kGopSizeKey);
  append(bytes, kAhatGopSize);
  return bytes;
}

Result<std::optional<Bytes>> split_depth(DepthStream stream, Bytes payload) {
  using Answer = std::optional<Bytes>;
  if (payload.size() <= kTicksBytes) {
    return Answer{};
  }
  const Bytes body = payload.first(payload.size() - kTicksBytes);
  if (stream == DepthStream::kLongThrow) {
    return Answer{body};
  }
  if (body.size() < kSizesBytes) {
    return Error{"payload of " + std::to_string(payload.size()) + " bytes, must hold two sizes"};
  }
  const std::uint64_t depth_bytes = number_at<std::uint32_t>(body, 0);
  const std::uint64_t rest_bytes = number_at<std::uint32_t>(body, 4);
  if (rest_bytes == 0) {
    return Answer{};
  }
  const Bytes picture = body.subspan(kSizesBytes);
  if (depth_bytes + rest_bytes != picture.size()) {
    return Error{"sizes " + std::to_string(depth_bytes) + " and " + std::to_string(rest_bytes) +
                 " of a picture of " + std::to_string(picture.size()) + " bytes"};
  }
  return Answer{picture};
}

void read_raw_depth(const DepthFormat& format, Bytes raw, DepthImage& depth,
                    DepthImage& brightness) {
  const std::size_t half = 2 * format.pixels();
  for (DepthImage* image : {&depth, &brightness}) {
    image->width_px = format.width_px;
    image->height_px = format.height_px;
    image->pixels.resize(format.pixels());
    std::memcpy(image->pixels.data(), raw.data() + (image == &depth ? 0 : half), half);
  }
}

void read_coded_ahat(const GreyImage& luma, const std::vector<std::uint8_t>& chroma,
                     DepthImage& depth, DepthImage& brightness) {
  const std::size_t count = luma.pixels.size();
  for (DepthImage* image : {&depth, &brightness}) {
    image->width_px = luma.width_px;
    image->height_px = luma.height_px;
    image->pixels.resize(count);
  }
  // Each number of a plane covers two pixels: in the first plane columns 0 and 1 of every four, in
  // the second columns 2 and 3.
  const std::size_t plane = chroma.size() / 2;
  for (std::size_t i = 0; i < count; ++i) {
    const int value = kQuarter * luma.pixels[i];
    depth.pixels[i] =
        static_cast<std::uint16_t>(value < kNearestCoded ? 0 : value + kMiddleOfQuarter);
    brightness.pixels[i] = squared(chroma[i / 4 + (i % 4 < 2 ? 0 : plane)]);
  }
}

}  // namespace orthonav::hl2ss
