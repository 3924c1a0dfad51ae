#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/api/depth_camera.h"
#include "hal/api/devices.h"
#include "hal/replay/frame_files.h"

namespace orthonav::replay {

/// Names and conventions of HoloLens 1's HoloLensForCV recorder: row vectors, a camera view frame
/// with x right, y up and -z forward, projection tables sampled at pixel corners with x running
/// slowest (docs/recordings.md).
inline constexpr const char* kHololens1Left = "vlc_lf";
inline constexpr const char* kHololens1Right = "vlc_rf";
inline constexpr const char* kHololens1ShortThrow = "short_throw_depth";
inline constexpr const char* kHololens1LongThrow = "long_throw_depth";
/// The part before the ticks in the names of a sensor's images, with the backslash of its system.
inline std::string hololens1_prefix(const std::string& sensor) { return sensor + "\\"; }

/// The poses in a sensor's CSV file, world_from_rig, and where its camera is mounted. Frames that
/// were not located (a matrix of zeros) have no pose.
template <class Camera>
struct Hololens1Frames {
  PosesByTicks world_from_rig;
  Transform<Camera, Rig> camera_from_rig;  ///< vision axes: x right, y down, z forward
};
Result<Hololens1Frames<LeftCamera>> read_hololens1_left(const std::filesystem::path& folder);
Result<Hololens1Frames<RightCamera>> read_hololens1_right(const std::filesystem::path& folder);
Result<Hololens1Frames<DepthSensor>> read_hololens1_depth(const std::filesystem::path& folder,
                                                          const std::string& sensor);

/// The directions in a sensor's `_camera_space_projection.bin`, converted to pixel centres.
Result<CameraModel> read_hololens1_camera(const std::filesystem::path& folder,
                                          const std::string& sensor);
/// The same for a depth camera, as unit rays; its images determine the size of its table.
Result<std::vector<DepthCalibration::Ray>> read_hololens1_rays(const std::filesystem::path& folder,
                                                               const std::string& sensor,
                                                               int width_px, int height_px);

}  // namespace orthonav::replay
