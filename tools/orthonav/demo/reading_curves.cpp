#include "tools/orthonav/demo/reading_curves.h"

#include <algorithm>

#include "base/angle.h"
#include "engine/session/text/wording.h"

namespace orthonav::tools {

void ReadingCurves::stepped(const FrameHeader& frame, const engine::Inputs& /*inputs*/,
                            const engine::Guidance& guidance) {
  if (guidance.step != engine::Step::kGuide || !guidance.tool || !guidance.tool->measured) {
    return;
  }
  const engine::StepOnDisplay& at = guidance.status.at;
  if (screws_.empty() || screws_.back().at != at) {
    screws_.push_back({at, frame.time, {}, {}, {}});
  }
  Screw& screw = screws_.back();
  screw.time_s.push_back(seconds(frame.time - screw.begin));
  screw.angle_deg.push_back(degrees(guidance.tool->measured->angle_rad));
  screw.distance_mm.push_back(1e3 * guidance.tool->measured->tip_to_entry_m);
}

std::vector<engine::ReportPlot> ReadingCurves::plots(const engine::GradeLimits& limits) const {
  // The range that matters; a tool on its way to the bone reads 90°.
  constexpr double kAxis_deg = 6.0;
  const double good_deg = degrees(limits.good_rad);
  const double poor_deg = degrees(limits.poor_rad);
  const char* const time = "time since the tool was seen [s]";
  engine::ReportPlot angle{"Angle between tool and plan, as displayed",
                           time,
                           "\u00b0",
                           {},
                           {{good_deg, "good below " + engine::angle_text(limits.good_rad)},
                            {poor_deg, "poor above " + engine::angle_text(limits.poor_rad)}},
                           std::max(kAxis_deg, 1.2 * poor_deg)};
  engine::ReportPlot distance{
      "Distance of the tool's tip from the planned entry, as tracked", time, "mm", {}};
  for (const Screw& screw : screws_) {
    std::string name;
    engine::append_screw(name, screw.at.level, screw.at.side.value_or(Side::kLeft));
    angle.curves.push_back({name, screw.time_s, screw.angle_deg});
    distance.curves.push_back({name, screw.time_s, screw.distance_mm});
  }
  if (screws_.empty()) {
    return {};
  }
  return {angle, distance};
}

}  // namespace orthonav::tools
