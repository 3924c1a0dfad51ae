#include <orthonav/nav/guidance/screw.h>

// 30 mm along +y, and a tool on it whose tip is 10 mm before the entry.
int main() {
  using namespace orthonav;
  const nav::ScrewPlan plan{Side::kLeft, {{0.0, 0.030, 0.0}}, {{0.0, 0.0, 0.0}}};
  const nav::ScrewGuidance guidance =
      nav::guide(Transform<World, Vertebra>{}, plan, {{0.0, 0.040, 0.0}}, {0.0, 1.0, 0.0});
  return guidance.depth_m < -0.009 && guidance.depth_m > -0.011 ? 0 : 1;
}
