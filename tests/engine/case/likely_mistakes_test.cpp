#include "engine/case/likely_mistakes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "engine/case/case.h"
#include "engine/case/case_file.h"
#include "engine/case/plan_file.h"
#include "engine/case/points_file.h"
#include "engine/phantom/phantom.h"
#include "tests/support/test_data.h"

namespace orthonav::engine::likely_mistakes_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

TEST(LikelyMistakes, RasTakenForLpsIsNamed) {
  nav::TriangleMesh bone = phantom().levels.front().mesh;
  EXPECT_TRUE(has_canal(bone).value());
  for (Vec3& v : bone.vertices_m) {
    v = to_lps(v, Axes::kRas);
  }
  const auto turned = has_canal(bone);
  ASSERT_FALSE(turned.ok());
  EXPECT_THAT(turned.error().message, HasSubstr("its axes are RAS and not LPS"));
}

TEST(LikelyMistakes, MetresTakenForMillimetresAreNamed) {
  const auto refusal = [](double scale, bool stated) {
    const std::vector<Vec3> points = {{0, 0, 0}, {0.06 * scale, 0, 0}, {0, 0.03 * scale, 0}};
    const Status s = check_scale(points, stated);
    return s ? std::string() : s.error().message;
  };
  EXPECT_EQ(refusal(1.0, false), "");
  EXPECT_THAT(refusal(1e-3, false), HasSubstr("are they in metres? State it with --units m"));
  EXPECT_THAT(refusal(1e3, false), HasSubstr("are they in millimetres? State it with --units mm"));
  EXPECT_THAT(refusal(1e-3, true), HasSubstr("Its unit is stated in the file"));
  EXPECT_TRUE(check_scale(std::vector<Vec3>{{1, 2, 3}}, false).ok()) << "one point has no size";
}

TEST(LikelyMistakes, ACaseWhoseUnitContradictsItsMeshesIsNamed) {
  Case spine = phantom();
  ASSERT_THAT(spine.check(), ::testing::IsEmpty());
  for (CaseLevel& level : spine.levels) {
    const Vec3 place_m = level.spine_from_vertebra.translation();
    level.spine_from_vertebra = {level.spine_from_vertebra.rotation(), 1e3 * place_m};
  }
  EXPECT_THAT(spine.check(), Contains(HasSubstr("is the unit of spine_from_model")));
}

TEST(LikelyMistakes, AScenesPartsAreToBeExported) {
  EXPECT_THAT(load_points("x.mrml").error().message, HasSubstr("save its points as .mrk.json"));
  EXPECT_THAT(load_plan(std::string("x.mrb")).error().message,
              HasSubstr("save the screws' lines as .mrk.json"));
}

TEST(LikelyMistakes, APlanOfAnotherLevelIsNoticedWhereItCanBeTold) {
  const auto spine =
      load_case(test::test_data("anatomy/visible-human").string(), CaseUse::kPlanning);
  ASSERT_TRUE(spine.ok()) << spine.error().message;
  const auto fit = [&](const char* bone, const char* plan) {
    return poor_fit(spine->find(bone)->mesh, spine->find(plan)->screws);
  };
  for (const CaseLevel& level : spine->levels) {
    EXPECT_EQ(poor_fit(level.mesh, level.screws), "") << level.label;
  }
  EXPECT_THAT(fit("L2", "L1"), HasSubstr("left entry 2.4 mm below the surface, limit 2.0 mm"));
  EXPECT_THAT(fit("L4", "L5"), HasSubstr("left breaks through the cortex by 3.0 mm"));
  EXPECT_EQ(fit("L3", "L4"), "") << "in frames of their own these two are alike";
}

TEST(LikelyMistakes, NamesOfFilesStateALevel) {
  EXPECT_EQ(level_in_name("case L1/Screws_L4.mrk.json"), "L4");
  EXPECT_EQ(level_in_name("l4-left.mrk.json"), "L4");
  EXPECT_EQ(level_in_name("L4_L5.json"), "") << "which of them?";
  EXPECT_EQ(level_in_name("bone.stl"), "");
}

}  // namespace
}  // namespace orthonav::engine::likely_mistakes_test
