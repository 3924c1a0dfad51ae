#include <algorithm>
#include <utility>

#include "engine/session/session.h"

namespace orthonav::engine {

// An action that is forgotten here does not compile, whatever warnings are asked for
// (tests/build_failures).
// clang-format off
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wswitch"
void Session::act(Action action, Event event, Timestamp time) {
  using enum Action;
  switch (action) {
    case kRefuse: return messages_.say(NotPossibleNow{event}, time);
    case kIgnore: case kCountRefusal: case kFinish: case kWarnLost: return;  // said elsewhere
    case kBeginLevel: return begin_level(time);
    case kStartSampling: return digitizing_.press(level(), time);
    case kStopSampling: return digitizing_.release(time);
    case kSaveRegion: return save_region(time);
    case kDropRegion: return drop_region(time);
    case kRegister: return register_level(time);
    case kShowRegistration: return show_registration(time);
    case kJudgeChecks: return judge_checks(time);
    case kAskForChecks: return messages_.say(ChecksMissing{verifying_.verdict().advice}, time);
    case kRecordCheck: return record_check(time);
    case kDropCheck: return drop_check(time);
    case kAccept: return accept(time);
    case kClearLevel: return clear_level(time);
    case kTouchLandmark: return touch_landmark(time);
    case kDropLandmark: return drop_landmark(time);
    case kJudgeLandmark: return judge_landmark(time);
    case kAskForLandmark: return messages_.say(LandmarkMissing{level().landmark.has_value()}, time);
    case kExpectLandmark: return landmarking_.begin();
    case kVerifyAgain: return verify_again(time);
    case kCorrectGuide: return correct_guide(time);
    case kSelectScrew: case kExpectWire: case kMeasureWire: case kJudgeWire: case kAskAboutWire:
    case kKeepWire: case kJudgeRedo: case kOfferToKeep: case kFinishScrew: return act_on_screw(action, time);
    case kBeginRod: return rod_templating_.begin();
    case kBeginTouch: return begin_touch();
    case kEndTouch: return end_touch();
    case kDropTouch: return drop_touch(time);
    case kRecordHead: return record_head(time);
    case kDropHead: return drop_head(time);
    case kFinishRod: return finish_rod(time);
    case kMoveRod: return rod_templating_.move_away();
    case kToggleTwin: return guiding_.toggle_twin();
    case kBeginDrill: return guiding_.begin_drill();
    case kReplan: case kConsent: return action == kReplan ? replan(time) : consent(time);
    case kHideGuidance: case kShowGuidance: return in_use_.hide_guidance(action == kHideGuidance);
    case kForgetMap: return forget_places(event, time);
  }
}
// clang-format on
#pragma GCC diagnostic pop

void Session::begin_level(Timestamp time) {
  const auto open = std::find_if(levels_.begin(), levels_.end(),
                                 [](const LevelState& level) { return !level.finished(); });
  level_ = open == levels_.end() ? 0 : static_cast<std::size_t>(open - levels_.begin());
  digitizing_.clear();
  guiding_.begin_level();
  if (resumed_) {
    go_on(time);
  }
}

void Session::register_level(Timestamp time) {
  LevelState& now = level();
  now.tag_size.reset();
  if (const auto fraction = tools_.tag_size_off(tools_.pointer())) {
    now.tag_size = TagSizeWarning{tools_.geometry(tools_.pointer()).name, *fraction};
  }
  const RegistrationOutcome outcome = digitizing_.register_level(now, method_.registrar, time);
  if (!outcome.passed()) {
    messages_.say(message_about(outcome), time);
  }
  if (observer_) {
    observer_->registered(time, now, outcome);
  }
  handle(outcome.passed() ? Event::kRegistered : Event::kRegistrationRefused, time);
}

void Session::show_registration(Timestamp time) {
  level().check_points.clear();
  verifying_ = Verifying(level(), method_.verification, options_, anchored(), time);
}

void Session::clear_level(Timestamp time) {
  level().forget_registration();
  digitizing_.clear();
  verifying_ = Verifying{};
  landmarking_.begin();
  placing_.begin();
  guiding_.forget_guidance();
  if (observer_) {
    observer_->level_cleared(time, level());
  }
}

void Session::judge_checks(Timestamp time) {
  handle(verifying_.verdict().passed ? Event::kChecked : Event::kNotChecked, time);
}

void Session::record_check(Timestamp time) {
  if (const auto refusal = verifying_.record(level(), touched_place(time), time)) {
    messages_.say(TouchNotRecorded{TouchNotRecorded::What::kCheckPoint, *refusal}, time);
  } else if (observer_) {
    observer_->check_point_recorded(time, level());
  }
}

void Session::accept(Timestamp time) {
  verifying_.join(level());
  level().accepted = true;
  level().unverified = false;
  level().bone_found = BoneFound{time, 0.0, options_.map_drift_m_per_sqrt_s};
  landmarking_.begin();
  if (observer_) {
    observer_->accepted(time, level(), shown_);
  }
}

void Session::drop_check(Timestamp time) {
  if (!verifying_.drop(level())) {
    messages_.say(NothingToDelete{NothingToDelete::What::kCheckPoint}, time);
  } else if (observer_) {
    observer_->check_point_dropped(time, level());
  }
}

/// Places are touched in `verify`, `accepted` and `rod`: the table asks for no such touch
/// elsewhere.
Touch& Session::touch_of_step() {
  if (step_ == Step::kRod) {
    return rod_templating_.touch();
  }
  return step_ == Step::kAccepted ? landmarking_.touch() : verifying_.touch();
}

void Session::begin_touch() {
  if (step_ == Step::kPlaced) {
    return placing_.touch().begin();
  }
  tip_check_.touch().begin();
  touch_of_step().begin();
}

void Session::end_touch() {
  if (step_ == Step::kPlaced) {
    return placing_.touch().release();
  }
  tip_check_.touch().release();
  touch_of_step().release();
}

TouchedPlace Session::touched_place(Timestamp time) {
  return touch_of_step().take_place(tools_.pointer_tip(time, options_.stale_after),
                                    options_.max_touch_spread_m);
}

void Session::drop_touch(Timestamp time) {
  using What = TouchNotRecorded::What;
  What what = What::kCheckPoint;
  if (step_ == Step::kPlaced) {
    placing_.touch().drop();
    what = What::kWire;
  } else {
    touch_of_step().drop();
    what = step_ == Step::kRod        ? What::kHead
           : step_ == Step::kAccepted ? What::kLandmark
                                      : What::kCheckPoint;
  }
  messages_.say(TouchNotRecorded{what, {TouchRefusal::Kind::kHeldTooLong}}, time);
}

void Session::record_head(Timestamp time) {
  const TouchedPlace place = touched_place(time);
  const auto* head = std::get_if<nav::PressedPlace>(&place);
  if (!head) {
    messages_.say(TouchNotRecorded{TouchNotRecorded::What::kHead, std::get<TouchRefusal>(place)},
                  time);
    return;
  }
  rod_templating_.add_head(head->place);
  bend_rod(time);
  if (observer_) {
    observer_->head_recorded(time, rod_templating_.current().side, head->place);
  }
}

void Session::drop_head(Timestamp time) {
  if (!rod_templating_.drop_head()) {
    messages_.say(NothingToDelete{NothingToDelete::What::kHead}, time);
    return;
  }
  bend_rod(time);
  if (observer_) {
    observer_->head_dropped(time, rod_templating_.current().side);
  }
}

void Session::bend_rod(Timestamp time) {
  const Status bent = rod_templating_.bend(options_, levels_);
  if (!bent) {
    messages_.say(NoRod{bent.error()}, time);
  }
}

void Session::finish_rod(Timestamp time) {
  if (observer_) {
    observer_->rod_done(time, rod_templating_.current());
  }
  handle(rod_templating_.finish() ? Event::kAnotherSide : Event::kNoSideLeft, time);
}

/// World is another one, or what hung it on the patient moved: whatever was measured in it is gone.
/// What the patient has already, and what was measured of it, stays in the report.
void Session::forget_places(Event why, Timestamp time) {
  for (LevelState& level : levels_) {
    level.map_moved = level.registration.has_value() && level.finished();
    if (!level.map_moved) {
      level.forget_registration();
    }
  }
  digitizing_.forget_map();
  restored_regions_.clear();
  verifying_ = Verifying{};
  landmarking_.begin();
  placing_.begin();
  guiding_.forget_guidance();
  rod_templating_.forget_map();
  tools_.forget_poses();
  guidance_.head.reset();
  if (observer_) {
    observer_->places_forgotten(time);
  }
  if (step_ == Step::kDigitize || step_ == Step::kRod || step_ == Step::kDone) {
    messages_.say(
        why == Event::kReferenceMoved ? Message(ReferenceMoved{step_}) : Message(MapMoved{step_}),
        time);
  }
}

}  // namespace orthonav::engine
