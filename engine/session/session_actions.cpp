#include "engine/session/session.h"

namespace orthonav::engine {

// A missing action does not compile here, whichever warnings are enabled (tests/build_failures).
// clang-format off
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wswitch"
std::optional<Raised> Session::act(Action action, Event event, Timestamp time) {
  using enum Action;
  SessionSteps& s = steps_;
  switch (action) {
    case kIgnore: case kCountRefusal: case kFinish: case kWarnLost: break;  // said elsewhere
    case kRefuse: case kAskForChecks: case kAskForLandmark: case kAskAboutWire: case kOfferToKeep: work_.messages.say(why_not(action, event), time); break;
    case kBeginLevel: return begin_level(time);
    case kStartSampling: case kStopSampling: case kBeginTouch: case kEndTouch: case kDropTouch: s.button(action, work_, time); break;
    case kSaveRegion: s.digitizing.save_region(work_, time); break;
    case kDropRegion: s.digitizing.drop_region(work_, time); break;
    case kRegister: return s.digitizing.register_level(work_, time);
    case kShowRegistration: show_registration(time); break;
    case kJudgeChecks: return s.verifying.judge_checks();
    case kRecordCheck: s.verifying.record_check(work_, time); break;
    case kDropCheck: s.verifying.drop_check(work_, time); break;
    case kAccept: s.verifying.accept(work_, time); s.expect_landmark(work_); break;
    case kClearLevel: clear_level(time); break;
    case kTouchLandmark: return s.landmarking.touch_landmark(work_, s.guide_checks, time);
    case kDropLandmark: s.landmarking.drop_landmark(work_, time); break;
    case kJudgeLandmark: return s.landmarking.judge_landmark();
    case kExpectLandmark: s.expect_landmark(work_); break;
    case kVerifyAgain: s.landmarking.verify_again(work_, s.verifying, s.guiding, time); break;
    case kCorrectGuide: case kKeepWire: case kConsent: consent(action, time); break;
    case kSelectScrew: s.select_screw(work_); break;
    case kToggleTwin: s.guiding.toggle_twin(); break;
    case kToggleNumbers: s.guiding.toggle_numbers(); break;
    case kBeginDrill: s.guiding.begin_drill(); break;
    case kReplan: s.replanning.replan(work_, s.guiding, s.placing, time); break;
    case kExpectWire: s.expect_wire(work_); break;
    case kMeasureWire: s.placing.measure(work_, s.guiding, s.guide_checks, watching_.reference_hidden(work_), time); break;
    case kJudgeWire: return s.placing.judge_wire();
    case kJudgeRedo: return s.placing.judge_redo(work_, s.guiding, time);
    case kFinishScrew: return s.guiding.finish_screw(work_, s.placing, time);
    case kBeginRod: return s.rods.begin(work_.state);
    case kRecordHead: s.rods.record_head(work_, time); break;
    case kDropHead: s.rods.drop_head(work_, time); break;
    case kFinishRod: return s.rods.finish_rod(work_, time);
    case kMoveRod: s.rods.move_away(); break;
    case kHideGuidance: case kShowGuidance: watching_.hide_guidance(action == kHideGuidance); break;
    case kForgetMap: forget_places(event, time); break;
  }
  return std::nullopt;
}
// clang-format on
#pragma GCC diagnostic pop

/// What the surgeon is told if nothing is done.
Message Session::why_not(Action action, Event event) const {
  switch (action) {
    case Action::kAskForChecks:
      return ChecksMissing{steps_.verifying.verdict().advice};
    case Action::kAskForLandmark:
      return LandmarkMissing{work_.level().landmark.has_value()};
    case Action::kAskAboutWire:
      return WireUndecided{};
    case Action::kOfferToKeep:
      return NoOtherEntry{};
    default:
      return NotPossibleNow{event};
  }
}

}  // namespace orthonav::engine
