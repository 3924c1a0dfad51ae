#include "engine/session/session.h"

#include <numbers>
#include <utility>

#include "base/joined.h"

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

/// What the surgeon was told stands until something is taken; these take nothing.
constexpr bool keeps_message(Action action) {
  using enum Action;
  return action == kRefuse || action == kIgnore || action == kWarnLost || action == kHideGuidance ||
         action == kShowGuidance || action == kCountRefusal || action == kForgetMap ||
         action == kEndTouch;
}

/// Both tips are as their calibration left them.
TipCheckRules tips_known_to(const SessionOptions& options) {
  TipCheckRules rules = options.tips;
  rules.prior_sd_m = std::numbers::sqrt2 * options.placed.tip_sd_m;
  return rules;
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
  auto tools = WatchedTools::create(std::move(tracker));
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
    : tools_(std::move(tools)),
      method_(std::move(method)),
      options_(options),
      workflow_(workflow_of(options.steps)),
      digitizing_(method_, options),
      landmarking_(options.landmark),
      tip_check_(tips_known_to(options), options.landmark, options.steps.tips),
      axis_check_({options.placed.axis_sd_rad}),
      guiding_(options.drill),
      placing_(options.placed, options.steps.redo),
      replanning_(options.replan),
      messages_(options.message_for, options.heard_for) {
  for (OperatedLevel& plan : operation.levels) {
    LevelState state;
    state.screw_done.assign(plan.screws.size(), false);
    state.clearance_at_depth.resize(plan.screws.size());
    state.executed.resize(plan.screws.size());
    state.wires.resize(plan.screws.size());
    state.redone.resize(plan.screws.size());
    state.preoperative = plan.screws;
    state.earlier_plans.resize(plan.screws.size());
    state.plan = std::move(plan);
    levels_.push_back(std::move(state));
  }
  rod_templating_ = RodTemplating(rod_planned(levels_, nav::Side::kLeft),
                                  rod_planned(levels_, nav::Side::kRight));
}

const Guidance& Session::step(const StereoFrame& frame, const Inputs& inputs) {
  // Nothing that was measured in another map may answer an event.
  watch_map(frame);
  stalled_ = inputs.stalled;
  // Events first: a press before this pair makes this pair a sample, a release before it does not.
  answer_inputs(inputs);
  tools_.track(frame);
  watch_reference(frame.time);
  tell_places(frame.time);
  watch_tool_in_use(frame.time);
  watch_drift(frame.time);
  collect_samples();
  publish(frame, inputs.display_time);
  return guidance_;
}

const Guidance& Session::expire(Timestamp display_time) {
  guidance_.display_time = display_time;
  guidance_.tool.reset();
  guiding_.lose_measurement();
  guidance_.drill = step_ == Step::kGuide ? guiding_.drill() : nav::DrillView{};
  tools_.lose_sight();
  guidance_.status = {};
  guidance_.status.at = step_on_display();
  guidance_.status.saved = saved(guidance_.frame_time);
  why_no_guidance_ = NoImages{};
  guidance_.status.message = &why_no_guidance_;
  return guidance_;
}

const Guidance& Session::end(Timestamp display_time) {
  expire(display_time);
  guidance_.blank = true;
  why_no_guidance_ = Ended{};
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
    // The clicker goes first at equal times: what is said refers to what was done.
    if (clicked <= said && clicked <= asked) {
      const ClickerEvent& click = inputs.clicks[c++];
      handle(event_of(click.action), click.time);
    } else if (said <= asked) {
      hear(inputs.phrases[p++]);
    } else {
      hear(inputs.requests[r++]);
    }
  }
}

void Session::handle(Event event, Timestamp time) {
  const Cell cell = answer(workflow_, step_, event);
  if (observer_) {
    observer_->happened(time, step_, event, cell);
  }
  // The step changes first, so that an action may raise the next event from where it now stands.
  step_ = cell.next;
  if (!keeps_message(cell.action)) {
    messages_.clear();
    if (event != Event::kSayAccept) {
      replanning_.withdraw_question();
    }
  }
  act(cell.action, event, time);
}

