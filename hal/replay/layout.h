#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace orthonav::replay {

/// Names, sizes and constants of the folder: HoloLens 2's StreamRecorder layout, and the files that
/// our recorder adds. docs/recordings.md describes each.
inline constexpr int kImageWidthPx = 640;
inline constexpr int kImageHeightPx = 480;
inline constexpr std::size_t kImageBytes = std::size_t{640} * 480;
/// Depth images may have any size within these bounds: 512x512 (AHaT), 320x288 (long throw of
/// HoloLens 2), 448x450 (HoloLens 1).
inline constexpr int kMinDepthSidePx = 2;
inline constexpr int kMaxDepthSidePx = 2048;
/// Cameras lie within a headset.
inline constexpr double kMaxExtrinsics_m = 1.0;
inline constexpr const char* kLeftSensor = "VLC LF";
inline constexpr const char* kRightSensor = "VLC RF";
inline constexpr const char* kAhatSensor = "Depth AHaT";
inline constexpr const char* kLongThrowSensor = "Depth Long Throw";
inline constexpr const char* kShortThrowSensor = "Depth Short Throw";  ///< our own, of HoloLens 1
/// The year 1970 in ticks of 100 ns since 1601. In nanoseconds, such ticks overflow from the year
/// 1893 on, so a recording with FILETIME ticks counts its nanoseconds from 1970.
inline constexpr std::int64_t kUnixEpochTicks = 116444736000000000;

/// Times 100 this still fits into 64 bits of nanoseconds.
inline constexpr std::int64_t kMaxTicks = 90'000'000'000'000'000;
inline constexpr std::int64_t kMaxNs = 100 * kMaxTicks;
/// Poses farther from the origin than this are damage.
inline constexpr double kMaxWorldM = 1e6;

/// The suffix of a recording that is not closed yet.
inline constexpr std::string_view kUnfinished = ".part";
/// "DIR/" and "DIR" are one folder.
inline std::filesystem::path without_slash(const std::filesystem::path& folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

inline std::filesystem::path tar_of(const std::filesystem::path& folder,
                                    const std::string& sensor) {
  return folder / (sensor + ".tar");
}
inline std::filesystem::path lut_of(const std::filesystem::path& folder,
                                    const std::string& sensor) {
  return folder / (sensor + "_lut.bin");
}
inline std::filesystem::path exact_lut_of(const std::filesystem::path& folder,
                                          const std::string& sensor) {
  return folder / (sensor + "_lut64.bin");
}
inline std::filesystem::path extrinsics_of(const std::filesystem::path& folder,
                                           const std::string& sensor) {
  return folder / (sensor + "_extrinsics.txt");
}
inline std::filesystem::path poses_of(const std::filesystem::path& folder,
                                      const std::string& sensor) {
  return folder / (sensor + "_rig2world.txt");
}
// Our own, all optional for the reader.
inline std::filesystem::path frames_of(const std::filesystem::path& folder,
                                       const std::string& sensor) {
  return folder / (sensor + "_frames.csv");
}
inline std::filesystem::path map_of(const std::filesystem::path& folder,
                                    const std::string& sensor) {
  return folder / (sensor + "_map.csv");
}
inline constexpr const char* kDeviceFile = "device.csv";
inline constexpr const char* kFramesFile = "frames.csv";
inline constexpr const char* kEventsFile = "events.csv";
inline constexpr const char* kHeadFile = "head.csv";
inline constexpr const char* kMapFile = "map.csv";
inline constexpr const char* kToolsFile = "tools.json";
inline constexpr const char* kDeviceHeader = "key,value";
inline constexpr const char* kFramesHeader = "sequence,time_ns,ticks_100ns,clock_ns";
inline constexpr const char* kMapHeader = "sequence,map_epoch";
inline constexpr const char* kEventsHeader = "device,what,confidence,time_ns,available_ns,text";
inline constexpr const char* kHeadHeader =
    "sequence,at_ns,origin,m11,m12,m13,m14,m21,m22,m23,m24,m31,m32,m33,m34,m41,m42,m43,m44,"
    "covariance";

}  // namespace orthonav::replay
