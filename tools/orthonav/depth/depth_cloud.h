#pragma once

#include <cstdint>

#include "engine/io/point_cloud.h"
#include "hal/replay/depth_files.h"

namespace orthonav::tools {

/// Statistics of a point cloud from a depth stream.
struct CloudReport {
  std::int64_t frames_used = 0;
  std::int64_t frames_without_pose = 0;
  std::int64_t frames_in_other_maps = 0;  ///< positions in one map mean nothing in another
};

/// Appends a frame's points in the world; the frame must have a pose.
void add_points(const DepthCalibration& camera, const DepthFrame& frame, std::uint16_t max_mm,
                engine::PointCloud& cloud);

/// All frames of the stream's last map that have a pose. Refuses more points than `kMaxPoints`.
inline constexpr std::size_t kMaxPoints = 20'000'000;
Result<CloudReport> add_all(replay::RecordedDepth& depth, std::uint16_t max_mm,
                            engine::PointCloud& cloud);

}  // namespace orthonav::tools