void Session::watch_map(const StereoFrame& frame) {
  const bool moved = map_epoch_ && *map_epoch_ != frame.map_epoch;
  map_epoch_ = frame.map_epoch;
  // With a patient reference nothing hangs on the map.
  if (moved && !anchored()) {
    handle(Event::kMapMoved, frame.time);
  }
}

void Session::watch_reference(Timestamp now) {
  const nav::Anchor* anchor = tools_.tracker().anchor();
  if (anchor == nullptr) {
    return;
  }
  if (std::exchange(reference_moves_, anchor->moves) != anchor->moves) {
    handle(Event::kReferenceMoved, now);
  }
  const bool hidden = anchor->stale(now, options_.stale_after);
  if (std::exchange(reference_hidden_, hidden) != hidden) {
    handle(hidden ? Event::kReferenceHidden : Event::kReferenceSeen, now);
  }
}

void Session::watch_tool_in_use(Timestamp now) {
  const auto tool = tool_of_step();
  if (tool != in_use_.tool()) {
    in_use_ = ToolInUse(tool);
  }
  if (!tool) {
    return;
  }
  if (const auto event = in_use_.look(tools_.watch(*tool), now, options_.stale_after)) {
    handle(*event, now);
  }
}

/// Before a drill is set the surgeon can go back and touch the landmark; once it is, the SD that is
/// shown grows.
void Session::watch_drift(Timestamp now) {
  const auto& found = level().bone_found;
  if (step_ != Step::kGuide || !found || !options_.steps.landmark ||
      guiding_.drill().phase != nav::DrillPhase::kAway ||
      !(found->walked_sd_m(now) > options_.landmark.most_walked_m)) {
    return;
  }
  const BoneUnchecked unchecked{seconds(now - found->time), 2.0 * found->walked_sd_m(now)};
  handle(Event::kBoneUnchecked, now);
  messages_.say(unchecked, now);
}

void Session::collect_samples() {
  const nav::TrackedPose& pose = tools_.watch(tools_.pointer()).newest();
  const nav::ToolGeometry& pointer = tools_.geometry(tools_.pointer());
  if (step_ == Step::kDigitize) {
    digitizing_.collect(pose, pointer);
    digitizing_.coach(level().plan);
  } else if (step_ == Step::kPlaced) {
    collect_sleeve();
  } else if (is_touched_in()) {
    if (pose.status == PoseStatus::kMeasured) {
      touch_of_step().add(pose.value * pointer.tip_in_marker);
    } else {
      touch_of_step().lose();
    }
    collect_guide_tip();
  }
}

void Session::collect_guide_tip() {
  const nav::TrackedPose& pose = tools_.watch(tools_.guide()).newest();
  if (by_touch(Step::kAccepted) && pose.status == PoseStatus::kMeasured) {
    tip_check_.touch().add(pose.value * tools_.geometry(tools_.guide()).tip_in_marker);
  } else {
    tip_check_.touch().lose();
  }
}

std::optional<std::size_t> Session::tool_of_step() const {
  // With the landmark touched, what comes next is the guide's.
  if (step_ == Step::kGuide || step_ == Step::kPlaced ||
      (by_touch(Step::kAccepted) && landmarking_.touched())) {
    return tools_.guide();
  }
  if (step_ == Step::kDigitize || is_touched_in()) {
    return tools_.pointer();
  }
  return std::nullopt;
}

bool Session::by_touch(Step step) const {
  const bool touched =
      step == Step::kVerify ? options_.steps.check_points : options_.steps.dimple();
  return step_ == step && touched;
}

bool Session::is_touched_in() const {
  return step_ == Step::kRod || by_touch(Step::kVerify) || by_touch(Step::kAccepted);
}

}  // namespace orthonav::engine
