#include "hal/sim/room/noise.h"
#include "study/surgeon/scripted_surgeon.h"

namespace orthonav::sim {
namespace {

/// The sleeve stands on the bone's cortex or a little above it.
constexpr double kSleeveOverBone_m = 0.004;
constexpr double kOverWire_m = 0.050;
constexpr double kSetOver_s = 2.0;
constexpr double kAtRest_s = 1.0;
/// The sleeve is turned to and fro about the wire by so much to either side, fingers only.
constexpr double kSleeveRotation_rad = 1.0;
constexpr double kSleeveTurn_s = 0.8;
constexpr int kSleeveTurns = 6;
constexpr double kReadNumbers_s = 1.0;
/// An instrument that bends by more (SD per axis) will do so again: surgeons know their instrument,
/// and keep the result of an unsupported wire.
constexpr double kBendsAgain_rad = 0.02;

}  // namespace

Script ScriptedSurgeon::look_at_wire(std::size_t level, Side side) {
  const StepOnDisplay step = step_now();
  const StepOnDisplay guiding{Step::kGuide, step.level, step.side};
  const auto wire = metal_.wire(layout_->room().levels[level].label, side);
  if (wire && asked(ChecksAsked::kRecordWire)) {
    co_await set_sleeve_over(step, level, *wire);
  }
  const bool betters = error_model_->wire_bending_rad < kBendsAgain_rad;
  if (in_step(step) && asked(ChecksAsked::kDecideOnWire) && betters &&
      redone_.insert(guiding).second) {
    body_.say(words().drop);
    co_await body_.rest(kReadNumbers_s);
    // The line moves on to the landmark, or says that the wire can only be kept.
    if (!in_step(step)) {
      driven_.erase(guiding);
      co_return;
    }
  }
  if (in_step(step) && (asked(ChecksAsked::kDecideOnWire) || asked(ChecksAsked::kKeepWire))) {
    body_.say(words().accept);
    co_await body_.rest(kReadNumbers_s);
  }
  if (in_step(step)) {
    body_.say(words().next);
    co_await await_change(step, words().next);
  }
}

Script ScriptedSurgeon::set_sleeve_over(const StepOnDisplay& step, std::size_t level,
                                        const StandingWire& wire) {
  const auto& room_from_vertebra = layout_->room_from_vertebra(level);
  const Vec3 outwards = -(room_from_vertebra * Direction<Vertebra>{wire.direction}).v;
  const Point<Room> entry = room_from_vertebra * wire.entry;
  const Vec3 play = normal_vector(sleeving_, error_model_->sleeve_play_rad);
  const Vec3 axis = (rotation_from_vector(play) * outwards).normalized();
  co_await body_.take(ToolKind::kGuide, layout_->site(level));
  body_.look(entry, best_view(outwards));
  co_await body_.move({entry + kOverWire_m * outwards, axis, 0.0}, kSetOver_s);
  co_await body_.move({entry + kSleeveOverBone_m * outwards, axis, 0.0}, kSetOver_s);
  body_.posture().on_wire = true;
  // Because of its play, the sleeve lies differently after each turn.
  for (int turn = 0; turn < kSleeveTurns && in_step(step); ++turn) {
    const Vec3 lies = normal_vector(sleeving_, error_model_->sleeve_play_rad);
    const double roll_rad = turn + 1 == kSleeveTurns ? 0.0
                            : turn % 2 == 0          ? kSleeveRotation_rad
                                                     : -kSleeveRotation_rad;
    co_await body_.move({entry + kSleeveOverBone_m * outwards,
                         (rotation_from_vector(lies) * outwards).normalized(), roll_rad},
                        kSleeveTurn_s);
  }
  co_await click_until_taken(step, kAtRest_s, kReadNumbers_s / body_.slowness());
  body_.posture().on_wire = false;
  co_await body_.move({entry + kOverWire_m * outwards, axis, 0.0}, kSetOver_s);
}

}  // namespace orthonav::sim
