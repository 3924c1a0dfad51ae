#include "base/angle.h"
#include "engine/golden/golden_operation.h"
#include "engine/holograms/shapes/render_values.h"
#include "render/float3.h"

namespace orthonav::engine::golden {
namespace {

/// The step `measure`, its wire off the plan by the angle about a place beside the entry.
GoldenScene placed(const std::string& name, const std::string& what, double angle_deg,
                   double beside_m) {
  const nav::ScrewGuidance wire_axis = guided(angle_deg, beside_m, 0.0);
  PlacedWire wire;
  wire.angle_limit_rad = 2.0 * kRadiansPerDegree;
  wire.entry_limit_m = 0.002;
  wire.axis.line = {{wire_axis.tip.v}, -wire_axis.tool_outward};
  wire.axis.angle_rad = {angle_deg * kRadiansPerDegree, 0.7 * kRadiansPerDegree};
  wire.axis.entry_m = {beside_m, 0.0005};
  StagedOperation s(Step::kMeasureWire);
  s.guidance.wire = &wire;
  s.guidance.status.state = WireSoFar{&wire, false};
  return s.scene(name, what);
}

}  // namespace

void add_placed_scenes(std::vector<GoldenScene>& scenes) {
  scenes.push_back(
      placed("measure", "plan and a cyan line beside it, two numbers, a tick", 0.8, 0.0006));
  scenes.push_back(placed("measure_beyond",
                          "plan and a red line that leaves it, a red rim, a cross", 4.1, 0.0017));
}

}  // namespace orthonav::engine::golden
