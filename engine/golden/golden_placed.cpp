#include "engine/golden/golden_stage.h"
#include "engine/session/wording.h"
#include "render/float3.h"

namespace orthonav::engine::golden {
namespace {

using render::Float3;

/// The step `placed`, its wire off the plan by the angle about a place beside the entry.
GoldenScene placed(const std::string& name, const std::string& what, const std::string& detail,
                   const std::string& text, double angle_deg, float beside_m, bool within) {
  constexpr std::array<ToolDot, 2> kTools = {
      {{"guide", ToolState::kMeasured}, {"reference", ToolState::kPredicted}}};
  GoldenScene golden = start_wide(name, what + ", both eyes", surgeon_views());
  add_status_line(golden.scene, step_text({Step::kPlaced, "L4", Side::kLeft}) + " | " + detail,
                  kTools, kStatusLabel);
  add_entry(golden.scene, {kEntry, kNormal, "L4 left", false, LabelSide::kLeft}, kEntryLabel);
  add_entry(golden.scene, {kOtherEntry, kOtherNormal, "L4 right", true, LabelSide::kRight},
            kOtherEntryLabel);
  add_planned_trajectory(golden.scene, kEntry, kTarget, kTrajectoryLabel);
  const Float3 out = render::unit_or(tool_point(angle_deg) - kEntry, {0, 1, 0});
  const Float3 near = kEntry + Float3{beside_m, 0, 0};
  const Float3 outside = near + kTrajectoryOutside_m * out;
  add_placed_wire(golden.scene, outside, near - render::length(kTarget - kEntry) * out, text,
                  within, kPlacedWireLabel);
  golden.covered.push_back({kPlacedWireLabel, outside});
  return golden;
}

}  // namespace

void add_placed_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(placed("placed", "plan and a cyan line beside it, numbers with SDs, a tick",
                          "placed: 0.8 ± 0.7°, 0.6 ± 0.5 mm from the plan",
                          "0.8 ± 0.7°, 0.6 ± 0.5 mm", 0.8, 0.0006f, true));
  scenes.push_back(
      placed("placed_beyond", "plan and a red line that leaves it, a red rim, a cross",
             "angle 4.1°, limit 2.0°: say accept result to keep it, delete last to redo it",
             "4.1 ± 0.7°, 1.7 ± 0.5 mm", 4.1, 0.0017f, false));
}

}  // namespace orthonav::engine::golden
