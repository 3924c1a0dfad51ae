#include "engine/report/registration_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "engine/report/registration_page.h"
#include "tests/engine/report/exact_registration.h"

namespace orthonav::engine {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(RegistrationDrawing, DrawsTheShadowOfTheErrorEllipsoidOfEachView) {
  const RegisteredLevel level = exact();
  const RegistrationScene scene = registration_scene(level);
  // From behind the errors along x and z are seen, from the left along y and z, from above x and y.
  const std::array<std::array<double, 2>, 3> seen_mm = {{{0.3, 0.1}, {0.3, 0.2}, {0.2, 0.1}}};
  const auto views = registration_views();
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].from.right.cross(views[i].from.up), views[i].from.toward);
    const auto drawing = registration_drawing(level, scene, views[i]);
    ASSERT_TRUE(drawing.ok());
    std::smatch found;
    ASSERT_TRUE(std::regex_search(drawing->svg, found,
                                  std::regex("<ellipse rx=\"([0-9.]+)\" ry=\"([0-9.]+)\"")));
    EXPECT_NEAR(std::stod(found[1]), 5.0 * 2.7955 * seen_mm[i][0], 0.01) << views[i].name;
    EXPECT_NEAR(std::stod(found[2]), 5.0 * 2.7955 * seen_mm[i][1], 0.01) << views[i].name;
  }
}

TEST(RegistrationDrawing, TurnsTheEllipseTheWayTheErrorsLie) {
  RegisteredLevel level = exact();
  std::array<double, 36> covariance{};  // along x = z: left and up, or right and down
  covariance[0] = covariance[14] = 0.2e-3 * 0.2e-3;
  covariance[2] = covariance[12] = 0.9 * covariance[0];
  level.registration.uncertainty = nav::PoseUncertainty({}, covariance);
  const auto behind =
      registration_drawing(level, registration_scene(level), registration_views()[0]);
  // Left is on the left from behind: from the upper left to the lower right, y down: +45 degrees.
  EXPECT_THAT(behind->svg, HasSubstr("rotate(45.0)"));
}

/// The widths in millimetres of what is drawn, and in percent of the page, of each level.
std::vector<std::array<double, 2>> widths_of(const std::string& page) {
  const std::regex pattern("grid-template-columns:([0-9.]+)fr ([0-9.]+)fr;width:([0-9.]+)%");
  std::vector<std::array<double, 2>> widths;
  for (std::sregex_iterator i(page.begin(), page.end(), pattern); i != std::sregex_iterator();
       ++i) {
    widths.push_back({std::stod((*i)[1]) + std::stod((*i)[2]), std::stod((*i)[3])});
  }
  return widths;
}

TEST(RegistrationSections, DrawAllLevelsAndTheirEllipsoidsAtOneScale) {
  const RegisteredLevel sure = exact();
  RegisteredLevel unsure = exact();
  unsure.label = "L5";
  // Alone it is drawn at twice its size, beside it the other one too.
  std::array<double, 36> covariance{};
  covariance[0] = covariance[7] = covariance[14] = 0.5e-3 * 0.5e-3;
  unsure.registration.uncertainty = nav::PoseUncertainty{{}, covariance};
  // Something far off to the left makes one drawing wider.
  unsure.points.push_back(unsure.registration.world_from_vertebra *
                          Point<Vertebra>{Vec3{0.010, 0, 0} + unsure.model->mesh().vertices_m[0]});
  ASSERT_EQ(registration_scene(sure).magnified, 5.0);
  ASSERT_EQ(registration_scene(unsure).magnified, 2.0);
  const std::vector<RegisteredLevel> both = {sure, unsure};
  EXPECT_EQ(common_magnification(both), 2.0);
  const std::string page = registration_sections(both).value();
  std::size_t stated = 0;
  constexpr const char* kStated = "(drawn <b>2×</b>); at one scale in this report";
  for (std::size_t at = page.find(kStated); at != std::string::npos;
       at = page.find(kStated, at + 1)) {
    ++stated;
  }
  EXPECT_EQ(stated, 2U);
  EXPECT_THAT(page, Not(HasSubstr("drawn <b>5×")));
  const auto widths = widths_of(page);
  ASSERT_EQ(widths.size(), 2U);
  EXPECT_NEAR(widths[0][0] / widths[0][1], widths[1][0] / widths[1][1], 1e-3);
  EXPECT_NEAR(std::max(widths[0][1], widths[1][1]), 100.0, 1e-9);
  EXPECT_THAT(registration_section(sure).value(),
              AllOf(HasSubstr("(drawn <b>5×</b>)"), Not(HasSubstr("at one scale in this report"))));
}

TEST(RegistrationSections, LeaveOutWhatIsNotKnownFromTheScale) {
  RegisteredLevel unknown = exact();
  unknown.registration.uncertainty.reset();
  EXPECT_EQ(common_magnification(std::vector<RegisteredLevel>{exact(), unknown}), 5.0);
}

TEST(RegistrationPage, SaysHowTheViewFromAboveDiffersFromAnAxialSlice) {
  const RegistrationView above = registration_views()[2];
  // Left (LPS +x) is on the left of the page, and it is seen from the head (+z).
  EXPECT_EQ(above.from.right, (Vec3{-1, 0, 0}));
  EXPECT_EQ(above.from.toward, (Vec3{0, 0, 1}));
  const std::string page = registration_section(exact()).value();
  EXPECT_THAT(page, HasSubstr("from above, from the head: the patient’s left is on the left. An "
                              "axial CT slice is seen from the feet, with the patient’s right on "
                              "the left: this is its mirror image.</figcaption>"));
}

TEST(RegistrationDrawing, DrawsNoErrorsThatAreNotKnown) {
  RegisteredLevel level = exact();
  level.registration.uncertainty.reset();
  const auto page = registration_page(level, "points.csv");
  ASSERT_TRUE(page.ok());
  EXPECT_THAT(*page, Not(HasSubstr("<ellipse")));
  EXPECT_THAT(*page, HasSubstr("The errors at the screws are unknown"));
}

}  // namespace
}  // namespace orthonav::engine
