#include "hal/hl2ss/video.h"

#include <array>
#include <bit>
#include <cmath>
#include <string>

namespace orthonav::hl2ss {
namespace {

constexpr std::size_t kFixedRequestBytes = 9;
constexpr std::size_t kOptionBytes = 16;
/// A pose farther from the origin is damage.
constexpr double kMaxWorldM = 1e4;
/// Tolerance of the last column, for a device's arithmetic in single precision.
constexpr float kSlack = 1e-4f;

/// The known options, if there are any.
std::optional<VideoOptions> read_options(Bytes bytes) {
  std::optional<VideoOptions> options;
  for (std::size_t at = 0; at + kOptionBytes <= bytes.size(); at += kOptionBytes) {
    const auto key = number_at<std::uint64_t>(bytes, at);
    const auto value = number_at<std::uint64_t>(bytes, at + 8);
    VideoOptions known = options.value_or(VideoOptions{});
    if (key == kGopSizeKey) {
      known.gop_size = value;
    } else if (key == kStampExposuresKey) {
      known.stamp_exposures = std::bit_cast<double>(value);
    } else if (key == kStampOffsetKey) {
      known.stamp_offset_ticks = static_cast<std::int64_t>(value);
    } else {
      continue;
    }
    options = known;
  }
  return options;
}

}  // namespace

std::vector<std::uint8_t> request_bytes(const VideoRequest& request) {
  if (request.mode == Mode::kCalibration) {
    return {static_cast<std::uint8_t>(request.mode)};
  }
  std::vector<std::uint8_t> bytes = {static_cast<std::uint8_t>(request.mode), request.divisor,
                                     static_cast<std::uint8_t>(request.profile), 255};
  append(bytes, request.bitrate);
  if (!request.options) {
    append(bytes, std::uint8_t{0});
    return bytes;
  }
  const VideoOptions& options = *request.options;
  append(bytes, std::uint8_t{3});
  append(bytes, kGopSizeKey);
  append(bytes, options.gop_size);
  append(bytes, kStampExposuresKey);
  append(bytes, options.stamp_exposures);
  append(bytes, kStampOffsetKey);
  append(bytes, options.stamp_offset_ticks);
  return bytes;
}

Result<std::optional<ReadVideoRequest>> read_video_request(Bytes bytes) {
  using Answer = std::optional<ReadVideoRequest>;
  if (bytes.empty()) {
    return Answer{};
  }
  const std::uint8_t mode = bytes[0];
  if (mode > static_cast<std::uint8_t>(Mode::kCalibration)) {
    return Error{"video request: mode " + std::to_string(mode) + ", must be 0, 1 or 2"};
  }
  ReadVideoRequest read{{static_cast<Mode>(mode)}, 1};
  if (read.request.mode == Mode::kCalibration) {
    return Answer{read};
  }
  if (bytes.size() < kFixedRequestBytes) {
    return Answer{};
  }
  const std::uint8_t profile = bytes[2];
  if (bytes[1] == 0) {
    return Error{"video request: divisor 0, must be at least 1"};
  }
  if (profile > 2 && profile != static_cast<std::uint8_t>(VideoProfile::kRaw)) {
    return Error{"video request: profile " + std::to_string(profile) +
                 ", must be 0 to 2 (H.264) or 255 (raw)"};
  }
  read.request.divisor = bytes[1];
  read.request.profile = static_cast<VideoProfile>(profile);
  read.request.bitrate = number_at<std::uint32_t>(bytes, 4);
  if (read.request.bitrate == 0) {
    return Error{"video request: bitrate 0, must be positive"};
  }
  read.bytes = kFixedRequestBytes + kOptionBytes * bytes[8];
  if (bytes.size() < read.bytes) {
    return Answer{};
  }
  read.request.options =
      read_options(bytes.subspan(kFixedRequestBytes, read.bytes - kFixedRequestBytes));
  return Answer{read};
}

std::optional<ImagePayload> split_image(Bytes payload) {
  if (payload.size() <= kImageTrailerBytes) {
    return std::nullopt;
  }
  const std::size_t image_bytes = payload.size() - kImageTrailerBytes;
  ByteReader reader(payload.subspan(image_bytes));
  ImagePayload split;
  split.image = payload.first(image_bytes);
  split.trailer.sensor_ticks = reader.take<std::uint64_t>();
  split.trailer.exposure_ns = reader.take<std::uint64_t>();
  split.trailer.gain = reader.take<std::uint32_t>();
  return split;
}

Result<std::optional<Transform<World, Rig>>> read_pose(Bytes pose) {
  using Answer = std::optional<Transform<World, Rig>>;
  if (pose.size() != kPoseBytes) {
    return Error{"pose: " + std::to_string(pose.size()) + " bytes, must be 64"};
  }
  std::array<float, 16> m{};
  for (std::size_t i = 0; i < m.size(); ++i) {
    m[i] = number_at<float>(pose, 4 * i);
  }
  if (m[15] == 0.0f) {
    return Answer{};
  }
  // Row vectors: the matrix stored is the transpose.
  const auto is = [](float value, float expected) { return std::abs(value - expected) <= kSlack; };
  if (!is(m[15], 1.0f) || !is(m[3], 0.0f) || !is(m[7], 0.0f) || !is(m[11], 0.0f)) {
    return Error{"pose: last column must be 0 0 0 1"};
  }
  const Vec3 translation_m{m[12], m[13], m[14]};
  if (!(translation_m.norm() <= kMaxWorldM)) {
    return Error{"pose: " + std::to_string(translation_m.norm()) + " m from the origin, limit " +
                 std::to_string(kMaxWorldM) + " m"};
  }
  const Mat3 rotation = {{{{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}}}};
  const auto checked = Transform<World, Rig>::checked(rotation, translation_m);
  if (!checked) {
    return Error{"pose: " + checked.error().message};
  }
  return Answer{*checked};
}

void append_pose(std::vector<std::uint8_t>& bytes,
                 const std::optional<Transform<World, Rig>>& world_from_rig) {
  for (std::size_t column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      double entry = 0.0;
      if (world_from_rig && column < 3 && row < 3) {
        entry = world_from_rig->rotation()[row][column];
      } else if (world_from_rig && column == 3) {
        entry = row < 3 ? world_from_rig->translation()[row] : 1.0;
      }
      append(bytes, static_cast<float>(entry));
    }
  }
}

}  // namespace orthonav::hl2ss
