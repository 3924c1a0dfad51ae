#include "engine/case/screw_breach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/case/operation_plan.h"
#include "engine/phantom/phantom.h"
#include "nav/guidance/screw_clearance.h"
#include "tests/support/test_meshes.h"

namespace orthonav::engine::screw_breach_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// One level, a box whose side is the plane x = 40 mm; its back is y = 30 mm.
Case box_case(double x_m, const std::string& accepted = {}, double radius_m = 0.003) {
  Case subject;
  subject.name = "box";
  subject.levels.push_back(
      {"L4",
       box_mesh(),
       {{nav::Side::kLeft, {{x_m, 0.03, 0}}, {{x_m, -0.01, 0}}, radius_m, accepted}},
       {}});
  return subject;
}

std::string refusal(const Case& subject) {
  const auto operation = plan_operation(subject);
  return operation ? "" : operation.error().message;
}

TEST(ScrewBreach, OfAScrewInsideIsNone) {
  EXPECT_EQ(refusal(box_case(0.02)), "");
  EXPECT_EQ(refusal(box_case(0.0369)), "");
}

TEST(ScrewBreach, RefusesThePlanInOneLine) {
  const std::string why = refusal(box_case(0.0382));
  EXPECT_THAT(why, HasSubstr("case 'box': L4 left screw breaks through the cortex: clearance "
                             "-1.2 mm, limit 0.0 mm (lateral, "));
  EXPECT_THAT(why, HasSubstr("state why in its \"accept_breach\""));
  EXPECT_THAT(why, Not(HasSubstr("\n")));
  EXPECT_THAT(refusal(box_case(0.0371)), HasSubstr("clearance -0.1 mm"));
}

TEST(ScrewBreach, IsTakenWithAReason) {
  EXPECT_EQ(refusal(box_case(0.0382, "in-out-in: the pedicle is 4 mm wide")), "");
}

TEST(ScrewBreach, IsNotMeasuredWithoutARadius) {
  EXPECT_EQ(refusal(box_case(0.0382, "", 0.0)), "");
}

TEST(ScrewBreach, OfTheBuiltInSpineIsNone) {
  for (const CaseLevel& level : phantom().levels) {
    const nav::SurfaceIndex bone(level.mesh);
    for (const nav::ScrewPlan& screw : level.screws) {
      const auto least = nav::least_clearance(bone, *nav::cylinder_of(screw));
      EXPECT_GT(least->clearance_m, 0.0) << level.label << " " << name_of(screw.side);
    }
  }
}

}  // namespace
}  // namespace orthonav::engine::screw_breach_test
