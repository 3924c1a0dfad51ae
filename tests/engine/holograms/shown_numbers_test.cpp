// H13 as it is drawn and told.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/printed.h"
#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::shown_numbers_test {
namespace {

using test::guide_at;
using test::ScriptedOperation;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
constexpr Vec3 kRightEntry{-0.015, 0.020, 0.0};

/// Every text of H6, H9 and H13 that a display is told of, in order.
std::vector<std::string> told(const Guidance& g, std::optional<Timestamp> at = std::nullopt) {
  SceneBuilder builder;
  ShownFrame frame;
  builder.update(g, at.value_or(g.display_time));
  builder.write_shown(g, frame);
  std::vector<std::string> texts;
  for (const ShownHologram& hologram : frame.holograms) {
    const HologramKind kind = hologram.kind;
    if (kind == HologramKind::kAngle || kind == HologramKind::kDepth ||
        kind == HologramKind::kNumbers) {
      texts.push_back(hologram.text);
    } else if (kind == HologramKind::kCross && !hologram.text.empty() &&
               hologram.text != "tool lost") {
      texts.push_back(hologram.text);
    }
  }
  return texts;
}

std::string act(const Guidance& g) {
  SceneBuilder builder;
  ShownFrame frame;
  builder.update(g);
  builder.write_shown(g, frame);
  const std::string& line = frame.status->text;
  const std::size_t end = line.find(" | ");
  return end == std::string::npos ? "" : line.substr(end + 3);
}

/// The same in a scene, with what is to be done next.
std::vector<std::string> drawn(const render::Scene& scene) {
  std::vector<std::string> texts;
  for (const render::TextItem& text : scene.texts) {
    const HologramKind kind = kind_of(text.label);
    if (kind == HologramKind::kAngle || kind == HologramKind::kDepth ||
        kind == HologramKind::kNumbers) {
      texts.push_back(text.runs.at(0).text);
    }
  }
  return texts;
}

render::Scene scene_of(const Guidance& g) {
  SceneBuilder builder;
  render::Scene scene;
  builder.update(g);
  builder.write_scene(g, scene);
  return scene;
}

class ShownNumbers : public ::testing::Test {
 protected:
  ShownNumbers() { know_registration(0.0003); }
  void know_registration(double sd_m) {
    std::array<double, 36> covariance{};
    for (std::size_t k = 0; k < 3; ++k) {
      covariance[7 * k] = sd_m * sd_m;
      covariance[7 * (k + 3)] = 1e-6;
    }
    s.registration.uncertainty = nav::PoseUncertainty({0, 0, 0}, covariance);
  }
  /// The tip off the left entry; both to the patient's left of the midline.
  const Guidance& guided(Vec3 off_m, double angle_rad = 0.0) {
    if (s.session().current_step() == Step::kSetup) {
      s.accepts_first_level();
      s.says("next");
    }
    s.tracker().guide = guide_at(entry + off_m, angle_rad);
    s.pair();
    return s.pair();
  }
  const Guidance& guided_with_cameras_off(ScriptedOperation& other, double cameras_m) {
    other.registration = s.registration;
    other.registration.common.cameras_m = cameras_m;
    other.registration.uncertainty =
        nav::with_common(*s.registration.uncertainty, other.registration.common);
    other.accepts_first_level();
    other.says("next");
    other.tracker().guide = guide_at(kLeftEntry + Vec3{0.0012, 0.010, 0.0}, 0.0);
    other.pair();
    return other.pair();
  }
  ScriptedOperation s;
  Vec3 entry = kLeftEntry;
};

TEST_F(ShownNumbers, AreOneAngleOneOffsetAndOneDepth) {
  const Guidance& g = guided({0.0012, 0.010, 0.0008}, 0.0349);
  EXPECT_THAT(told(g), ElementsAre("2.0°", "tip 1.5 mm", "10.0 mm to entry"));
  EXPECT_EQ(act(g), "move the tip");
  EXPECT_THAT(drawn(scene_of(g)),
              ElementsAre("2.0°", "tip 1.5 mm", "10.0 mm to entry", "move the tip"));
}

TEST_F(ShownNumbers, AreAllShownOnRequestAndHiddenAgain) {
  guided({0.0012, 0.010, 0.0008}, 0.0349);
  const std::vector<std::string> all = told(s.says("numbers"));
  ASSERT_EQ(all.size(), 8u);
  EXPECT_THAT(std::vector(all.begin() + 3, all.begin() + 7),
              ElementsAre("0.8 mm cranial", "1.2 mm lateral", "0.0°", "2.0° lateral"));
  EXPECT_THAT(all.back(), ::testing::StartsWith("clearance "));
  s.does({ClickerAction::kPress, ClickerAction::kRelease, ClickerAction::kClick});
  EXPECT_EQ(told(s.pair()).size(), 3u) << "a click is the same word";
}

TEST_F(ShownNumbers, NameTheSameWayMedialOnTheOtherSide) {
  guided({});
  s.says("next");
  entry = kRightEntry;
  guided({0.0012, 0.010, 0.0});
  EXPECT_EQ(told(s.says("numbers")).at(4), "1.2 mm medial");
}

TEST_F(ShownNumbers, AreAbsentWhereTheToolWasNotMeasuredInThisPair) {
  ASSERT_EQ(told(guided({})).size(), 3u);
  s.tracker().guide_origin = PoseStatus::kPredicted;
  const Guidance& predicted = s.pair();
  EXPECT_THAT(told(predicted), ElementsAre("--.-°"));
  EXPECT_EQ(act(predicted), "guide lost");
}

TEST_F(ShownNumbers, GoWithAPoseThatIsTooOldWhereverTheyStand) {
  guided({});
  const Guidance& g = s.says("numbers");
  render::Scene scene = scene_of(g);
  EXPECT_EQ(drawn(scene).size(), 15u) << "three numbers, four more with two words, clearance and "
                                         "bound with theirs and what they are of, the act";
  EXPECT_THAT(told(g, g.tool->pose_time + g.stale_after + Duration(1)), ElementsAre("--.-°"));
  hide_tool_guidance(scene);
  EXPECT_THAT(drawn(scene), ElementsAre("\u2012\u2012.\u2012°"));
}

TEST_F(ShownNumbers, GoWithTheHead) {
  render::Scene left;
  write_head_lost(scene_of(guided({})), left);
  EXPECT_FALSE(left.texts.empty());
  EXPECT_THAT(drawn(left), IsEmpty());
}

TEST_F(ShownNumbers, AreTheirBoundsWhereTheyAreNotSure) {
  know_registration(0.00149);
  const Guidance& g = guided({0.0012, 0.010, 0.0});
  const double sd_m = std::hypot(0.00149, test::guide_sd_m());
  EXPECT_EQ(told(g).at(1), printed("tip ≤ %.1f mm", std::ceil(1e4 * (0.0012 + 2.448 * sd_m)) / 10));
  EXPECT_EQ(told(g).at(2),
            printed("≥ %.1f mm to entry", std::floor(1e4 * (0.010 - 1.645 * sd_m)) / 10));
  const Guidance& near = guided({0, 0.010, 0});
  EXPECT_EQ(act(near), "not sure: check by eye");
  EXPECT_EQ(scene_of(near).triangles.at(0).colour.g, look::colours().fair.g) << "never green";
}

TEST_F(ShownNumbers, CountOfTheCamerasErrorWhatToolAndBoneDoNotShare) {
  ScriptedOperation few, much;
  EXPECT_EQ(told(guided_with_cameras_off(few, 0.0014)).at(1), "tip 1.2 mm")
      << "three tenths of it: still sure";
  EXPECT_THAT(told(guided_with_cameras_off(much, 0.0070)).at(1), ::testing::StartsWith("tip ≤ "));
}

/// The verdict's colour, everywhere that it is drawn.
void expect_one_colour(const render::Scene& scene, const render::Colour& expected) {
  EXPECT_EQ(scene.triangles.at(0).colour.g, expected.g);
  for (const render::MeshItem& mesh : scene.meshes) {
    if (kind_of(mesh.label) == HologramKind::kCross) {
      EXPECT_EQ(mesh.colour, expected) << "the dot";
    }
  }
  for (const render::TextItem& text : scene.texts) {
    if (text.place == render::TextPlace::kWorld && text.rim.a > 0) {
      EXPECT_EQ(text.rim, expected) << text.runs[0].text;
    }
  }
}

TEST_F(ShownNumbers, HaveOneVerdictWhicheverIsWorst) {
  const auto& colours = look::colours();
  expect_one_colour(scene_of(guided({0.0003, 0.010, 0})), colours.good);
  EXPECT_EQ(act(s.pair()), "advance");
  expect_one_colour(scene_of(guided({0.0015, 0.010, 0})), colours.fair);
  EXPECT_EQ(act(s.pair()), "move the tip");
  expect_one_colour(scene_of(guided({0.0, 0.010, 0.0}, 0.05)), colours.fair);
  EXPECT_EQ(act(s.pair()), "turn the tool");
  // Parallel to the plan but 3 mm beside it: no green angle beside a red offset.
  expect_one_colour(scene_of(guided({0.0032, 0.010, 0})), colours.poor);
  expect_one_colour(scene_of(guided({0, -0.0395, 0})), colours.poor);
}

TEST_F(ShownNumbers, SayWhereTheScrewBreaksThroughAndOnlyThen) {
  // The wall at x = 30 mm, a radius of 3 mm; of the bound's SD most is that of the guide, which was
  // not compared with the pointer.
  EXPECT_EQ(told(guided({0.00855, 0.010, 0.0})).size(), 3u) << "3.4 mm: it is safe";
  EXPECT_THAT(told(guided({0.01185, 0.010, 0.0})),
              ::testing::Contains("may break through laterally"));
  const Guidance& out = guided({0.01305, 0.010, 0.0});
  EXPECT_THAT(drawn(scene_of(out)), ::testing::Contains("breaks through laterally"));
  EXPECT_EQ(act(out), "aim away from the wall");
  s.tracker().guide_origin = PoseStatus::kPredicted;
  EXPECT_THAT(told(s.pair()), ElementsAre("--.-°")) << "with the measurement";
}

TEST_F(ShownNumbers, SayWhatToDoWithTheDrillAndKeepTheStop) {
  guided({0, 0, 0});
  s.tracker().pointer.reset();
  s.pairs(20);
  EXPECT_EQ(act(s.pair()), "drill");
  EXPECT_EQ(act(guided({0.0, -0.004, 0})), "drilling");
  const Guidance& deep = guided({0, -0.0345, 0});
  render::Scene scene = scene_of(deep);
  EXPECT_THAT(drawn(scene), ::testing::Contains("stop"));
  EXPECT_EQ(act(deep), "") << "the stop says it";
  render::Scene left;
  write_head_lost(scene, left);
  EXPECT_THAT(drawn(left), ElementsAre("stop")) << "in view wherever the head is";
  hide_tool_guidance(scene);
  EXPECT_THAT(drawn(scene), ElementsAre("\u2012\u2012.\u2012°", "stop", "stop"))
      << "at the cross and in view";
  SceneBuilder builder;
  render::Scene late;
  builder.update(deep, deep.tool->pose_time + deep.stale_after + Duration(1));
  builder.write_scene(deep, late);
  EXPECT_THAT(drawn(late),
              ElementsAre("\u2012\u2012.\u2012°", "stop, tool not seen", "stop, tool not seen"));
}

TEST_F(ShownNumbers, SayThatNobodyKnowsHowSureTheyAre) {
  s.registration.uncertainty.reset();
  EXPECT_THAT(told(guided({0.0012, 0.010, 0.0})).at(1), "tip 1.2 mm?");
}

}  // namespace
}  // namespace orthonav::engine::shown_numbers_test
