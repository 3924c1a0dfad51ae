#include "hal/hl2ss/server/depth_request.h"

#include <algorithm>
#include <string>

namespace orthonav::hl2ss {
namespace {

// AHaT: mode, divisor, depth profile, profile, level, bitrate (4), count of options.
constexpr std::size_t kAhatFixed = 10;
constexpr std::size_t kAhatOption = 16;
// Long throw: mode, divisor, filter (4).
constexpr std::size_t kLongThrowBytes = 6;
constexpr std::uint64_t kGroupOfPictures = 10;
constexpr std::uint64_t kLongestGroup = 3000;

using Answer = std::optional<DepthAsked>;

Result<Answer> ahat_request(DepthAsked asked, Bytes said) {
  if (said.size() < kAhatFixed) {
    return Answer{};
  }
  if (said[2] != 0) {
    return Error{"depth request: depth profile " + std::to_string(said[2]) +
                 ", must be 0 (this server has no Zdepth)"};
  }
  const std::uint8_t profile = said[3];
  if (profile > 2 && profile != 255) {
    return Error{"depth request: profile " + std::to_string(profile) +
                 ", must be 0 to 2 (H.264) or 255 (raw); this server has no HEVC"};
  }
  asked.coding = profile == 255 ? DepthCoding::kRaw : DepthCoding::kH264;
  asked.bitrate = number_at<std::uint32_t>(said, 5);
  if (asked.bitrate == 0) {
    return Error{"depth request: bitrate 0, must be positive"};
  }
  asked.bytes = kAhatFixed + kAhatOption * said[9];
  if (said.size() < asked.bytes) {
    return Answer{};
  }
  for (std::size_t at = kAhatFixed; at < asked.bytes; at += kAhatOption) {
    if (number_at<std::uint64_t>(said, at) == kGroupOfPictures) {
      asked.gop_size = static_cast<int>(
          std::clamp(number_at<std::uint64_t>(said, at + 8), std::uint64_t{1}, kLongestGroup));
    }
  }
  return Answer{asked};
}

}  // namespace

Result<std::optional<DepthAsked>> understand_depth_request(DepthStream stream, Bytes said) {
  if (said.empty()) {
    return Answer{};
  }
  if (said[0] > 2) {
    return Error{"depth request: mode " + std::to_string(said[0]) + ", must be 0, 1 or 2"};
  }
  DepthAsked asked;
  asked.what = static_cast<DepthAsked::What>(said[0]);
  asked.bytes = 1;
  if (asked.what == DepthAsked::What::kCalibration) {
    return Answer{asked};
  }
  if (said.size() < 2) {
    return Answer{};
  }
  asked.every = said[1];
  if (asked.every == 0) {
    return Error{"depth request: divisor 0, must be at least 1"};
  }
  if (stream == DepthStream::kAhat) {
    return ahat_request(asked, said);
  }
  if (said.size() < kLongThrowBytes) {
    return Answer{};
  }
  asked.coding = said[2] == 255 ? DepthCoding::kRaw : DepthCoding::kPng;
  asked.bytes = kLongThrowBytes;
  return Answer{asked};
}

}  // namespace orthonav::hl2ss
