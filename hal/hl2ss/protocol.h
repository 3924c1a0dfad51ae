#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace orthonav::hl2ss {

/// The protocol of a HoloLens 2 that runs hl2ss (github.com/jdibenes/hl2ss); docs/hl2ss.md. Ports
/// are given as offsets from the first, 3800, so that a stand-in may use others.
inline constexpr int kFirstPort = 3800;

enum class Service : std::uint8_t {
  kLeftFront = 0,
  kRightFront = 2,
  kAhat = 4,
  kLongThrow = 5,
  kConfiguration = 9,
  kMicrophone = 11,
  kVoice = 15,
  kScene = 16,
};
[[nodiscard]] constexpr int offset_of(Service service) { return static_cast<int>(service); }
inline constexpr int kLastOffset = 18;

inline constexpr int kImageWidthPx = 640;
inline constexpr int kImageHeightPx = 480;
inline constexpr std::size_t kImageBytes = std::size_t{640} * 480;
/// Sensor ticks, exposure, gain, reserved: after the image.
inline constexpr std::size_t kImageTrailerBytes = 24;
inline constexpr std::size_t kPacketHeaderBytes = 12;
inline constexpr std::size_t kPoseBytes = 64;
/// A complete calibration answer: four tables, a matrix, four numbers.
inline constexpr std::size_t kCalibrationBytes = 4 * kImageBytes * 4 + kPoseBytes + 16;
inline constexpr std::size_t kVoiceResultBytes = 32;
inline constexpr int kMicrophoneHz = 48000;

/// Keys of the options in a request for images. A server stamps an image, and takes its pose, at
/// the host's stamp plus a factor (float64) times the exposure time plus an offset (int64, 100 ns).
inline constexpr std::uint64_t kGopSizeKey = 10;
inline constexpr std::uint64_t kStampExposuresKey = 0xFFFF'FFFF'FFFF'FFFF;
inline constexpr std::uint64_t kStampOffsetKey = 0xFFFF'FFFF'FFFF'FFFE;

enum class Mode : std::uint8_t { kVideo = 0, kVideoAndPose = 1, kCalibration = 2 };
enum class VideoProfile : std::uint8_t { kH264Base = 0, kH264Main = 1, kH264High = 2, kRaw = 255 };
/// How a depth stream is coded: AHaT raw or as video, long throw raw or as PNG.
enum class DepthCoding : std::uint8_t { kRaw, kH264, kPng };
/// An image and its trailer; a coded picture larger than the raw one is damaged.
inline constexpr std::size_t kMaxImagePayload = kImageBytes + kImageTrailerBytes;
/// A quarter of a second of sound.
inline constexpr std::size_t kMaxSoundPayload = std::size_t{48000};
inline constexpr std::uint32_t kMaxVoiceResults = 64;

/// Larger stamps are not valid times: a hundred times the stamp must fit into 64 bits of
/// nanoseconds.
inline constexpr std::int64_t kMaxTicks = 90'000'000'000'000'000;

}  // namespace orthonav::hl2ss
