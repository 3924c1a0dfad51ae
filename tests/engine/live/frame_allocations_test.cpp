#include <gtest/gtest.h>

#include <algorithm>

#include "engine/holograms/labels/label_layout.h"
#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "hal/api/forwarding_headset.h"
#include "hal/fake/scripted.h"
#include "tests/engine/live/guided_scene.h"
#include "tests/support/allocation_count.h"
#include "tests/support/scripted_pairs.h"

namespace orthonav::engine {
namespace {

using test::guide_at;
using test::pointer_at;
using test::ScriptedOperation;

/// The buffers of one frame, as the frame loop and its snapshots keep them.
class Frames {
 public:
  void prepare(const Guidance& guidance) { builder_.prepare(guidance.levels); }
  void make(const Guidance& guidance) {
    builder_.update(guidance);
    builder_.write_shown(guidance, shown_);
    builder_.write_scene(guidance, scene_);
    write_patches(guidance, patches_);
    time_ += std::chrono::milliseconds(33);
    labels_.lay_out(scene_, views_, patches_, time_);
  }
  void make_too_late(const Guidance& guidance) {
    make(guidance);
    hide_tool_guidance(scene_);
  }
  [[nodiscard]] bool shows(HologramKind hologram) const {
    const auto is = [&](const auto& item) { return kind_of(item.label) == hologram; };
    return std::any_of(scene_.meshes.begin(), scene_.meshes.end(), is) ||
           std::any_of(scene_.lines.begin(), scene_.lines.end(), is) ||
           std::any_of(scene_.texts.begin(), scene_.texts.end(), is);
  }

 private:
  SceneBuilder builder_;
  ShownFrame shown_;
  render::Scene scene_;
  std::vector<GlarePatch> patches_;
  LabelLayout labels_;
  std::vector<render::View> views_ = render::stereo_pair(view_from(kEyeAbove));
  Timestamp time_{};
};

/// Counted once buffers have grown. Where items are taken out of a scene, those after them change
/// places, and every buffer grows to the largest.
template <class Work>
std::size_t allocations_of(const Work& work) {
  for (int i = 0; i < 20; ++i) {
    work();
  }
  const std::size_t before = test::allocation_count();
  work();
  return test::allocation_count() - before;
}

class FrameAllocations : public ::testing::Test, public GuidedScene {
 protected:
  void guide_with_twin() {
    guide();
    s.says("twin");
  }
  Frames frames;
};

TEST_F(FrameAllocations, AreNoneWhileDigitizing) {
  s.tracker().pointer = pointer_at({0, 0.02, 0});
  s.says("start");
  const Guidance& g = s.strokes(40);
  EXPECT_EQ(allocations_of([&] { frames.make(g); }), 0u);
  EXPECT_TRUE(frames.shows(HologramKind::kPath));
}

TEST_F(FrameAllocations, AreNoneWhileVerifying) {
  ScriptedOperation touched({"L4"}, {}, Verification::kByTouch);
  touched.registers_first_level();
  const Guidance& g = touched.touches({0.0, 0.0204, 0.0});
  EXPECT_EQ(allocations_of([&] { frames.make(g); }), 0u);
  EXPECT_TRUE(frames.shows(HologramKind::kVertebra));
  EXPECT_TRUE(frames.shows(HologramKind::kCheckPoint));
}

/// The bone first shows itself here; its surface is an operation's to prepare, not a frame's.
TEST_F(FrameAllocations, OfTheBonesSurfaceAreMadeBeforeTheFirstFrame) {
  ScriptedOperation touched({"L4"}, {}, Verification::kByTouch);
  touched.registers_first_level();
  const Guidance& g = touched.touches({0.0, 0.0204, 0.0});
  const auto of_the_first_frame = [&](bool prepared) {
    Frames first;
    if (prepared) {
      first.prepare(g);
    }
    const std::size_t before = test::allocation_count();
    first.make(g);
    EXPECT_TRUE(first.shows(HologramKind::kVertebra));
    return test::allocation_count() - before;
  };
  of_the_first_frame(true);               // makes what all frames of a process share
  constexpr std::size_t kOfASurface = 8;  // its vectors alone
  EXPECT_LT(of_the_first_frame(true) + kOfASurface, of_the_first_frame(false));
}

TEST_F(FrameAllocations, AreNoneWhileAWireIsShown) {
  ScriptedOperation wire({"L4"}, {}, Verification::kByTouch);
  wire.registers_within(0.0003);
  wire.accepts_first_by_touch();
  wire.touches_landmark();
  wire.says("next");
  wire.tracker().guide = guide_at(kLeftEntry, 0.1);
  wire.says("next");
  wire.does({ClickerAction::kPress});
  wire.pair();
  const Guidance& g = wire.does({ClickerAction::kRelease, ClickerAction::kClick});
  ASSERT_NE(g.wire, nullptr);
  EXPECT_EQ(allocations_of([&] { frames.make(g); }), 0u);
  EXPECT_TRUE(frames.shows(HologramKind::kTrajectory));
}

TEST_F(FrameAllocations, AreNoneWhileAToolIsGuided) {
  guide_with_twin();
  // The tool is farther off in one frame than in the other: dashes, an arrow, another number.
  const Guidance near = s.pair();
  s.tracker().guide = guide_at(kLeftEntry + Vec3{0.006, 0.010, 0}, 0.25);
  const Guidance& far = s.pair();
  const auto both = [&] {
    frames.make(near);
    frames.make(far);
  };
  EXPECT_EQ(allocations_of(both), 0u);
  using enum HologramKind;
  for (const HologramKind kind :
       {kEntry, kTrajectory, kTriangle, kAngle, kCross, kTwin, kDepth, kStatus}) {
    EXPECT_TRUE(frames.shows(kind)) << "H" << static_cast<int>(kind);
  }
}

TEST_F(FrameAllocations, AreNoneWhereGuidanceIsTakenBack) {
  guide_with_twin();
  const Guidance& g = s.pair();
  EXPECT_EQ(allocations_of([&] { frames.make_too_late(g); }), 0u);
  EXPECT_FALSE(frames.shows(HologramKind::kTriangle));
}

TEST_F(FrameAllocations, AreNoneWhileARodIsShown) {
  s.finishes_every_screw();
  s.touches({0.02, 0.03, 0.00});
  const Guidance& g = s.touches({0.02, 0.03, 0.04});
  ASSERT_TRUE(g.rods[0].rod.has_value());
  EXPECT_EQ(allocations_of([&] { frames.make(g); }), 0u);
  EXPECT_TRUE(frames.shows(HologramKind::kRod));
}

TEST_F(FrameAllocations, AreNoneWhileItIsShownHowARodIsBent) {
  s.finishes_every_screw();
  for (const Vec3& head : {Vec3{0.02, 0.030, 0.00}, Vec3{0.02, 0.035, 0.04},
                           Vec3{0.02, 0.036, 0.08}, Vec3{0.026, 0.030, 0.12}}) {
    s.touches(head);
  }
  const Guidance& g = s.pair();
  ASSERT_TRUE(g.rods[0].instructions.has_value());
  ASSERT_FALSE(g.rods[0].instructions->bends.empty());
  EXPECT_EQ(allocations_of([&] { frames.make(g); }), 0u);
}

TEST_F(FrameAllocations, OfAnotherSceneAreCounted) {
  guide_with_twin();
  const Guidance& g = s.pair();
  EXPECT_GT(allocations_of([&] { Frames().make(g); }), 0u);
}

/// Delivers the same dark pair, every 33 ms of its clock.
class EndlessCamera : public StereoCamera {
 public:
  EndlessCamera(fake::FakeHeadset& inner, int count) : inner_(inner), left_(count) {}

