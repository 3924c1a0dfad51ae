#include "engine/session/session.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/joined.h"
#include "engine/session/commands.h"

namespace orthonav::engine {

namespace {

Event event_of(ClickerAction action) {
  switch (action) {
    case ClickerAction::kPress:
      return Event::kPress;
    case ClickerAction::kRelease:
      return Event::kRelease;
    case ClickerAction::kClick:
      return Event::kClick;
    case ClickerAction::kDoubleClick:
      return Event::kDoubleClick;
    case ClickerAction::kHold:
      break;
  }
  return Event::kHold;
}

/// A message to the surgeon stays until something is accepted; these actions accept nothing.
constexpr bool keeps_message(Action action) {
  using enum Action;
  return action == kRefuse || action == kIgnore || action == kExplain || action == kHideGuidance ||
         action == kShowGuidance || action == kForgetMap || action == kEndTouch;
}

}  // namespace

Result<std::unique_ptr<Session>> Session::create(Operation operation,
                                                 std::unique_ptr<nav::ToolTracker> tracker,
                                                 Method method, const SessionOptions& options) {
  std::vector<std::string> problems = operation.check();
  for (const std::string& problem : options.check()) {
    problems.push_back("session: " + problem);
  }
  if (!problems.empty()) {
    return Error{joined(problems)};
  }
  auto tools = WatchedTools::create(std::move(tracker), operation.rods_alone);
  if (!tools) {
    return tools.error();
  }
  SessionOptions taken = options;
  if (method.verification == Verification::kByEye) {
    taken.steps = MethodSteps::none();
  } else if (!taken.steps.check_points) {
    method.verification = Verification::kByEye;
  }
  return std::unique_ptr<Session>(
      new Session(std::move(operation), std::move(*tools), std::move(method), taken));
}

Session::Session(Operation operation, WatchedTools tools, Method method,
                 const SessionOptions& options)
    : work_(std::move(operation), std::move(tools), std::move(method), options),
      workflow_(workflow_of(options.steps, work_.rods_alone())),
      steps_(work_) {}

Status Session::resume(const LoggedOperation& logged) {
  if (work_.step != Step::kSetup || watching_.begun()) {
    return Error{"an operation is resumed before its first step"};
  }
  return resuming_.restore(logged, work_, steps_.rods);
}

const Guidance& Session::step(const StereoFrame& frame, const Inputs& inputs) {
  const Timestamp now = frame.time;
  // Events must not be answered with measurements from another map.
  handle(watching_.look_at_map(frame, work_), now);
  work_.stalled = inputs.stalled;
  work_.waits = !inputs.time_runs;
  work_.no_clicker = inputs.no_clicker;
  // Events first: a press before this pair makes this pair a sample, a release before it does not.
  answer_inputs(inputs);
  handle(steps_.digitizing.look(work_, now), now);
  work_.tools.track(frame);
  handle(watching_.look_at_places(work_), now);
  handle(watching_.look_for_reference(work_, now), now);
  watching_.tell_places(work_, now);
  handle(watching_.look_at_tool(work_, steps_.tool(work_), now), now);
  handle(watching_.look_at_drift(work_, steps_.guiding, now), now);
  steps_.collect(work_);
  return publication_.publish(frame, inputs.display_time, work_, steps_, watching_);
}

const Guidance& Session::expire(Timestamp display_time, std::optional<Repeated> repeats) {
  return publication_.expire(display_time, NoImages{repeats}, work_, steps_);
}

const Guidance& Session::end(Timestamp display_time) {
  return publication_.end(display_time, work_, steps_);
}

void Session::answer_inputs(const Inputs& inputs) {
  std::size_t c = 0;
  std::size_t p = 0;
  std::size_t r = 0;
  const auto next_of = [](const auto& events, std::size_t i) {
    return i < events.size() ? events[i].time : Timestamp::max();
  };
  while (c < inputs.clicks.size() || p < inputs.phrases.size() || r < inputs.requests.size()) {
    const Timestamp clicked = next_of(inputs.clicks, c);
    const Timestamp said = next_of(inputs.phrases, p);
    const Timestamp asked = next_of(inputs.requests, r);
    // At equal times the clicker goes first, because phrases refer to what was done.
    if (clicked <= said && clicked <= asked) {
      const ClickerEvent& click = inputs.clicks[c++];
      handle(event_of(click.action), click.time);
    } else if (said <= asked) {
      handle(hear(inputs.phrases[p++]), said);
    } else {
      answer_request(inputs.requests[r++]);
    }
  }
}

void Session::answer_request(const Request& request) {
  const std::int64_t said = work_.messages.said();
  work_.observer->asked_from_outside(request);
  const std::optional<Event> event =
      hear({request.text, 1.0, request.time}, request.change, request.from);
  handle(event, request.time);
  const Message* const answer = work_.messages.said() > said ? work_.messages.message() : nullptr;
  const Message* const why_not = answer != nullptr && is_refusal(*answer) ? answer : nullptr;
  work_.observer->request_answered(request, event && why_not == nullptr, why_not);
}

std::optional<Event> Session::hear(const Phrase& phrase, const std::optional<Replan>& change,
                                   const std::string& from) {
  const bool sure = phrase.confidence >= work_.options.min_voice_confidence;
  std::optional<Event> event = change ? std::nullopt : command_event(phrase.text);
  const std::optional<Result<Replan>> replan = change  ? Result<Replan>(*change)
                                               : event ? std::nullopt
                                                       : replan_from(phrase.text);
  if (event || replan) {
    work_.messages.echo(phrase, sure, from);
  }
  if (sure && replan && *replan) {
    steps_.replanning.ask(**replan);
    event = Event::kSayReplan;
  }
  if (sure && event) {
    return event;
  }
  if (!sure) {
    work_.messages.say(NotUnderstood{}, phrase.time);
  } else if (replan) {
    work_.messages.say(ReplanUnclear{replan->error()}, phrase.time);
  }
  work_.observer->not_understood(phrase);
  return std::nullopt;
}

void Session::handle(std::optional<Raised> raised, Timestamp time) {
  while (raised) {
    const Event event = raised->event;
    const Cell cell = answer(workflow_, work_.step, event);
    work_.observer->happened(time, work_.step, event, cell);
    // The step changes first, so that an event raised by the action is answered in the new step.
    // Press and click of a touch belong to one step.
    if (std::exchange(work_.step, cell.next) != cell.next) {
      work_.touches.drop();
    }
    if (!keeps_message(cell.action)) {
      work_.messages.clear();
      if (event != Event::kSayAccept) {
        steps_.replanning.withdraw_question();
      }
    }
    std::optional<Raised> next = act(cell.action, event, time);
    if (!std::holds_alternative<std::monostate>(raised->then_say)) {
      work_.messages.say(std::move(raised->then_say), time);
    }
    raised = std::move(next);
  }
}

/// The first of the levels that is not finished.
std::optional<Raised> Session::begin_level(Timestamp time) {
  const auto& levels = work_.state.levels;
  const auto open = std::find_if(levels.begin(), levels.end(),
                                 [](const LevelState& level) { return !level.finished(); });
  work_.level_in_work = open == levels.end() ? 0 : static_cast<std::size_t>(open - levels.begin());
  steps_.digitizing.clear();
  steps_.guiding.begin_level();
  return resuming_.go_on(work_, steps_, time);
}

void Session::show_registration(Timestamp time) {
  work_.level().check_points.clear();
  steps_.verifying = Verifying(work_, time);
}

void Session::clear_level(Timestamp time) {
  work_.level().forget_registration();
  steps_.digitizing.clear();
  steps_.forget_registration(work_);
  work_.observer->level_cleared(time, work_.level());
}

void Session::forget_places(Event why, Timestamp time) {
  work_.state.forget_places();
  steps_.digitizing.forget_map();
  resuming_.forget_places();
  steps_.forget_registration(work_);
  work_.touches.drop();
  work_.tools.forget_poses();
  publication_.forget_head();
  work_.observer->places_forgotten(time);
  const Step step = work_.step;
  if (step == Step::kDigitize || step == Step::kRod || step == Step::kDone) {
    work_.messages.say(
        why == Event::kReferenceMoved ? Message(ReferenceMoved{step}) : Message(MapMoved{step}),
        time);
  }
}

// A missing action does not compile here, whichever warnings are enabled (tests/build_failures).
// clang-format off
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wswitch"
std::optional<Raised> Session::act(Action action, Event event, Timestamp time) {
  using enum Action;
  SessionSteps& s = steps_;
  switch (action) {
    case kIgnore: break;
    case kRefuse: case kExplain: work_.messages.say(why_not(event), time); break;
    case kBeginLevel: return begin_level(time);
    case kStartSampling: s.digitizing.press(work_.level(), time); break;
    case kStopSampling: s.digitizing.release(time); break;
    case kBeginTouch: work_.touches.begin(); break;
    case kEndTouch: work_.touches.release(); break;
    case kDropTouch: s.drop_touch(work_, time); break;
    case kSaveRegion: s.digitizing.save_region(work_, time); break;
    case kDropRegion: s.digitizing.drop_region(work_, time); break;
    case kRegister: return s.digitizing.register_level(work_, time);
    case kShowRegistration: show_registration(time); break;
    case kJudgeChecks: return s.verifying.judge_checks(time);
    case kRecordCheck: s.verifying.record_check(work_, time); break;
    case kDropCheck: s.verifying.drop_check(work_, time); break;
    case kAccept: s.verifying.accept(work_, time); s.expect_landmark(work_); break;
    case kClearLevel: clear_level(time); break;
    case kTouchLandmark: return s.landmarking.touch_landmark(work_, s.guide_checks, time);
    case kDropLandmark: s.landmarking.drop_landmark(work_, time); break;
    case kJudgeLandmark: return s.landmarking.judge_landmark();
    case kExpectLandmark: s.expect_landmark(work_); break;
    case kVerifyAgain: s.landmarking.verify_again(work_, s.verifying, s.guiding, time); break;
    case kConsent: return s.consent(work_, time);
    case kCorrectGuide: s.correct_guide(work_, time); break;
    case kKeepWire: s.placing.keep(work_, s.guiding.screw(), time); break;
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
    case kBeginRod: return s.rods.begin(work_);
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
Message Session::why_not(Event event) const {
  switch (event) {
    case Event::kNotShown:
      return SaidBeforeShown{};
    case Event::kNotChecked:
      return ChecksMissing{steps_.verifying.verdict().advice};
    case Event::kLandmarkMissing:
      return LandmarkMissing{work_.level().landmark.has_value()};
    case Event::kNoChangePending:
      return NotPossibleNow{Event::kSayAccept};
    case Event::kWireUndecided:
      return WireUndecided{};
    case Event::kNoOtherEntry:
      return NoOtherEntry{};
    default:
      return NotPossibleNow{event};
  }
}

}  // namespace orthonav::engine
