#include "engine/io/pose_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Poses of a tracker; the first byte chooses the options.
void fuzz_poses(std::span<const std::uint8_t> input) {
  if (input.empty()) {
    return;
  }
  engine::PoseFileOptions options;
  const unsigned choice = input[0];
  if ((choice & 1u) != 0) {
    options.metres_per_unit = 1e-3;
  }
  if ((choice & 2u) != 0) {
    options.pose = "StylusToReference";
  }
  if ((choice & 4u) != 0) {
    options.columns = {"x", "y", "z", "qx", "qy", "qz", "qw"};
  }
  if ((choice & 8u) != 0) {
    options.rate_hz = 30.0;
  }
  const auto file = engine::load_poses(InputFile(input.subspan(1)).path(), options);
  if (!file) {
    insist_one_line(file.error());
    return;
  }
  insist(!file->world_from_marker.empty());
  insist(file->times_s.empty() || file->times_s.size() == file->world_from_marker.size());
  for (const auto& pose : file->world_from_marker) {
    insist(pose.translation().is_finite());
  }
}

}  // namespace orthonav::fuzz
