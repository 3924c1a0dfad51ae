#include "nav/tracking/anchored_tracker.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "tests/support/is_ok.h"

namespace orthonav::nav::anchored_tracker_test {
namespace {

constexpr Duration kCoast = std::chrono::milliseconds(100);
constexpr double kSd_m = 0.0001;
constexpr double kSd_rad = 0.0005;

PoseCovariance covariance(double sd_m, double sd_rad) {
  PoseCovariance out{};
  for (std::size_t i = 0; i < 6; ++i) {
    out[7 * i] = std::pow(i < 3 ? sd_m : sd_rad, 2);
  }
  return out;
}

/// Tools where they are said to lie in the map; absent: not seen.
class SaidTracker final : public ToolTracker {
 public:
  explicit SaidTracker(const std::vector<ToolRole>& roles) : world_from(roles.size()) {
    for (std::size_t i = 0; i < roles.size(); ++i) {
      tools_.push_back({"tool " + std::to_string(i), roles[i], {}, {}});
      tools_.back().marker.id = static_cast<int>(i);
    }
  }
  std::span<const ToolState> track(const StereoFrame& frame) override {
    states_.clear();
    for (std::size_t i = 0; i < tools_.size(); ++i) {
      ToolState state;
      state.tool = i;
      if (world_from[i] && frame.world_from_rig) {
        const Transform<Rig, Marker> rig_from = frame.world_from_rig->inverse() * *world_from[i];
        state.world_from_marker = {*world_from[i], frame.time, PoseStatus::kMeasured, {}};
        state.rig_from_marker = rig_from;
        state.pair = PairPose{rig_from, covariance(kSd_m, kSd_rad), 0.0};
      }
      states_.push_back(state);
    }
    return states_;
  }
  [[nodiscard]] std::span<const ToolGeometry> tools() const override { return tools_; }

  std::vector<std::optional<Transform<World, Marker>>> world_from;

 private:
  std::vector<ToolGeometry> tools_;
  std::vector<ToolState> states_;
};

/// A room in which everything may move: pointer, reference, and perhaps a second reference.
class Room {
 public:
  explicit Room(int references, std::span<const ReferencePlace> known = {}) {
    std::vector<ToolRole> roles = {ToolRole::kPointer};
    for (int i = 0; i < references; ++i) {
      roles.push_back(ToolRole::kReference);
    }
    auto said = std::make_unique<SaidTracker>(roles);
    tools = said.get();
    tracker = create_anchored_tracker(std::move(said), kCoast, known).value();
    tools->world_from[0] = pointer;
    for (int i = 0; i < references; ++i) {
      tools->world_from[static_cast<std::size_t>(i) + 1] =
          Transform<World, Marker>(Mat3::identity(), {0.1, 0.05 * i, 0.0});
    }
  }

