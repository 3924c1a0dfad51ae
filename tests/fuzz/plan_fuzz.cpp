#include "engine/case/plan_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Plans, ours and 3D Slicer's markups.
void fuzz_plan(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  const auto plan = engine::load_plan(file.path());
  if (!plan) {
    insist_one_line(plan.error());
    return;
  }
  for (const engine::StatedScrew& screw : plan->screws) {
    insist(screw.entry.v.is_finite() && screw.target.v.is_finite() && screw.radius_m >= 0.0);
  }
}

}  // namespace orthonav::fuzz
