#include "engine/session/session.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/joined.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/workflow/commands.h"

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

bool at_work(Step step) { return step != Step::kSetup && step != Step::kDone; }

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
      digitizing_(work_),
      guide_checks_(options),
      placing_(options),
      replanning_(options.replan),
      rods_(work_.rods_alone() || rod_planned(work_.state.levels, nav::Side::kLeft),
            work_.rods_alone() || rod_planned(work_.state.levels, nav::Side::kRight)) {}

Status Session::resume(const LoggedOperation& logged) {
  if (work_.step != Step::kSetup || watching_.begun()) {
    return Error{"an operation is resumed before its first step"};
  }
  return resuming_.restore(logged, work_, rods_);
}

const Guidance& Session::step(const StereoFrame& pair, const Inputs& inputs) {
  return step_with(pair, inputs);
}

const Guidance& Session::step(const ToolPoses& poses, const Inputs& inputs) {
  return step_with(poses, inputs);
}

template <class Frame>
const Guidance& Session::step_with(const Frame& frame, const Inputs& inputs) {
  const Timestamp now = frame.time;
  // Events must not be answered with measurements from another map.
  handle(watching_.look_at_map(frame, work_), now);
  work_.stalled = inputs.stalled;
  work_.waits = !inputs.time_runs;
  work_.no_clicker = inputs.no_clicker;
  // Events first: a press before this pair makes this pair a sample, a release before it does not.
  answer_inputs(inputs);
  handle(digitizing_.look(work_, now), now);
  work_.tools.track(frame);
  handle(watching_.detect_reference_shift(work_), now);
  handle(watching_.look_for_reference(work_, now), now);
  watching_.publish_reference_poses(work_, now);
  handle(watching_.look_at_tool(work_, tool(), now), now);
  handle(watching_.look_at_drift(work_, guiding_, now), now);
  collect();
  publish(frame, inputs.display_time);
  return guidance_;
}

const Guidance& Session::expire(Timestamp display_time, std::optional<Repeated> repeats) {
  return withdraw(display_time, NoImages{repeats});
}

