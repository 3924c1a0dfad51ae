#include <cmath>
#include <string>

#include "engine/golden/golden_operation.h"
#include "engine/golden/golden_vertebra.h"

namespace orthonav::engine::golden {
namespace {

GoldenScene seen_from(float distance_m, float roll_deg, const std::string& rolled) {
  StagedOperation s(Step::kGuide);
  s.measure(guided(3.4, 0.0006, -0.0062));
  s.look_from(surgeon(distance_m, roll_deg));
  const auto cm = std::to_string(std::lround(100.0f * distance_m));
  return s.scene("guidance_" + cm + "cm_" + rolled,
                 "guidance from " + cm + " cm, head " + rolled + ": texts upright to the head",
                 surgeon_views(distance_m, roll_deg));
}

/// As `guidance`, but the eyes have rested on a lower facet, and the cross hangs beside that.
GoldenScene gazed_at() {
  StagedOperation s(Step::kGuide);
  s.measure(guided(3.4, 0.0006, -0.0062));
  s.rests_on = on_golden_vertebra(0.012f, -0.020f);
  return s.scene("guidance_gaze",
                 "guidance, the cross lower: beside the left lower facet, where the eyes rest");
}

}  // namespace

void add_view_scenes(std::vector<GoldenScene>& scenes) {
  for (const float distance_m : {0.35f, 0.50f, 0.70f}) {
    scenes.push_back(seen_from(distance_m, -20.0f, "rolled_left"));
    scenes.push_back(seen_from(distance_m, 0.0f, "upright"));
    scenes.push_back(seen_from(distance_m, 20.0f, "rolled_right"));
  }
  scenes.push_back(gazed_at());
}

}  // namespace orthonav::engine::golden
