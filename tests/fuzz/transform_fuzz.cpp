#include "engine/scan/transform_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Transform files of 3D Slicer: text here, HDF5 in its child process.
void fuzz_transform(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  const auto stored = engine::load_transform(file.path());
  if (!stored) {
    insist_one_line(stored.error());
    return;
  }
  const auto pose = engine::parent_from_node<Spine, Vertebra>(*stored);
  if (!pose) {
    insist_one_line(pose.error());
    return;
  }
  insist(pose->translation().is_finite() && orthonormality_error(pose->rotation()) < 1e-6);
}

}  // namespace orthonav::fuzz
