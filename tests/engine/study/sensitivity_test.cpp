#include "engine/study/sensitivity.h"

#include <gmock/gmock.h>

#include <cmath>

#include "base/random.h"
#include "engine/study/sensitivity_page.h"
#include "engine/study/sensitivity_regression.h"
#include "engine/study/system_profile.h"

namespace orthonav::engine {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> studied_in(const std::string& profile) {
  std::vector<std::string> names;
  for (const sim::Magnitude* magnitude : studied_magnitudes(system_named(profile)->magnitudes)) {
    names.emplace_back(magnitude->name);
  }
  return names;
}

TEST(Sensitivity, StudiesWhatHasARange) {
  std::size_t with_range = 0;
  for (const sim::Magnitude& magnitude : sim::magnitudes()) {
    with_range += magnitude.high > magnitude.low ? 1 : 0;
  }
  EXPECT_EQ(studied_magnitudes({}).size(), with_range);
  EXPECT_EQ(studied_in("liebmann-2019").size(), with_range) << "it leaves all as it is by default";
}

TEST(Sensitivity, LeavesWhatAProfileHasDecided) {
  const std::vector<std::string> names = studied_in("straighttrack-cannula");
  EXPECT_THAT(names, Not(Contains("wire_bending_rad"))) << "the cannula's";
  EXPECT_THAT(names, Not(Contains("tip_calibration_m"))) << "held by the stated navigation";
  EXPECT_THAT(names, Not(Contains("map_drift_m_per_sqrt_s")));
  EXPECT_THAT(names, AllOf(Contains("tremor_m"), Contains("wire_skiving_m")));
  EXPECT_THAT(studied_in("robot-wires"), Not(Contains("tremor_m"))) << "a robot's arm";
  EXPECT_THAT(studied_in("xvision"), Not(Contains("tissue_m"))) << "its own magnitude";
}

/// Errors that two of three magnitudes decide, with noise.
std::vector<RandomPoint> random_points(int count) {
  Random random(5);
  std::vector<RandomPoint> points;
  for (int i = 0; i < count; ++i) {
    RandomPoint point;
    point.place = {random.uniform(), random.uniform(), random.uniform()};
    point.entry_mm = 2.0 + 0.8 * point.place[0] + random.normal(0.0, 0.5);
    point.angle_deg = 3.0 - 1.5 * point.place[2] + random.normal(0.0, 0.5 + point.place[2]);
    points.push_back(std::move(point));
  }
  return points;
}

TEST(RegressedSensitivities, FindWhatDecidesWithAnIntervalThatHoldsIt) {
  const auto all = sim::magnitudes();
  const std::vector<const sim::Magnitude*> three = {&all[0], &all[1], &all[2]};
  const auto found = regressed(three, random_points(2000));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].magnitude, all[2].name);
  EXPECT_NEAR(found[0].angle_deg, -1.5, 1.5 * found[0].angle_spread_deg);
  EXPECT_NEAR(found[0].entry_mm, 0.0, 1.5 * found[0].entry_spread_mm);
  EXPECT_EQ(found[1].magnitude, all[0].name);
  EXPECT_NEAR(found[1].entry_mm, 0.8, 1.5 * found[1].entry_spread_mm);
  // 0.5 mm of scatter over the square root of 2000 uniform places.
  EXPECT_NEAR(found[1].entry_spread_mm, 1.96 * 0.5 / std::sqrt(2000.0 / 12.0), 0.01);
  EXPECT_TRUE(regressed(three, random_points(7)).empty());
}

TEST(RegressedSensitivities, RefuseTooFewPointsBeforeTheFirstOperation) {
  SensitivityOptions options;
  options.points = 5;
  std::size_t used = 0;
  bool operated = false;
  const auto found =
      regressed_sensitivities({}, options, used, [&operated](int, int) { operated = true; });
  ASSERT_FALSE(found.ok());
  const std::size_t fewest = fewest_points(studied_magnitudes({}).size());
  EXPECT_THAT(found.error().message,
              HasSubstr("--points 5: at least " + std::to_string(fewest) + " needed"));
  EXPECT_FALSE(operated);
}

TEST(SensitivityPage, ShowsBarsOfTheFirstAndATableOfAll) {
  std::vector<Sensitivity> found;
  for (int i = 0; i < 25; ++i) {
    found.push_back(
        {"magnitude_" + std::to_string(i), "mm", 0.5, 1.5, 2.0 - 0.05 * i, 1.0, 0.25, 0.125});
  }
  SensitivityOptions options;
  options.trajectories = 7;
  const std::string page = sensitivity_html(found, options);
  EXPECT_THAT(page, HasSubstr("7 trajectories"));
  EXPECT_THAT(page, HasSubstr("The 20 of 25 magnitudes"));
  EXPECT_THAT(page, HasSubstr("\"names\":[\"magnitude_0\","));
  EXPECT_THAT(page, Not(HasSubstr("\"magnitude_20\"")));
  EXPECT_THAT(page, HasSubstr("<code>magnitude_24</code></th><td data-label=\"range\">0.5 to 1.5 mm"
                              "</td><td data-label=\"entry [mm]\">0.80 ± 0.25</td>"
                              "<td data-label=\"angle [°]\">1.00 ± 0.12</td>"));
}

}  // namespace
}  // namespace orthonav::engine