 private:
  fake::FakeHeadset& inner_;
  int left_;
  std::int64_t next_ = 0;
  const StereoFrame pair_ = test::dark_pair(0);
  [[nodiscard]] const StereoCalibration& do_calibration() const override {
    return inner_.cameras()->calibration();
  }
  [[nodiscard]] MayRepeat do_may_repeat() const override { return {true, true}; }
  Result<Next> do_next(StereoFrame& frame) override {
    if (left_-- == 0) {
      return Next::kEnd;
    }
    const Timestamp time = inner_.clock().now() + test::kPair;
    inner_.manual_clock().set(time);
    frame = pair_;
    frame.sequence = next_++;
    frame.time = time;
    return Next::kFrame;
  }
};

class EndlessHeadset : public ForwardingHeadset {
 public:
  EndlessHeadset(fake::FakeHeadset& inner, int count)
      : ForwardingHeadset(inner), cameras_(inner, count) {}
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }

 private:
  EndlessCamera cameras_;
};

/// Counts what any thread allocates from a pair on.
class Counting : public LoopObserver, public SnapshotSink {
 public:
  explicit Counting(int warm) : warm_(warm) {}
  void stepped(const FrameHeader&, const Inputs&, const Guidance&) override {
    if (warm_-- == 0) {
      before_ = test::allocation_count();
    }
    counted = test::allocation_count() - before_;
  }
  Status draw(const Snapshot&) override { return {}; }
  std::size_t counted = 0;

 private:
  int warm_;
  std::size_t before_ = 0;
};

/// Longer than a vector of one value a pair goes without growing.
constexpr int kWarmPairs = 150;
constexpr int kPairs = 600;

TEST(FrameLoopAllocations, AreNoneHoweverLongItRuns) {
  for (const bool real_time : {false, true}) {
    SCOPED_TRACE(real_time);
    GuidedScene scene;
    scene.guide();
    fake::FakeHeadset inner(test::pairs(0));
    EndlessHeadset headset(inner, kPairs);
    SceneBuilder builder;
    LoopOptions options;
    options.real_time = real_time;
    FrameLoop loop(headset, scene.s.session(), builder, options);
    Counting counting(kWarmPairs);
    loop.observe(&counting);
    loop.draw_into(&counting);
    const LoopReport report = loop.run();
    ASSERT_TRUE(report.ended.ok()) << report.ended.error().message;
    EXPECT_EQ(report.displayed, kPairs);
    EXPECT_EQ(report.step_wall_ms.count(), kPairs);
    EXPECT_EQ(counting.counted, 0u);
  }
}

TEST(FrameLoopAllocations, OfTheFirstPairsAreCounted) {
  GuidedScene scene;
  scene.guide();
  fake::FakeHeadset inner(test::pairs(0));
  EndlessHeadset headset(inner, 5);
  SceneBuilder builder;
  FrameLoop loop(headset, scene.s.session(), builder, {});
  Counting counting(0);
  loop.observe(&counting);
  loop.draw_into(&counting);
  ASSERT_TRUE(loop.run().ended.ok());
  EXPECT_GT(counting.counted, 0u);
}

}  // namespace
}  // namespace orthonav::engine
