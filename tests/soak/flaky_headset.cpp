#include "tests/soak/flaky_headset.h"

#include <algorithm>

#include "study/surgeon/written_frame.h"

namespace orthonav::soak {
namespace {

/// The oldest pose that guidance may show (docs/safety.md).
constexpr Duration kStaleAfter = std::chrono::milliseconds(100);

int between(Random& random, int low, int high) {
  return static_cast<int>(random.uniform(low, high + 1));
}

bool depends_on_tool(const engine::ShownHologram& hologram) {
  return hologram.kind == engine::HologramKind::kTriangle ||
         (hologram.kind == engine::HologramKind::kAngle && hologram.reading.has_value());
}

}  // namespace

FlakyHeadset::FlakyHeadset(Headset& inner, Random random, const Chances& chances)
    : ForwardingHeadset(inner),
      weather_{.random = random, .chances = chances},
      cameras_(*inner.cameras(), weather_),
      voice_(inner.voice(), weather_),
      glasses_(*inner.wearer(), weather_) {}

void FlakyHeadset::Cameras::begin_trouble() {
  Weather& w = weather_;
  const auto count = [&](Trouble trouble) { ++w.done[static_cast<std::size_t>(trouble)]; };
  if (w.random.uniform() < w.chances.device_loss) {
    count(Trouble::kDeviceLoss);
    w.lost = true;
  }
  if (w.random.uniform() < w.chances.map_jump) {
    count(Trouble::kMapJump);
    ++w.map_epoch;
    w.jumped_from_world =
        Transform<World, World>{rotation_from_vector({0.0, 0.0, w.random.uniform(-0.5, 0.5)}),
                                {w.random.uniform(-0.3, 0.3), 0.1, 0.0}} *
        w.jumped_from_world;
  }
  if (w.random.uniform() >= w.chances.any) {
    return;
  }
  const auto kind = static_cast<Trouble>(between(w.random, 0, 4));
  count(kind);
  switch (kind) {
    case Trouble::kDrop:
      w.silent_pairs = 1;
      break;
    case Trouble::kStall:
      w.silent_pairs = between(w.random, 5, 60);
      break;
    case Trouble::kReconnect:
      w.failing_pairs = between(w.random, 1, 25);
      break;
    case Trouble::kNoPose:
      w.unlocated_pairs = between(w.random, 3, 45);
      break;
    default:
      w.mute_polls = between(w.random, 5, 90);
  }
}

Result<Next> FlakyHeadset::Cameras::do_next(StereoFrame& frame) {
  begin_trouble();
  auto next = ForwardingCamera::do_next(frame);
  if (!next || *next != Next::kFrame) {
    return next;
  }
  Weather& w = weather_;
  if (w.lost || w.failing_pairs > 0) {
    w.failing_pairs -= w.failing_pairs > 0 ? 1 : 0;
    return Error{"connection lost"};
  }
  if (w.silent_pairs > 0) {
    --w.silent_pairs;
    return Next::kNone;
  }
  frame.map_epoch = w.map_epoch;  // the room's never changes
  if (w.unlocated_pairs > 0) {
    --w.unlocated_pairs;
    frame.world_from_rig.reset();
  } else if (frame.world_from_rig) {
    frame.world_from_rig = w.jumped_from_world * *frame.world_from_rig;
  }
  return next;
}

Status FlakyHeadset::Speech::do_poll(Timestamp until, std::vector<Phrase>& phrases) {
  if (weather_.mute_polls > 0) {
    --weather_.mute_polls;
    return Error{"voice: mute", ErrorCode::kUnavailable};
  }
  return inner_.poll(until, phrases);
}

/// The wearer sees the holograms in the room's map, which did not jump.
void FlakyHeadset::Glasses::see(const WornFrame& frame) {
  ++frames;
  if (const auto shown = sim::shown_in(frame)) {
    const bool guides =
        std::any_of(shown->holograms.begin(), shown->holograms.end(), depends_on_tool);
    stale += guides && shown->display_time - shown->pose_time > kStaleAfter ? 1 : 0;
  }
  WornFrame back = frame;
  back.wearer_from_drawn = weather_.jumped_from_world.inverse() * frame.wearer_from_drawn;
  inner_.see(back);
}

}  // namespace orthonav::soak