const Guidance& Session::end(Timestamp display_time) {
  withdraw(display_time, Ended{});
  guidance_.blank = true;
  return guidance_;
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
  // A wrong "accept" is worse than one said twice.
  constexpr double kLeastConfidence = 0.5;
  const bool sure = phrase.confidence >= kLeastConfidence;
  std::optional<Event> event = change ? std::nullopt : command_event(phrase.text);
  const std::optional<Result<Replan>> replan = change  ? Result<Replan>(*change)
                                               : event ? std::nullopt
                                                       : replan_from(phrase.text);
  if (event || replan) {
    work_.messages.echo(phrase, sure, from);
  }
  if (sure && replan && *replan) {
    replanning_.ask(**replan);
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

bool Session::holds(State state, Timestamp time) const {
  switch (state) {
    case State::kBreachPending:
      return replanning_.pending(work_, guiding_, placing_, time);
    case State::kNotShown:
      return !verifying_.shown_by(time);
    case State::kChecksPassed:
      return verifying_.passed();
    case State::kCorrectionOffered:
      return landmarking_.touched() && guide_checks_.offers();
    case State::kLandmarkTouched:
      return landmarking_.touched();
    case State::kWireBeyondLimit:
      return placing_.undecided();
  }
  return false;
}

void Session::handle(std::optional<FollowUpEvent> raised, Timestamp time) {
  while (raised) {
    const Event event = raised->event;
    const Cell cell =
        answer(workflow_, work_.step, event, [&](State state) { return holds(state, time); });
    work_.observer->happened(time, work_.step, event, cell);
    // The step changes first, so that an event raised by the action is answered in the new step.
    // Press and click of a touch belong to one step.
    if (std::exchange(work_.step, cell.next) != cell.next) {
      work_.touches.drop();
    }
    if (settles(cell.action)) {
      work_.messages.clear();
      if (cell.action != Action::kTakeBreach) {
        replanning_.withdraw_question();
      }
    }
    std::optional<FollowUpEvent> next = act(cell.action, event, time);
    if (!std::holds_alternative<std::monostate>(raised->then_say)) {
      work_.messages.say(std::move(raised->then_say), time);
    }
    raised = std::move(next);
  }
}

/// The first of the levels that is not finished.
std::optional<FollowUpEvent> Session::begin_level(Timestamp time) {
  const auto& levels = work_.state.levels;
  const auto open = std::find_if(levels.begin(), levels.end(),
                                 [](const LevelState& level) { return !level.finished(); });
  work_.level_in_work = open == levels.end() ? 0 : static_cast<std::size_t>(open - levels.begin());
  digitizing_.clear();
  guiding_.begin_level();
  return resuming_.resume_level(work_, rods_, digitizing_, verifying_, time);
}

void Session::show_registration(Timestamp time) {
  work_.level().check_points.clear();
  verifying_ = Verifying(work_, time, std::move(verifying_));
}

void Session::clear_level(Timestamp time) {
  work_.level().forget_registration();
  digitizing_.clear();
  Verifying left = std::move(verifying_).rejected(work_);
  forget_registration();
  verifying_ = std::move(left);
  work_.observer->level_cleared(time, work_.level());
}

void Session::forget_places(Event why, Timestamp time) {
  work_.state.forget_places();
  digitizing_.forget_map();
  resuming_.forget_places();
  forget_registration();
  work_.touches.drop();
  work_.tools.forget_poses();
  guidance_.head.reset();
  work_.observer->places_forgotten(time);
  const Step step = work_.step;
  if (step == Step::kDigitize || step == Step::kRod || step == Step::kDone) {
    work_.messages.say(
        why == Event::kReferenceMoved ? Message(ReferenceMoved{step}) : Message(MapMoved{step}),
        time);
  }
}

void Session::accept(Timestamp time) {
  verifying_.accept(work_, time);
  expect_landmark();
}

void Session::expect_landmark() {
  landmarking_ = Landmarking();
  // On the headset's map a comparison costs more by the drift meanwhile than it gains.
  if (work_.anchored()) {
    guide_checks_.expect_tips();
  }
}

void Session::select_screw() {
  digitizing_.clear();
  guiding_.select_open_screw(work_.level());
}

void Session::forget_registration() {
  verifying_ = Verifying{};
  expect_landmark();
  placing_ = Placing(work_.options);
  guiding_.forget_guidance();
}

void Session::drop_touch(Timestamp time) {
  using What = TouchNotRecorded::What;
  const What what = work_.step == Step::kVerify          ? What::kCheckPoint
                    : work_.step == Step::kTouchLandmark ? What::kLandmark
                    : work_.step == Step::kMeasureWire   ? What::kWire
                                                         : What::kHead;
  work_.touches.drop();
  work_.messages.say(TouchNotRecorded{what, {TouchRefusal::Kind::kHeldTooLong}}, time);
}

// A missing action does not compile here, whichever warnings are enabled (tests/build_failures).
// clang-format off
#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wswitch"
std::optional<FollowUpEvent> Session::act(Action action, Event event, Timestamp time) {
  using enum Action;
  switch (action) {
    case kIgnore: break;
    case kRefuse: work_.messages.say(NotPossibleNow{event}, time); break;
    case kExplainNotShown: work_.messages.say(SaidBeforeShown{}, time); break;
    case kExplainChecks: work_.messages.say(ChecksMissing{verifying_.verdict().advice}, time); break;
    case kExplainLandmark: work_.messages.say(LandmarkMissing{work_.level().landmark.has_value()}, time); break;
    case kExplainWire: work_.messages.say(WireUndecided{}, time); break;
    case kExplainNoOtherEntry: work_.messages.say(NoOtherEntry{}, time); break;
    case kBeginLevel: return begin_level(time);
    case kStartSampling: digitizing_.press(work_.level(), time); break;
    case kStopSampling: digitizing_.release(time); break;
    case kBeginTouch: work_.touches.begin(); break;
    case kEndTouch: work_.touches.release(); break;
    case kDropTouch: drop_touch(time); break;
    case kSaveRegion: digitizing_.save_region(work_, time); break;
    case kDropRegion: digitizing_.drop_region(work_, time); break;
    case kRegister: return digitizing_.register_level(work_, time);
    case kShowRegistration: show_registration(time); break;
    case kRecordCheck: verifying_.record_check(work_, time); break;
    case kDropCheck: verifying_.drop_check(work_, time); break;
    case kAccept: accept(time); break;
    case kClearLevel: clear_level(time); break;
    case kRecordLandmark: return landmarking_.touch_landmark(work_, guide_checks_, time);
    case kDropLandmark: landmarking_.drop_landmark(work_, time); break;
    case kExpectLandmark: expect_landmark(); break;
    case kVerifyAgain: landmarking_.verify_again(work_, verifying_, guiding_, time); break;
    case kCorrectGuide: guide_checks_.correct_guide(work_, time); guiding_.forget_guidance(); break;
    case kKeepWire: placing_.keep(work_, guiding_.screw(), time); break;
    case kSelectScrew: select_screw(); break;
    case kToggleTwin: guiding_.toggle(&OnRequest::twin); break;
    case kToggleNumbers: guiding_.toggle(&OnRequest::numbers); break;
    case kBeginDrill: guiding_.begin_drill(); break;
    case kReplan: replanning_.replan(work_, guiding_, placing_, time); break;
    case kTakeBreach: replanning_.take_breach(work_, guiding_, placing_, time); break;
    case kExpectWire: placing_ = Placing(work_.options); break;
    case kRecordWire: placing_.measure(work_, guiding_, guide_checks_, watching_.reference_hidden(work_), time); break;
    case kJudgeRedo: return placing_.judge_redo(work_, guiding_, time);
    case kFinishScrew: return guiding_.finish_screw(work_, placing_, time);
    case kBeginRod: return rods_.begin(work_);
    case kRecordHead: rods_.record_head(work_, time); break;
    case kDropHead: rods_.drop_head(work_, time); break;
    case kFinishRod: return rods_.finish_rod(work_, time);
    case kMoveRod: rods_.move_away(); break;
    case kHideGuidance: case kShowGuidance: watching_.hide_guidance(action == kHideGuidance); break;
    case kForgetMap: forget_places(event, time); break;
  }
  return std::nullopt;
}
// clang-format on
#pragma GCC diagnostic pop

void Session::collect() {
  const WatchedTools& tools = work_.tools;
  switch (work_.step) {
    case Step::kDigitize:
      return digitizing_.collect(work_);
    case Step::kVerify:
      if (work_.options.steps.check_points) {
        add_tip(work_.touches.pointer, tools, tools.pointer());
      }
      return;
    case Step::kTouchLandmark:
      if (work_.options.steps.touches_landmark()) {
        add_tip(work_.touches.pointer, tools, tools.pointer());
        add_tip(work_.touches.guide, tools, tools.guide());
      }
      return;
    case Step::kMeasureWire:
      return placing_.collect(work_);
    case Step::kRod:
      return add_tip(work_.touches.pointer, tools, tools.pointer());
    case Step::kSetup:
    case Step::kRegistering:
    case Step::kGuide:
    case Step::kDone:
      return;
  }
}

std::optional<std::size_t> Session::tool() const {
  const MethodSteps& of_method = work_.options.steps;
  const std::optional<nav::ToolRole> role = facts_of(work_.step).tool;
  const bool by_eye = (work_.step == Step::kVerify && !of_method.check_points) ||
                      (work_.step == Step::kTouchLandmark && !of_method.touches_landmark());
  if (!role || by_eye) {
    return std::nullopt;
  }
  // Once the landmark is touched, the guide is next.
  const bool guide = role == nav::ToolRole::kGuide ||
                     (work_.step == Step::kTouchLandmark && landmarking_.touched());
  return guide ? work_.tools.guide() : work_.tools.pointer();
}

StepOnDisplay Session::on_display() const {
  switch (facts_of(work_.step).of) {
    case StepOf::kOperation:
      return {work_.step, {}, {}};
    case StepOf::kLevel:
      return {work_.step, work_.level().plan.label, {}};
    case StepOf::kScrew:
      return {work_.step, work_.level().plan.label,
              work_.level().plan.screws[guiding_.screw()].side};
    case StepOf::kRod:
      return {work_.step, {}, rods_.side()};
  }
  return {};
}

StepState Session::state() const {
  switch (work_.step) {
    case Step::kDigitize:
      return digitizing_.state();
    case Step::kVerify:
      return verifying_.state(work_);
    case Step::kTouchLandmark:
      return landmarking_.state(work_, guide_checks_);
    case Step::kMeasureWire:
      return placing_.state();
    case Step::kRod:
      return rods_.state(work_);
    case Step::kSetup:
    case Step::kRegistering:
    case Step::kGuide:  // what to do there follows from what a frame shows
    case Step::kDone:
      return {};
  }
  return {};
}

void Session::publish(const FrameHeader& frame, Timestamp display_time) {
  Guidance& out = guidance_;
  out.frame_time = frame.time;
  out.display_time = display_time;
  const auto in_use = tool();
  out.pose_time =
      in_use ? work_.tools.watch(*in_use).last_measured().value_or(Timestamp{}) : frame.time;
  out.step = work_.step;
  out.levels = work_.state.levels;
  out.level = work_.level_in_work;
  out.stale_after = work_.options.stale_after;
  out.fade = work_.options.fade;
  out.blank = work_.stalled.has_value();
  out.tools = work_.tools.sights();
  out.anchor = work_.tools.tracker().anchor();
  if (frame.world_from_rig) {
    out.head = out.anchor ? out.anchor->world_from_anchored.inverse() * *frame.world_from_rig
                          : *frame.world_from_rig;
  }
  digitizing_.write(out);
  verifying_.write(work_, out);
  guiding_.write(work_, guide_checks_, watching_.guidance_hidden() || work_.stalled, out);
  placing_.write(work_.step, out);
  rods_.write(work_, out);
  publish_status();
}

void Session::publish_status() {
  work_.messages.expire(guidance_.frame_time);
  StatusLine& line = guidance_.status;
  line.at = on_display();
  line.stalled = work_.stalled;
  line.no_clicker = work_.no_clicker;

  // The tool in use, and whether it can be trusted.
  line.tool = {};
  line.tool_lost = false;
  line.pictures_apart = work_.tools.pictures_apart();
  line.tag_size_off.reset();
  if (const auto in_use = tool()) {
    line.tool = work_.tools.geometry(*in_use).name;
    line.tool_lost = watching_.tool_lost();
    line.tag_size_off = work_.tools.tag_size_off(*in_use);
  }
  // The first of the references, while none is seen in a step that needs one.
  const auto reference = at_work(work_.step) && watching_.reference_hidden(work_)
                             ? work_.tools.first_reference()
                             : std::nullopt;
  if (reference) {
    line.tool = work_.tools.geometry(*reference).name;
    line.tool_lost = true;
  }

  // Tools in hand that the step does not use, and a depth stop that is set too deep.
  in_hand_.look(work_.tools, work_.step, tool(),
                at_work(work_.step) && !work_.rods_alone() ? &work_.level() : nullptr,
                guidance_.frame_time);
  const auto unused = in_hand_.unused();
  line.unused_tool =
      unused ? std::string_view(work_.tools.geometry(*unused).name) : std::string_view();
  line.stop_past_target_m.reset();
  if (stop_too_deep(guidance_.drill)) {
    line.stop_past_target_m = guidance_.drill.stop_past_target_m;
  }

  line.message = work_.messages.message();
  replanning_.show(line.message, guidance_.display_time);
  line.heard = work_.messages.heard();
  line.state = state();
  line.saved = saved();
  if (work_.step == Step::kVerify) {
    verifying_.note_shown(line);
  }
}

Saved Session::saved() const {
  return saving_ ? saving_->saved(guidance_.frame_time, work_.options.heard_for)
                 : Saved::kNothingNew;
}

const Guidance& Session::withdraw(Timestamp display_time, Message why) {
  guidance_.display_time = display_time;
  guidance_.tool.reset();
  guiding_.lose_measurement();
  guidance_.drill = work_.step == Step::kGuide ? guiding_.drill() : nav::DrillView{};
  work_.tools.lose_sight();
  guidance_.status = {};
  guidance_.status.at = on_display();
  guidance_.status.saved = saved();
  why_no_guidance_ = std::move(why);
  guidance_.status.message = &why_no_guidance_;
  return guidance_;
}

}  // namespace orthonav::engine