  /// Pairs at 30 Hz by a head that never rests.
  const ToolState& pairs(int n) {
    for (int i = 0; i < n; ++i) {
      ++pair_;
      StereoFrame frame;
      frame.time = from_ticks_100ns(333'333 * pair_);
      const double t = static_cast<double>(pair_) / 30.0;
      frame.world_from_rig =
          Transform<World, Rig>(rotation_from_vector({0.1 * std::sin(t), 0.2 * t, 0.05}),
                                {0.02 * std::sin(3 * t), 0.5, 0.1});
      states_ = tracker->track(frame);
      now = frame.time;
    }
    return states_[0];
  }

  /// Everything on the patient is moved in the map.
  void move_patient(const Transform<World, World>& by) {
    for (auto& pose : tools->world_from) {
      if (pose) {
        pose = by * *pose;
      }
    }
  }

  Transform<World, Marker> pointer{rotation_from_vector({0.3, 0.1, -0.2}), {0.02, 0.01, 0.08}};
  SaidTracker* tools = nullptr;
  std::unique_ptr<ToolTracker> tracker;
  Timestamp now{};

 private:
  std::int64_t pair_ = 30;
  std::span<const ToolState> states_;
};

double apart_m(const Transform<World, Marker>& a, const Transform<World, Marker>& b) {
  return (a.translation() - b.translation()).norm();
}

const Transform<World, World> kPatientMoved{rotation_from_vector({0.02, -0.05, 0.01}),
                                            {0.004, -0.002, 0.003}};
/// Rounding alone.
constexpr double kSame_m = 1e-9;

TEST(AnchoredTracker, WhatRestsOnThePatientRestsWhateverMoves) {
  Room room(1);
  const Transform<World, Marker> before = room.pairs(60).world_from_marker.value;
  EXPECT_LT(apart_m(before, room.pointer), kSame_m) << "it begins where the map has it";
  room.move_patient(kPatientMoved);
  const ToolState& after = room.pairs(60);
  EXPECT_EQ(after.world_from_marker.status, PoseStatus::kMeasured);
  EXPECT_LT(apart_m(after.world_from_marker.value, before), kSame_m);
  EXPECT_LT(rotation_angle_rad(after.world_from_marker.value.rotation(), before.rotation()), 1e-9);
}

TEST(AnchoredTracker, SaysWhereItsWorldLiesInTheMap) {
  Room room(1);
  room.pairs(10);
  room.move_patient(kPatientMoved);
  const ToolState& state = room.pairs(30);
  const Anchor& anchor = *room.tracker->anchor();
  EXPECT_TRUE(anchor.in_sight);
  EXPECT_EQ(anchor.last_seen, room.now);
  EXPECT_LT(apart_m(anchor.world_from_anchored * state.world_from_marker.value,
                    *room.tools->world_from[0]),
            kSame_m);
}

TEST(AnchoredTracker, WithoutAReferenceInSightToolsAreSoonLost) {
  Room room(1);
  room.tools->world_from[1].reset();
  EXPECT_EQ(room.pairs(1).world_from_marker.status, PoseStatus::kLost) << "none was seen so far";
  room.tools->world_from[1] = Transform<World, Marker>();
  room.pairs(5);
  const Timestamp seen = room.now;
  room.tools->world_from[1].reset();
  EXPECT_EQ(room.pairs(2).world_from_marker.status, PoseStatus::kPredicted);
  EXPECT_EQ(room.pairs(2).world_from_marker.status, PoseStatus::kLost);
  EXPECT_FALSE(room.tracker->anchor()->in_sight);
  EXPECT_EQ(room.tracker->anchor()->last_seen, seen);
}

TEST(AnchoredTracker, ASecondReferenceTakesOverOnceItIsLearnt) {
  Room room(2);
  const Transform<World, Marker> before = room.pairs(40).world_from_marker.value;
  room.tools->world_from[1].reset();
  const ToolState& after = room.pairs(5);
  EXPECT_EQ(after.world_from_marker.status, PoseStatus::kMeasured);
  EXPECT_LT(apart_m(after.world_from_marker.value, before), kSame_m);
}

TEST(AnchoredTracker, ASecondReferenceThatWasNeverLearntDoesNotCount) {
  Room room(2);
  room.pairs(20);  // 30 are asked for
  room.tools->world_from[1].reset();
  EXPECT_EQ(room.pairs(5).world_from_marker.status, PoseStatus::kLost);
}

/// By how much one of two references moves, and whether that must be noticed.
struct Knock {
  double translation_m;
  double rotation_rad;
  bool noticed;
};
class OneOfTwoMoves : public ::testing::TestWithParam<Knock> {};

TEST_P(OneOfTwoMoves, IsNoticedBeyondTheLimits) {
  Room room(2);
  room.pairs(40);
  const auto& [translation_m, rotation_rad, noticed] = GetParam();
  auto& knocked = *room.tools->world_from[2];
  knocked = {rotation_from_vector({0.0, rotation_rad, 0.0}) * knocked.rotation(),
             knocked.translation() + Vec3{0.0, 0.0, translation_m}};
  room.pairs(kReferenceMovedPairs - 1);
  EXPECT_EQ(room.tracker->anchor()->moves, 0) << "a few pairs may be wrong";
  room.pairs(1);
  EXPECT_EQ(room.tracker->anchor()->moves, noticed ? 1 : 0);
  room.pairs(100);
  EXPECT_EQ(room.tracker->anchor()->moves, noticed ? 1 : 0) << "it is learnt anew";
}

INSTANTIATE_TEST_SUITE_P(Knocks, OneOfTwoMoves,
                         ::testing::Values(Knock{0.002, 0.0, true}, Knock{0.0011, 0.0, true},
                                           Knock{0.0009, 0.0, false}, Knock{0.0, 0.035, true},
                                           Knock{0.0, 0.0115, true}, Knock{0.0, 0.0095, false}));

/// The error of a relative pose, drawn: what its covariance promises must be so.
TEST(RelativeCovariance, IsThatOfTheDifferenceOfTwoPoses) {
  Random random(3);
  const auto draw = [&](double sd) {
    return Vec3{sd * random.normal(), sd * random.normal(), sd * random.normal()};
  };
  const PairPose tool{
      {rotation_from_vector({0.2, 0.1, 0.0}), {0.05, 0.02, 0.5}}, covariance(1e-4, 2e-4), 0.0};
  const PairPose reference{
      {rotation_from_vector({0.0, 0.4, 0.1}), {-0.08, 0.0, 0.45}}, covariance(5e-5, 1e-3), 0.0};
  const auto disturbed = [&](const PairPose& pose, double sd_m, double sd_rad) {
    return Transform<Rig, Marker>(
        rotation_from_vector(draw(sd_rad)) * pose.rig_from_marker.rotation(),
        pose.rig_from_marker.translation() + draw(sd_m));
  };
  // Back in the frame of the pair by the true reference, where the covariance is.
  const auto true_relative = tool.rig_from_marker;
  std::array<double, 6> squares{};
  constexpr int kDraws = 20'000;
  for (int i = 0; i < kDraws; ++i) {
    const auto seen = reference.rig_from_marker *
                      (disturbed(reference, 5e-5, 1e-3).inverse() * disturbed(tool, 1e-4, 2e-4));
    const Vec3 off_m = seen.translation() - true_relative.translation();
    const Vec3 off_rad =
        vector_from_rotation(seen.rotation() * true_relative.rotation().transposed());
    const std::array<double, 6> off = {off_m.x, off_m.y, off_m.z, off_rad.x, off_rad.y, off_rad.z};
    for (std::size_t k = 0; k < 6; ++k) {
      squares[k] += off[k] * off[k] / kDraws;
    }
  }
  const PoseCovariance promised = relative_covariance(tool, reference);
  // The SD of a variance over 20,000 draws is 1 %.
  constexpr double kWithin = 0.05;
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(squares[k] / promised[7 * k], 1.0, kWithin) << k;
  }
  // Without the lever arm it would be wrong by far.
  EXPECT_GT(promised[7] / (1e-8 + 25e-10), 2.0);
}

TEST(AnchoredTracker, RefusesToolsWithoutAReference) {
  auto alone = std::make_unique<SaidTracker>(std::vector{ToolRole::kPointer});
  EXPECT_THAT(create_anchored_tracker(std::move(alone), kCoast).error().message,
              ::testing::HasSubstr("no reference"));
}

/// An operation that is resumed: another program, another map, the same references.
TEST(AnchoredTracker, MakesTheSameWorldOfPlacesThatAreKnown) {
  Room first(2);
  const Transform<World, Marker> before = first.pairs(60).world_from_marker.value;
  ASSERT_EQ(first.tracker->anchor()->places.size(), 2u);
  EXPECT_EQ(first.tracker->anchor()->places_changed, 3) << "none, the first, the other learnt";
  const std::vector<ReferencePlace> places = first.tracker->anchor()->places;
  Room second(2, places);
  second.move_patient(kPatientMoved);
  EXPECT_LT(apart_m(second.pairs(60).world_from_marker.value, before), kSame_m);
  EXPECT_EQ(second.tracker->anchor()->moves, 0);
  Room without(2);
  without.move_patient(kPatientMoved);
  EXPECT_GT(apart_m(without.pairs(60).world_from_marker.value, before), 0.001) << "the control";
}

TEST(AnchoredTracker, NoticesThatOneOfThoseThatAreKnownMovedMeanwhile) {
  Room first(2);
  first.pairs(60);
  Room second(2, first.tracker->anchor()->places);
  second.tools->world_from[2] =
      Transform<World, Marker>(Mat3::identity(), {0.1, 0.05, 0.0 + 2.0 * kReferenceMoved_m});
  second.pairs(kReferenceMovedPairs);
  EXPECT_EQ(second.tracker->anchor()->moves, 1);
}

TEST(AnchoredTracker, WaitsForOneThatIsKnownAndRefusesAPlaceOfAnotherTool) {
  Room first(2);
  first.pairs(60);
  std::vector<ReferencePlace> places = {first.tracker->anchor()->places[0]};
  Room second(2, places);
  second.tools->world_from[1].reset();
  EXPECT_EQ(second.pairs(60).world_from_marker.status, PoseStatus::kLost)
      << "the other reference would make another World";
  places[0].tool = 0;
  const auto refused = create_anchored_tracker(
      std::make_unique<SaidTracker>(std::vector{ToolRole::kPointer, ToolRole::kReference}), kCoast,
      places);
  EXPECT_EQ(test::error_of(refused), "tools: tool 0 is not a patient reference");
}

}  // namespace
}  // namespace orthonav::nav::anchored_tracker_test
