#include "engine/holograms/labels/gaze_anchor.h"

#include <gtest/gtest.h>

#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/shapes/screw_holograms.h"
#include "tests/engine/live/guided_scene.h"

namespace orthonav::engine::gaze_anchor_test {
namespace {

using std::chrono::milliseconds;

/// How far the cross moves, as seen from the head, while the eyes look at different places.
class Gazing : public ::testing::Test {
 protected:
  struct Place {
    double out_m = 0.0;  ///< towards the side of the site on which the cross hangs
    double up_m = 0.0;
  };

  void SetUp() override {
    guided_.guide();
    guidance_ = guided_.s.pair();
    const Guidance& g = guidance();
    guidance_.head = Transform<World, Rig>{Mat3::identity(), {0.0, 0.32, 0.25}};
    begin_ = hangs_at();
    ASSERT_TRUE(builder_.visible().trajectory.has_value());
    site_ = site_of(builder_.visible().trajectory->at);
    towards_ = (g.head->translation() - site_.v).normalized();
    out_ = g.head->rotation().column(1).cross(towards_).normalized();
    up_ = towards_.cross(out_);
    if (out_.dot(begin_ - site_.v) < 0.0) {
      out_ = -1.0 * out_;
    }
  }

  [[nodiscard]] const Guidance& guidance() const { return guidance_; }
  /// The middle of the outermost ring.
  Vec3 hangs_at() {
    builder_.update(guidance(), now_);
    scene_.clear();
    builder_.write_scene(guidance(), scene_);
    Vec3 middle{};
    for (const render::LineItem& line : scene_.lines) {
      if (line.label != label_of(HologramKind::kCross, 1)) {
        continue;
      }
      middle = {};
      for (const render::Float3 p : line.points) {
        middle +=
            Vec3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)} /
            static_cast<double>(line.points.size());
      }
    }
    return middle;
  }
  /// Rests the eyes on a place of the site for that long; returns how far the cross has moved since
  /// the beginning.
  Place look(const Place& at, Duration how_long) {
    for (const Timestamp until = now_ + how_long; now_ < until; now_ += milliseconds(25)) {
      const Vec3 target = site_.v + at.out_m * out_ + at.up_m * up_;
      const Vec3 eye = guidance().head->translation();
      builder_.look_at(
          Gaze{Point<World>{eye}, Direction<World>{(target - eye).normalized()}, now_});
      hangs_at();
    }
    builder_.look_at(std::nullopt);
    return moved();
  }
  Place moved() {
    const Vec3 by = hangs_at() - begin_;
    return {out_.dot(by), up_.dot(by)};
  }

  GuidedScene guided_;
  Guidance guidance_;
  SceneBuilder builder_;
  render::Scene scene_;
  Timestamp now_ = guidance_time();
  Vec3 begin_;
  Point<World> site_;
  Vec3 towards_;
  Vec3 out_;
  Vec3 up_;

 private:
  static Timestamp guidance_time() { return Timestamp(std::chrono::seconds(1000)); }
};

constexpr double kFloat_m = 1e-5;
// The cross faces the eyes, so its "above" and "aside" turn a little when it moves.
constexpr double kTurned_m = 0.003;

TEST_F(Gazing, MovesTheCrossBesideWhatTheEyesRestOn) {
  const Place moved = look({0.010, -0.030}, milliseconds(700));
  EXPECT_NEAR(moved.out_m, 0.010, kTurned_m);
  EXPECT_NEAR(moved.up_m, -0.030, kTurned_m);
  now_ += std::chrono::seconds(10);
  EXPECT_NEAR(this->moved().up_m, -0.030, kTurned_m) << "eyes that are no longer seen";
}

TEST_F(Gazing, DoesNotFollowAGlance) {
  EXPECT_NEAR(look({0.010, -0.030}, milliseconds(400)).up_m, 0.0, kFloat_m);
  EXPECT_NEAR(look({0.005, 0.0}, milliseconds(400)).up_m, 0.0, kFloat_m);
  EXPECT_NEAR(look({0.010, -0.030}, milliseconds(400)).up_m, 0.0, kFloat_m)
      << "two glances are no rest";
}

TEST_F(Gazing, StaysForWhatIsNearItAlready) {
  look({0.0, -0.030}, milliseconds(700));
  EXPECT_NEAR(look({0.0, -0.015}, milliseconds(700)).up_m, -0.030, kTurned_m);
  EXPECT_NEAR(look({0.0, -0.005}, milliseconds(700)).up_m, -0.005, kTurned_m);
}

TEST_F(Gazing, StaysForEyesThatLookAtTheCrossOrElsewhere) {
  const Vec3 by = begin_ - site_.v;
  const Place cross = {out_.dot(by), up_.dot(by)};
  EXPECT_NEAR(look(cross, milliseconds(700)).out_m, 0.0, kFloat_m);
  EXPECT_NEAR(look({cross.out_m, cross.up_m - 0.05}, milliseconds(700)).out_m, 0.0, kFloat_m)
      << "its numbers";
  EXPECT_NEAR(look({0.0, -0.2}, milliseconds(700)).up_m, 0.0, kFloat_m) << "far from the site";
}

TEST_F(Gazing, NeverHangsTheCrossOverAnEntryPoint) {
  // So far from the cross that, if it followed, it would hang over the site.
  EXPECT_NEAR(look({-0.038, -0.010}, milliseconds(1000)).out_m, 0.0, kFloat_m);
}

TEST_F(Gazing, StaysForAHeadWhoseUprightPointsAtTheSite) {
  guidance_.head = Transform<World, Rig>{Mat3::identity(), site_.v + Vec3{0.0, 0.4, 0.0}};
  begin_ = hangs_at();
  EXPECT_EQ(look({0.0, 0.0}, milliseconds(700)).out_m, 0.0);
}

TEST_F(Gazing, ChangesNothingWhereThereIsNone) {
  const Vec3 before = hangs_at();
  now_ += std::chrono::seconds(2);
  EXPECT_EQ(hangs_at(), before);
}

}  // namespace
}  // namespace orthonav::engine::gaze_anchor_test
