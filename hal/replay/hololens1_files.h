#pragma once

#include <filesystem>

#include "hal/api/devices.h"
#include "hal/replay/frame_files.h"

namespace orthonav::replay {

/// Names of HoloLens 1's HoloLensForCV recorder, and what is peculiar to it: row vectors, a camera
/// view frame with x right, y up and -z forward, projection tables sampled at pixel corners with x
/// running slowest (docs/recordings.md).
inline constexpr const char* kHololens1Left = "vlc_lf";
inline constexpr const char* kHololens1Right = "vlc_rf";

/// The poses of a sensor's CSV file, world_from_rig, and where its camera sits. Frames that were
/// not located (a matrix of zeros) have no pose.
template <class Camera>
struct Hololens1Frames {
  PosesByTicks world_from_rig;
  Transform<Camera, Rig> camera_from_rig;  ///< vision axes: x right, y down, z forward
};
Result<Hololens1Frames<LeftCamera>> read_hololens1_left(const std::filesystem::path& folder);
Result<Hololens1Frames<RightCamera>> read_hololens1_right(const std::filesystem::path& folder);

/// The directions of a sensor's `_camera_space_projection.bin`, brought to pixel centres.
Result<CameraModel> read_hololens1_camera(const std::filesystem::path& folder,
                                          const std::string& sensor);

}  // namespace orthonav::replay
