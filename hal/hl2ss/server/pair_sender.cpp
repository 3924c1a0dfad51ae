#include "hal/hl2ss/server/pair_sender.h"

#include <algorithm>
#include <vector>

#include "hal/hl2ss/server/packets.h"

namespace orthonav::hl2ss {
namespace {

/// Sensor ticks are on a different clock than the stamps, and the cameras differ slightly in both.
constexpr Duration kSensorAhead(765'432'100);
constexpr Duration kRightSensorAhead(10);
constexpr std::int64_t kRightLaterTicks = 1'500;
constexpr int kSamplesAPair = kMicrophoneHz / 30;
/// The first pairs open the connection and have no faults.
constexpr std::int64_t kUntouchedPairs = 3;

/// The picture as sent: while it is frozen, the one with which that began.
const GreyImage& sent(const GreyImage& picture, bool frozen, GreyImage& kept) {
  if (!frozen) {
    kept.clear();
    return picture;
  }
  if (kept.pixels.empty()) {
    kept = picture;
  }
  return kept;
}

}  // namespace

void PairSender::restart() {
  pairs_ = 0;
  frozen_left_.clear();
  frozen_right_.clear();
  last_right_.clear();
  frozen_pose_.reset();
  const MutexLock lock(mutex_);
  jumped_from_world_ = {};
}

Transform<World, World> PairSender::jumped_from_world() const {
  const MutexLock lock(mutex_);
  return jumped_from_world_;
}

Transform<World, World> PairSender::world_from_jumped() const {
  return jumped_from_world().inverse();
}

std::int64_t PairSender::faults_done() const {
  return struck_ + left_.faults_done() + right_.faults_done();
}

Result<bool> PairSender::send(Headset& headset, const StereoFrame& frame) {
  const std::int64_t number = pairs_++;
  if (std::count(faults_.jump_at.begin(), faults_.jump_at.end(), number) > 0) {
    jump();
  }
  back_ = strikes(faults_.clock_back) ? faults_.clock_back_by : Duration::zero();
  send_events(headset, frame);
  const bool gap = strikes(faults_.gap);
  const bool unlocated = strikes(faults_.unlocated);
  if (gap) {
    return false;
  }
  CameraPort::Image image;
  image.ticks = ticks_100ns(frame.time - back_);
  const Duration sensor_time = frame.time.time_since_epoch() + kSensorAhead;
  image.sensor_ticks = static_cast<std::uint64_t>(sensor_time.count());
  const bool both_freeze = strikes(faults_.freeze_pictures);
  image.picture = &sent(frame.left, strikes(faults_.freeze_left) || both_freeze, frozen_left_);
  image.spoil = number >= kUntouchedPairs;
  const bool pose_freezes = strikes(faults_.freeze_poses);
  image.world_from_rig_after = [&](Duration after) {
    const auto pose = unlocated ? std::nullopt : world_from_rig(headset, frame, after);
    if (!pose_freezes) {
      frozen_pose_.reset();
      return pose;
    }
    if (!frozen_pose_) {
      frozen_pose_ = pose;
    }
    return frozen_pose_;
  };
  const auto left = left_.send(image);
  image.ticks += kRightLaterTicks;
  image.sensor_ticks += static_cast<std::uint64_t>(kRightSensorAhead.count());
  image.picture = &sent(frame.right, strikes(faults_.freeze_right) || both_freeze, frozen_right_);
  const bool shifts = strikes(faults_.shift_right) && !last_right_.pixels.empty();
  GreyImage next_right;
  if (faults_.shift_right) {
    next_right = *image.picture;
  }
  if (shifts) {
    image.picture = &last_right_;
  }
  const bool alone = strikes(faults_.only_left);
  const auto right = alone ? Result<bool>(false) : right_.send(image);
  last_right_ = std::move(next_right);
  if (!left) {
    return left;
  }
  if (!right) {
    return right;
  }
  // While a clock that was set is doubted, nothing is taken.
  return *left && *right && back_ == Duration::zero();
}

/// The pose in the client's world.
std::optional<Transform<World, Rig>> PairSender::world_from_rig(Headset& headset,
                                                                const StereoFrame& frame,
                                                                Duration after) const {
  if (!frame.world_from_rig) {
    return std::nullopt;
  }
  // For the pair's own time, exactly the pair's pose.
  if (after == Duration::zero()) {
    return jumped_from_world() * *frame.world_from_rig;
  }
  const auto then = headset.head().world_from_rig(frame.time + after);
  if (then.status == PoseStatus::kLost) {
    return std::nullopt;
  }
  return jumped_from_world() * then.value;
}

void PairSender::send_events(Headset& headset, const StereoFrame& frame) {
  std::vector<ClickerEvent> clicks;
  std::vector<Phrase> phrases;
  (void)headset.clicker().poll(frame.time, clicks);
  (void)headset.voice().poll(frame.time, phrases);
  for (Phrase& phrase : phrases) {
    phrase.time -= back_;
  }
  sides_.tell(clicks, phrases, {frame.time, headset.clock().now()});
  if (sides_.hears.load()) {
    sides_.microphone.send({{packet_bytes(ticks_100ns(frame.time - back_),
                                          tone_bytes(kSamplesAPair * pairs_, kSamplesAPair))}});
  }
}

void PairSender::jump() {
  ++struck_;
  const MutexLock lock(mutex_);
  jumped_from_world_ =
      Transform<World, World>(rotation_from_vector({0, faults_.jump_rad, 0}), faults_.jump_m) *
      jumped_from_world_;
}

bool PairSender::strikes(const std::optional<std::int64_t>& from) {
  const bool strike = faults_.strikes(from, pairs_ - 1);
  struck_ += strike ? 1 : 0;
  return strike;
}

bool PairSender::strikes(double probability) {
  const bool strike = pairs_ > kUntouchedPairs && random_.uniform() < probability;
  struck_ += strike ? 1 : 0;
  return strike;
}

}  // namespace orthonav::hl2ss
