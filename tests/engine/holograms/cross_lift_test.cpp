// The target cross with its numbers makes way for the rows that hang on the head.
#include "engine/holograms/cross_lift.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "engine/holograms/hologram_label.h"
#include "engine/holograms/hologram_numbers.h"
#include "engine/holograms/hologram_status.h"
#include "engine/holograms/label_layout.h"
#include "render/float3.h"
#include "tests/engine/holograms/operating_field.h"

namespace orthonav::engine::cross_lift_test {
namespace {

using render::Float3;
using test::OperatingField;
using ::testing::IsEmpty;

constexpr render::Label kCross = label_of(HologramKind::kCross, 1);
constexpr Float3 kEye = {0, 0.45f, 0};
constexpr Float3 kHeadUp = {0, 0, -1};
constexpr Duration kFrame = std::chrono::milliseconds(33);
constexpr float kRounding_m = 1e-5f;

TargetCross cross_at_origin() {
  TargetCross cross;
  cross.outward = {0, 1, 0};
  cross.viewer = {kEye, kHeadUp};
  cross.side = LabelSide::kRight;
  cross.reading = CrossReading{{0.0022f, 0, 0.0012f}, {0.001f, 0, 0.004f}, Grade::kPoor};
  return cross;
}

/// A screw in the origin is being guided: cross, numbers, clearance and its bound; the status line
/// with the numbers' row above it.
OperatingField guided() {
  OperatingField field;
  const TargetCross cross = cross_at_origin();
  nav::ScrewNumbers numbers;
  numbers.tip_cranial = numbers.tip_medial = numbers.aim_cranial = {12, 4, true};
  numbers.aim_medial = {42, 4, true};
  nav::ShownClearance clearance;
  clearance.least_tenths = 25;
  clearance.lower_95_tenths = 6;
  add_target_cross(field.scene, cross, kCross);
  add_numbers(field.scene, cross, numbers, false, label_of(HologramKind::kNumbers, 1), true);
  add_clearance(field.scene, cross, clearance, label_of(HologramKind::kNumbers, 3));
  const std::array<ToolDot, 2> tools = {
      {{"guide", ToolState::kMeasured}, {"reference", ToolState::kMeasured}}};
  add_status_line(field.scene, "guide L5 right | RMSE 1.37 mm, expected error 1.9 mm", tools,
                  label_of(HologramKind::kStatus, 1));
  add_row_above_status(field.scene,
                       "tip 1.2 mm cranial, 1.2 mm medial; aims 1.2° caudal, 4.2° lateral",
                       label_of(HologramKind::kNumbers, 2));
  return field;
}

/// Both eyes above the site, which they see so far below the middle of their view.
std::vector<render::View> site_below(float angle_deg, float roll_rad = 0) {
  const float angle_rad = angle_deg * 3.14159265f / 180.0f;
  const Float3 ahead = Float3{0, -std::cos(angle_rad), -std::sin(angle_rad)};
  const Float3 up = {std::sin(roll_rad), 0, -std::cos(roll_rad)};
  return render::stereo_pair(render::look_at(kEye, kEye + ahead, up, 0.394f, 0.2561f));
}

/// Where the cross is after one more frame.
class Frames {
 public:
  Float3 next(const std::vector<render::View>& views) {
    OperatingField field = guided();
    layout_.lay_out(field.scene, views, {}, Timestamp{} + ++frame_ * kFrame);
    return disc_of(field.scene, kCross)->middle;
  }

