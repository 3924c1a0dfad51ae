#include "engine/case/case.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "engine/case/case_file.h"
#include "tests/support/test_meshes.h"

namespace orthonav::engine::case_check_test {
namespace {

using ::testing::ElementsAre;

/// The answer of `check` for one screw on the box of 80 x 60 x 40 mm.
std::string said_of(nav::Side side, Vec3 entry, Vec3 target, double radius = 0.003) {
  Case subject;
  subject.levels = {{"L4", box_mesh(), {{side, {entry}, {target}, radius}}, {}}};
  const auto problems = subject.check();
  EXPECT_LE(problems.size(), 1u);
  return problems.empty() ? "" : problems.front();
}

TEST(Case, RefusesScrewsInOtherAxesOrOnTheOtherSide) {
  constexpr auto kLeft = nav::Side::kLeft;
  constexpr auto kRight = nav::Side::kRight;
  EXPECT_EQ(said_of(kLeft, {0.02, 0.03, 0}, {0.01, -0.01, 0}), "");
  EXPECT_EQ(said_of(kRight, {-0.02, 0.03, 0}, {-0.01, -0.01, 0}), "");
  EXPECT_EQ(said_of(kLeft, {0.02, -0.03, 0}, {0.01, 0.01, 0}),
            "L4 left entry lies 40.0 mm in front of its target, must lie behind it (posterior)");
  EXPECT_EQ(said_of(kRight, {0.02, 0.03, 0}, {0.01, -0.01, 0}),
            "L4 right entry lies 20.0 mm to the left of the bone's middle, must lie to the right");
  EXPECT_EQ(said_of(kLeft, {-0.02, 0.03, 0}, {-0.01, -0.01, 0}),
            "L4 left entry lies 20.0 mm to the right of the bone's middle, must lie to the left");
}

TEST(Case, RefusesATargetThatStandsOutOfTheBoneByMoreThanItsRadius) {
  const auto tip_at = [](double y, double radius) {
    return said_of(nav::Side::kLeft, {0.02, 0.03, 0}, {0.01, y, 0}, radius);
  };
  // The front face lies at y = -30 mm.
  EXPECT_EQ(tip_at(-0.0335, 0.0036), "");
  EXPECT_EQ(tip_at(-0.0340, 0.0036), "L4 left target lies 4.0 mm outside the bone, limit 3.6 mm");
  EXPECT_EQ(tip_at(-0.0329, 0.0), "") << "3 mm where no radius is stated";
  EXPECT_EQ(tip_at(-0.0331, 0.0), "L4 left target lies 3.1 mm outside the bone, limit 3.0 mm");
}

TEST(Case, NamesEveryProblemAtOnce) {
  Case bad;
  EXPECT_THAT(bad.check(), ElementsAre("levels is empty, at least 1 needed, unless rods alone are "
                                       "bent (orthonav run --rods-only)"));
  EXPECT_THAT(bad.check(CaseUse::kRods), ::testing::IsEmpty());
  const nav::ScrewPlan screw{nav::Side::kLeft, {{0.02, 0.03, 0}}, {{0.01, -0.01, 0}}, 0.003};
  bad.levels = {{"L4", box_mesh(), {screw}, {}}, {"L4", box_mesh(), {}, {}}, {"", {}, {screw}, {}}};
  EXPECT_THAT(bad.check(),
              ElementsAre("label L4 stands twice", "L4 lies in L4 (see spine_from_model)",
                          "levels[2] has no label", "levels[2] lies in L4 (see spine_from_model)",
                          "levels[2] has no surface"));
}

TEST(Case, ReadsTheRealSpines) {
  const std::filesystem::path anatomy = std::filesystem::path(ORTHONAV_SHARED_DIR) / "anatomy";
  if (!std::filesystem::exists(anatomy)) {
    GTEST_SKIP() << "needs shared/anatomy";
  }
  for (const auto& [name, levels] :
       {std::pair{"visible-human", 5u}, {"morph-a", 4u}, {"morph-b", 4u}, {"shape-mean", 4u}}) {
    const auto loaded = load_case((anatomy / name).string());
    ASSERT_TRUE(loaded.ok()) << loaded.error().message;
    EXPECT_EQ(loaded->levels.size(), levels);
    for (const CaseLevel& level : loaded->levels) {
      EXPECT_EQ(level.screws.size(), 2u);
      for (const nav::ScrewPlan& screw : level.screws) {
        EXPECT_NEAR((screw.target - screw.entry).norm(), 0.045, 1e-4);
      }
    }
  }
}

}  // namespace
}  // namespace orthonav::engine::case_check_test
