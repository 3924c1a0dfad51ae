#include "tools/orthonav/depth/depth_cloud.h"

#include <string>

#include "tools/orthonav/shared/count_progress.h"

namespace orthonav::tools {

void add_points(const DepthCalibration& camera, const DepthFrame& frame, std::uint16_t max_mm,
                engine::PointCloud& cloud) {
  const auto world_from_sensor = *frame.world_from_rig * camera.sensor_from_rig.inverse();
  for (int y = 0; y < camera.height_px; ++y) {
    for (int x = 0; x < camera.width_px; ++x) {
      const std::uint16_t range_mm = frame.range_mm.at(x, y);
      if (range_mm > max_mm) {
        continue;
      }
      if (const auto point = camera.point_at(x, y, range_mm)) {
        cloud.add((world_from_sensor * *point).v);
      }
    }
  }
}

Result<CloudReport> add_all(replay::RecordedDepth& depth, std::uint16_t max_mm,
                            engine::PointCloud& cloud) {
  CloudReport report;
  CountProgress progress("depth frames", depth.summary.frames);
  DepthFrame frame;
  const std::int64_t last_map = depth.frames.back().map_epoch;
  for (const replay::RecordedDepthFrame& recorded : depth.frames) {
    progress.add_one();
    if (recorded.map_epoch != last_map) {
      ++report.frames_in_other_maps;
      continue;
    }
    if (!recorded.world_from_rig) {
      ++report.frames_without_pose;
      continue;
    }
    if (Status s = depth.read(recorded, frame); !s) {
      return s.error();
    }
    add_points(depth.calibration, frame, max_mm, cloud);
    ++report.frames_used;
    if (cloud.points_m().size() > kMaxPoints) {
      return Error{"more than " + std::to_string(kMaxPoints) +
                   " points; --cell-mm keeps fewer of them"};
    }
  }
  return report;
}

}  // namespace orthonav::tools
