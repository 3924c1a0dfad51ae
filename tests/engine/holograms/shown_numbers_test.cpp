// H13 as it is drawn and told.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/printed.h"
#include "engine/holograms/hologram_label.h"
#include "engine/holograms/scene_builder.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine::shown_numbers_test {
namespace {

using test::guide_at;
using test::ScriptedOperation;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
constexpr Vec3 kRightEntry{-0.015, 0.020, 0.0};

struct Told {
  std::vector<std::string> texts;
  std::vector<double> readings;
  std::string status;
  std::string clearance;
};

Told told(const Guidance& g, std::optional<Timestamp> at = std::nullopt) {
  SceneBuilder builder;
  ShownFrame frame;
  builder.update(g, at.value_or(g.display_time));
  builder.write_shown(g, frame);
  Told out;
  for (const ShownHologram& hologram : frame.holograms) {
    if (hologram.kind == HologramKind::kNumbers && !hologram.reading) {
      out.clearance = hologram.text.starts_with("clearance") ? hologram.text : out.clearance;
    } else if (hologram.kind == HologramKind::kNumbers) {
      out.texts.push_back(hologram.text);
      out.readings.push_back(hologram.reading.value_or(-1.0));
    }
  }
  out.status = frame.status->text;
  return out;
}

/// Every text of H13 in a scene, and of its row in the status line.
std::vector<std::string> drawn(const render::Scene& scene) {
  std::vector<std::string> texts;
  for (const render::TextItem& text : scene.texts) {
    if (kind_of(text.label) == HologramKind::kNumbers) {
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
  static std::string lateral_with_sd(double sd_m) {
    return printed("1.2 ± %.1f mm lateral", std::ceil(1e4 * sd_m) / 10.0);
  }
  ScriptedOperation s;
  Vec3 entry = kLeftEntry;
};

TEST_F(ShownNumbers, SayWhereTheTipIsAndWhereTheToolAims) {
  // +x is to the patient's left: lateral of the left screw. The shaft leans to the right, medially,
  // so the tool aims lateral.
  const Told here = told(guided({0.0012, 0.010, 0.0008}, 0.0349));
  EXPECT_THAT(here.texts, ElementsAre("0.8 mm cranial", "1.2 mm lateral", "0.0°", "2.0° lateral"));
  ASSERT_EQ(here.readings.size(), 4u);
  EXPECT_NEAR(here.readings[0], 0.0008, 1e-12);
  EXPECT_NEAR(here.readings[1], -0.0012, 1e-12);
  EXPECT_NEAR(here.readings[3], -2.0 * 3.14159265358979 / 180.0, 1e-9);
  EXPECT_THAT(here.status, ::testing::EndsWith(
                               " | tip 0.8 mm cranial, 1.2 mm lateral; aims 0.0°, 2.0° lateral"));
}

TEST_F(ShownNumbers, NameTheSameWayMedialOnTheOtherSide) {
  guided({});
  s.says("next");
  entry = kRightEntry;
  EXPECT_EQ(told(guided({0.0012, 0.010, 0.0})).texts.at(1), "1.2 mm medial");
}

TEST_F(ShownNumbers, AreAbsentWhereTheToolWasNotMeasuredInThisPair) {
  ASSERT_EQ(told(guided({})).texts.size(), 4u);
  s.tracker().guide_origin = PoseStatus::kPredicted;
  const Guidance& predicted = s.pair();
  EXPECT_THAT(told(predicted).texts, IsEmpty());
  EXPECT_THAT(drawn(scene_of(predicted)), IsEmpty());
}

TEST_F(ShownNumbers, GoWithAPoseThatIsTooOldWhereverTheyStand) {
  const Guidance& g = guided({});
  render::Scene scene = scene_of(g);
  EXPECT_EQ(drawn(scene).size(), 12u) << "four numbers, tip, aims, clearance and bound with their "
                                         "words and what they are of, the row";
  const Told late = told(g, g.tool->pose_time + g.stale_after + Duration(1));
  EXPECT_THAT(late.texts, IsEmpty());
  EXPECT_THAT(late.status, ::testing::Not(::testing::HasSubstr("tip")));
  hide_tool_guidance(scene);
  EXPECT_THAT(drawn(scene), IsEmpty());
}

TEST_F(ShownNumbers, GoWithTheHead) {
  render::Scene left;
  write_head_lost(scene_of(guided({})), left);
  EXPECT_FALSE(left.texts.empty());
  EXPECT_THAT(drawn(left), IsEmpty());
}

TEST_F(ShownNumbers, AreGreyedWithTheirSdsWhereTheyAreNotSure) {
  know_registration(0.00149);
  const Guidance& g = guided({0.0012, 0.010, 0.0});
  EXPECT_EQ(told(g).texts.at(1), lateral_with_sd(std::hypot(0.00149, test::guide_sd_m())));
  EXPECT_THAT(drawn(scene_of(g)), ::testing::Contains("± registration only"))
      << "nobody knows what all strokes share";
}

TEST_F(ShownNumbers, CountOfTheCamerasErrorWhatToolAndBoneDoNotShare) {
  ScriptedOperation few, much;
  const Guidance& shared = guided_with_cameras_off(few, 0.0014);
  EXPECT_EQ(told(shared).texts.at(1), "1.2 mm lateral") << "three tenths of it: still sure";
  EXPECT_THAT(drawn(scene_of(shared)), ::testing::Not(::testing::Contains("± registration only")));
  EXPECT_EQ(told(guided_with_cameras_off(much, 0.0070)).texts.at(1),
            lateral_with_sd(std::hypot(0.0003, test::guide_sd_m(), 0.3 * 0.0070)));
}

TEST_F(ShownNumbers, HaveTheClearanceBelowThem) {
  // The wall at x = 30 mm, a radius of 3 mm; of the bound's SD most is that of the guide, which was
  // not compared with the pointer.
  const std::string inside = told(guided({0.00855, 0.010, 0.0})).clearance;
  EXPECT_THAT(inside, ::testing::StartsWith("clearance 3.4 mm, at least "));
  EXPECT_THAT(inside, ::testing::EndsWith(" mm (registration only)"));
  const Told near = told(guided({0.01185, 0.010, 0.0}));
  EXPECT_EQ(near.clearance, "clearance 0.1 mm: may break through laterally (registration only)");
  const Guidance& out = guided({0.01305, 0.010, 0.0});
  EXPECT_EQ(told(out).clearance, "clearance −1.1 mm: breaks through laterally");
  EXPECT_THAT(drawn(scene_of(out)), ::testing::Contains("breaks through laterally"));
  s.tracker().guide_origin = PoseStatus::kPredicted;
  EXPECT_EQ(told(s.pair()).clearance, "") << "with the measurement";
}

TEST_F(ShownNumbers, SayHowTheDrillGoesAndKeepTheStop) {
  guided({0, 0, 0});
  s.pairs(20);
  EXPECT_THAT(drawn(scene_of(s.pair())), ::testing::Contains("tip set"));
  EXPECT_THAT(drawn(scene_of(guided({0.0025, -0.004, 0}))),
              ::testing::Contains("drilling: off plan"));
  const Guidance& deep = guided({0, -0.0345, 0});
  render::Scene scene = scene_of(deep);
  EXPECT_THAT(drawn(scene), ::testing::Contains("stop"));
  render::Scene left;
  write_head_lost(scene, left);
  EXPECT_THAT(drawn(left), ElementsAre("stop")) << "in view wherever the head is";
  hide_tool_guidance(scene);
  EXPECT_THAT(drawn(scene), ElementsAre("stop", "stop")) << "at the cross and in view";
  SceneBuilder builder;
  render::Scene late;
  builder.update(deep, deep.tool->pose_time + deep.stale_after + Duration(1));
  builder.write_scene(deep, late);
  EXPECT_THAT(drawn(late), ElementsAre("stop, tool not seen", "stop, tool not seen"));
}

TEST_F(ShownNumbers, SayThatNobodyKnowsHowSureTheyAre) {
  s.registration.uncertainty.reset();
  EXPECT_THAT(told(guided({0.0012, 0.010, 0.0})).texts.at(1), "1.2 ± -- mm lateral");
}

}  // namespace
}  // namespace orthonav::engine::shown_numbers_test