 private:
  LabelLayout layout_;
  int frame_ = 0;
};

constexpr float kClear_deg = -2.0f;
constexpr float kInTheWay_deg = 8.0f;

Float3 as_built() { return disc_of(guided().scene, kCross)->middle; }

TEST(CrossLift, LeavesABlockThatIsInNobodysWay) {
  const OperatingField built = guided();
  OperatingField field = guided();
  LabelLayout().lay_out(field.scene, site_below(kClear_deg), {}, Timestamp{});
  EXPECT_EQ(field.scene.texts, built.scene.texts);
  EXPECT_EQ(disc_of(field.scene, kCross)->middle, as_built());
}

TEST(CrossLift, KeepsTheNumbersOffTheStatusLineWhereverTheSiteIsInView) {
  std::size_t faults_before = 0;
  // Until the cross itself is below the view; farther out, a rolled head's texts are askew.
  for (float below_deg = -15; below_deg <= 24; below_deg += 0.5f) {
    for (const float roll_rad : {-0.2f, 0.0f, 0.2f}) {
      const auto views = site_below(below_deg, roll_rad);
      OperatingField field = guided();
      faults_before += test::faults(field, views).size();
      LabelLayout().lay_out(field.scene, views, {}, Timestamp{});
      EXPECT_THAT(test::faults(field, views), IsEmpty()) << below_deg << ", roll " << roll_rad;
    }
  }
  EXPECT_GT(faults_before, 0u) << "nothing is in the way here";
}

TEST(CrossLift, TurnsTheWholeBlockAboutTheEyes) {
  const OperatingField built = guided();
  OperatingField field = guided();
  const auto views = site_below(kInTheWay_deg);
  LabelLayout().lay_out(field.scene, views, {}, Timestamp{});
  const Float3 eyes = render::head_of(views).position;
  const Float3 middle = disc_of(field.scene, kCross)->middle;
  EXPECT_LT(middle.z, as_built().z - 0.005f) << "upwards in the view";
  EXPECT_NEAR(middle.x, as_built().x, 0.001f) << "not aside";
  const auto stays = [&](Float3 before, Float3 after) {
    EXPECT_NEAR(render::length(after - eyes), render::length(before - eyes), kRounding_m);
    EXPECT_NEAR(render::length(after - middle), render::length(before - as_built()), kRounding_m);
  };
  for (std::size_t i = 0; i < built.scene.texts.size(); ++i) {
    const render::TextItem& text = built.scene.texts[i];
    if (text.place == render::TextPlace::kWorld) {
      stays(text.position, field.scene.texts[i].position);
    }
  }
  for (std::size_t i = 0; i < built.scene.lines.size(); ++i) {
    stays(built.scene.lines[i].points.front(), field.scene.lines[i].points.front());
  }
  ASSERT_FALSE(built.scene.meshes.empty()) << "the dot of the tip";
  const auto place = [](const OperatingField& of) {
    const render::Matrix4& m = of.scene.meshes[0].world_from_model;
    return Float3{m[12], m[13], m[14]};
  };
  stays(place(built), place(field));
}

TEST(CrossLift, GoesUpAtOnceAndComesDownAfterASecondOfRoom) {
  Frames frames;
  EXPECT_EQ(frames.next(site_below(kClear_deg)), as_built());
  const Float3 lifted = frames.next(site_below(kInTheWay_deg));
  EXPECT_NE(lifted, as_built());
  const int frames_of_a_second = static_cast<int>(LabelLayout::kSettled / kFrame);
  for (int i = 0; i <= frames_of_a_second; ++i) {
    EXPECT_NE(frames.next(site_below(kClear_deg)), as_built()) << i;
  }
  frames.next(site_below(kClear_deg));
  EXPECT_EQ(frames.next(site_below(kClear_deg)), as_built());
}

/// The steps that the block takes while the head nods by these angles in turn.
struct Steps {
  int count = 0;
  int reverted = 0;  ///< within a second
};
Steps steps_over(const std::vector<float>& below_deg) {
  Frames frames;
  Steps steps;
  std::optional<Float3> before;
  std::optional<Float3> left;
  std::size_t left_at = 0;
  for (std::size_t i = 0; i < below_deg.size(); ++i) {
    const Float3 now = frames.next(site_below(below_deg[i]));
    if (before && render::length(now - *before) > 0.002f) {
      ++steps.count;
      const bool soon = static_cast<int>(i - left_at) * kFrame < LabelLayout::kSettled;
      steps.reverted += left && soon && render::length(now - *left) < 0.002f ? 1 : 0;
      left = before;
      left_at = i;
    }
    before = now;
  }
  return steps;
}

TEST(CrossLift, DoesNotFollowATremblingHead) {
  constexpr double kTremble_deg = 0.1;
  for (float below_deg = 0; below_deg <= 20; below_deg += 0.5f) {
    Random random(5);
    std::vector<float> angles_deg;
    for (int i = 0; i < 450; ++i) {
      angles_deg.push_back(below_deg + static_cast<float>(random.normal(0, kTremble_deg)));
    }
    // A place at the edge of what is free may be left, once.
    EXPECT_LE(steps_over(angles_deg).count, 1) << below_deg;
  }
}

TEST(CrossLift, TakesFewStepsWhileTheHeadNodsAndNoneBackWithinASecond) {
  std::vector<float> angles_deg;
  for (int i = 0; i < 900; ++i) {
    const float turn = 2 * 3.14159265f * static_cast<float>(i) / 450.0f;
    angles_deg.push_back(5.0f - 7.0f * std::cos(turn));  // twice from -2 to 12 degrees and back
  }
  const Steps steps = steps_over(angles_deg);
  EXPECT_GE(steps.count, 4);
  EXPECT_LE(steps.count, 40);
  EXPECT_EQ(steps.reverted, 0);
}

TEST(CrossLift, GoesHigherRatherThanOverAnEntryPoint) {
  const auto views = site_below(kInTheWay_deg);
  OperatingField alone = guided();
  LabelLayout().lay_out(alone.scene, views, {}, Timestamp{});
  const Float3 lifted = disc_of(alone.scene, kCross)->middle;
  // Just above the ring as it was lifted, so that one more step would cover it.
  OperatingField field = guided();
  add_entry(field.scene, {lifted, {0, 1, 0}, "", false, LabelSide::kRight},
            label_of(HologramKind::kEntry, 1));
  LabelLayout().lay_out(field.scene, views, {}, Timestamp{});
  EXPECT_NE(disc_of(field.scene, kCross)->middle, lifted);
  EXPECT_THAT(test::faults(field, views), IsEmpty());
}

}  // namespace
}  // namespace orthonav::engine::cross_lift_test
