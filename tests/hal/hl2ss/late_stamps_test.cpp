// Research mode's late stamps, and the error that they cause at a pointer's tip while the head
// turns.
#include <gmock/gmock.h>

#include "base/angle.h"
#include "hal/api/forwarding_headset.h"
#include "hal/fake/scripted.h"
#include "hal/hl2ss/hl2ss_headset.h"
#include "hal/hl2ss/server/server.h"
#include "tests/hal/hl2ss/served_room.h"
#include "tests/support/scripted_session.h"

namespace orthonav::hl2ss::late_stamps_test {
namespace {

using orthonav::test::next_pair;

constexpr int kPairs = 20;
constexpr double kRotation_rad_s = 30.0 / kDegreesPerRadian;
/// Where a pointer's tip is held: 0.45 m ahead of the head.
constexpr Point<Rig> kTipInRig{{0.0, 0.0, -0.45}};
/// 12.5 ms at 30 degrees a second are 6.5 mrad.
constexpr double kLateTipM = 0.00294;
/// Single precision of a pose over TCP.
constexpr double kSingleM = 1e-6;

Transform<World, Rig> head_at(Timestamp time) {
  return {rotation_from_vector({0.0, kRotation_rad_s * seconds(time.time_since_epoch()), 0.0}),
          {0.0, 1.6, 0.0}};
}

Timestamp pair_time(int n) { return Timestamp(std::chrono::seconds(1)) + Duration(33'333'300) * n; }

/// A head that turns steadily and knows where it is at any time.
class RotatingHead final : public HeadTracker {
  [[nodiscard]] Tracked<Transform<World, Rig>> do_world_from_rig(Timestamp at) const override {
    return {head_at(at), at, PoseStatus::kMeasured, {}};
  }
};

class RotatingHeadset final : public ForwardingHeadset {
 public:
  explicit RotatingHeadset(std::unique_ptr<fake::FakeHeadset> inner)
      : ForwardingHeadset(*inner), inner_(std::move(inner)) {}
  [[nodiscard]] HeadTracker& head() override { return head_; }

 private:
  std::unique_ptr<fake::FakeHeadset> inner_;
  RotatingHead head_;
};

Result<std::unique_ptr<Headset>> rotating_headset() {
  fake::Script script;
  script.calibration = orthonav::test::scripted_calibration();
  for (int n = 0; n < kPairs; ++n) {
    StereoFrame frame;
    frame.sequence = n;
    frame.time = pair_time(n);
    frame.left = GreyImage(640, 480, static_cast<std::uint8_t>(n));
    frame.right = frame.left;
    frame.world_from_rig = head_at(frame.time);
    script.camera.emplace_back(std::move(frame));
    // The server looks again a millisecond after each, since nothing else paces it.
    script.camera.insert(script.camera.end(), 10, Next::kNone);
  }
  return std::unique_ptr<Headset>(
      std::make_unique<RotatingHeadset>(std::make_unique<fake::FakeHeadset>(std::move(script))));
}

struct Errors {
  int pairs = 0;
  double least_m = 1.0;
  double worst_m = 0.0;
  Duration late{};  ///< of the last pair's time
};

/// The computed place of the tip seen in each image, compared with the true one.
Errors tip_errors(Duration asked_for) {
  ServerOptions served;
  served.first_port = 0;
  served.standin = false;  // as any other server
  const auto server = Server::start(served, rotating_headset);
  EXPECT_TRUE(server.ok()) << server.error().message;
  Hl2ssOptions options = (*server)->client_options();
  options.stamps_late = asked_for;
  const auto headset = Hl2ssHeadset::open(options);
  EXPECT_TRUE(headset.ok()) << headset.error().message;
  Errors errors;
  StereoFrame frame;
  int number = -1;
  while (headset && number + 1 < kPairs && next_pair(**headset, frame) == Next::kFrame) {
    number = frame.left.at(320, 240);  // the image says which it is
    const Timestamp taken = pair_time(number);
    const Point<World> tip = *frame.world_from_rig * kTipInRig;
    const double off_m = (tip.v - (head_at(taken) * kTipInRig).v).norm();
    errors.least_m = std::min(errors.least_m, off_m);
    errors.worst_m = std::max(errors.worst_m, off_m);
    errors.late = frame.time - taken;
    ++errors.pairs;
  }
  return errors;
}

TEST(LateStamps, AreCorrectedByTheServerAsTheClientAsks) {
  const Errors errors = tip_errors(kResearchModeStampsLate);
  EXPECT_GE(errors.pairs, kPairs / 2) << "a newer pair replaces one that nobody took";
  EXPECT_EQ(errors.late, Duration::zero());
  EXPECT_LT(errors.worst_m, kSingleM);
}

/// The control that must fail: a client that does not ask gets late stamps and equally late poses.
TEST(LateStamps, CostThreeMillimetresWhereNobodyAsks) {
  const Errors errors = tip_errors(Duration::zero());
  EXPECT_GE(errors.pairs, kPairs / 2);
  EXPECT_EQ(errors.late, kResearchModeStampsLate);
  EXPECT_NEAR(errors.least_m, kLateTipM, 0.00002);
  EXPECT_NEAR(errors.worst_m, kLateTipM, 0.00002);
}

}  // namespace
}  // namespace orthonav::hl2ss::late_stamps_test
