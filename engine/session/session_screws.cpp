#include <algorithm>

#include "base/check.h"
#include "engine/session/session.h"

namespace orthonav::engine {

// What is done about a screw: it is guided, its wire is measured, and it is finished or redone.

void Session::act_on_screw(Action action, Timestamp time) {
  switch (action) {
    case Action::kSelectScrew:
      return select_screw();
    case Action::kExpectWire:
      return placing_.begin();
    case Action::kMeasureWire:
      return measure_wire(time);
    case Action::kJudgeWire:
      return handle(placing_.undecided() ? Event::kWireUndecided : Event::kWireSettled, time);
    case Action::kAskAboutWire:
      return messages_.say(WireUndecided{}, time);
    case Action::kKeepWire:
      return keep_wire(time);
    case Action::kJudgeRedo:
      return judge_redo(time);
    case Action::kOfferToKeep:
      return messages_.say(NoOtherEntry{}, time);
    default:
      ORTHONAV_CHECK(action == Action::kFinishScrew);
      return finish_screw(time);
  }
}

void Session::select_screw() {
  digitizing_.clear();
  guiding_.select_open_screw(level());
}

void Session::collect_sleeve() {
  const ToolWatch& guide = tools_.watch(tools_.guide());
  placing_.collect(guide.newest(), tools_.geometry(tools_.guide()));
}

void Session::measure_wire(Timestamp time) {
  const ToolWatch& guide = tools_.watch(tools_.guide());
  std::optional<TouchRefusal> refusal;
  if (anchored() && reference_hidden_) {
    placing_.touch().drop();
    refusal = TouchRefusal{TouchRefusal::Kind::kReferenceNotSeen};
  } else if (!guide.fresh(time, options_.stale_after)) {
    placing_.touch().drop();
    refusal = TouchRefusal{TouchRefusal::Kind::kGuideNotSeen};
  } else {
    refusal = placing_.take(level(), guiding_.screw(), guide.last_measured_pose(),
                            tools_.geometry(tools_.guide()), guide_errors(time),
                            options_.max_touch_spread_m);
  }
  if (refusal) {
    return messages_.say(TouchNotRecorded{TouchNotRecorded::What::kWire, *refusal}, time);
  }
  tell_wire(time);
  if (placing_.spin() && options_.steps.axis) {
    axis_check_.take(*placing_.spin(), tools_.geometry(tools_.guide()).axis_in_marker);
    if (observer_) {
      observer_->axis_compared(time, *axis_check_.last());
    }
  }
}

void Session::keep_wire(Timestamp time) {
  if (consents_to_breach(time)) {
    return;
  }
  if (!placing_.undecided()) {
    messages_.say(NotPossibleNow{Event::kSayAccept}, time);
    return;
  }
  placing_.keep();
  tell_wire(time);
}

void Session::tell_wire(Timestamp time) {
  if (observer_) {
    observer_->wire_measured(time, level(), guiding_.screw(), *placing_.wire());
  }
}

/// Another entry for the same screw, whose landmark is touched before: what drove the wire astray
/// may have moved the bone against its registration.
void Session::judge_redo(Timestamp time) {
  LevelState& now = level();
  const std::size_t screw = guiding_.screw();
  if (!placing_.wire()) {
    return messages_.say(NothingToDelete{NothingToDelete::What::kWire}, time);
  }
  if (!placing_.undecided()) {
    return messages_.say(NotPossibleNow{Event::kSayDelete}, time);
  }
  if (placing_.must_confirm(now.redone[screw])) {
    return messages_.say(ConfirmRedo{now.redone[screw]}, time);
  }
  const auto other = placing_.other_entry(now, screw);
  if (!other) {
    return handle(Event::kNoOtherEntry, time);
  }
  put_other_entry(now, screw, other->entry);
  ++now.redone[screw];
  guiding_.forget_guidance();
  if (observer_) {
    observer_->screw_redone(time, now, screw, *other);
  }
  handle(Event::kScrewRedone, time);
  messages_.say(ScrewRedone{other->from_hole_m, other->clearance.clearance_m}, time);
}

void Session::finish_screw(Timestamp time) {
  LevelState& now = level();
  const std::size_t screw = guiding_.screw();
  now.screw_done[screw] = true;
  now.clearance_at_depth[screw] = guiding_.clearance_at_depth(now, tools_.geometry(tools_.guide()));
  now.executed[screw] = guiding_.executed();
  if (step_ == Step::kPlaced) {
    now.wires[screw] = {true, placing_.wire()};
  }
  if (observer_) {
    observer_->screw_done(time, now, screw, guiding_.at_depth());
    observer_->calibration_found(time, calibration_in_use(tools_.tracker()));
  }
  const auto finished = [](const LevelState& state) { return state.finished(); };
  if (!finished(now)) {
    handle(Event::kAnotherScrew, time);
  } else if (!std::all_of(levels_.begin(), levels_.end(), finished)) {
    handle(Event::kAnotherLevel, time);
  } else if (rod_planned(levels_, nav::Side::kLeft) || rod_planned(levels_, nav::Side::kRight)) {
    handle(Event::kNoScrewLeft, time);
  } else {
    handle(Event::kNoRodPlanned, time);
  }
}

}  // namespace orthonav::engine
