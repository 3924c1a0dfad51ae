#include "engine/session/session.h"

#include <algorithm>
#include <utility>

#include "base/joined.h"
#include "engine/session/spoken_commands.h"

namespace orthonav::engine {
namespace {

Result<std::size_t> only_tool(std::span<const nav::ToolGeometry> tools, nav::ToolRole role,
                              const char* name) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (tools[i].role != role) {
      continue;
    }
    if (found) {
      return Error{std::string("tools: more than one ") + name + ", exactly 1 needed"};
    }
    found = i;
  }
  if (!found) {
    return Error{std::string("tools: no ") + name + ", exactly 1 needed"};
  }
  return *found;
}

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

}  // namespace

std::vector<std::string> SessionOptions::check() const {
  std::vector<std::string> problems;
  if (stale_after <= Duration::zero() || stale_after > std::chrono::seconds(1)) {
    problems.push_back("stale_after must lie in (0, 1000] ms");
  }
  if (!(min_voice_confidence >= 0.0 && min_voice_confidence <= 1.0)) {
    problems.push_back("min_voice_confidence must lie in [0, 1]");
  }
  if (!(rod_diameter_m >= 0.001 && rod_diameter_m <= 0.02)) {
    problems.push_back("rod_diameter_m must lie in [0.001, 0.02]");
  }
  if (fade < Duration::zero()) {
    problems.push_back("fade must not be negative");
  }
  if (!(max_touch_spread_m > 0.0 && max_touch_spread_m <= 0.01)) {
    problems.push_back("max_touch_spread_m must lie in (0, 0.01]");
  }
  for (const std::string& problem : check_points.check()) {
    problems.push_back(problem);
  }
  if (message_for <= Duration::zero()) {
    problems.push_back("message_for must be positive");
  }
  if (heard_for < Duration::zero()) {
    problems.push_back("heard_for must not be negative");
  }
  return problems;
}

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
  const auto pointer = only_tool(tracker->tools(), nav::ToolRole::kPointer, "pointer");
  if (!pointer) {
    return pointer.error();
  }
  const auto guide = only_tool(tracker->tools(), nav::ToolRole::kGuide, "guide");
  if (!guide) {
    return guide.error();
  }
  return std::unique_ptr<Session>(new Session(std::move(operation), std::move(tracker),
                                              std::move(method), options, *pointer, *guide));
}

Session::Session(Operation operation, std::unique_ptr<nav::ToolTracker> tracker, Method method,
                 const SessionOptions& options, std::size_t pointer, std::size_t guide)
    : tracker_(std::move(tracker)),
      method_(std::move(method)),
      options_(options),
      pointer_(pointer),
      guide_(guide) {
  for (OperatedLevel& plan : operation.levels) {
    LevelState state;
    state.screw_done.assign(plan.screws.size(), false);
    state.plan = std::move(plan);
    levels_.push_back(std::move(state));
  }
  rods_.resize(2);
  rods_[0].side = nav::Side::kLeft;
  rods_[1].side = nav::Side::kRight;
  watches_.resize(tracker_->tools().size());
  for (const nav::ToolGeometry& tool : tracker_->tools()) {
    sights_.push_back({tool.name, tool.role, PoseStatus::kLost});
  }
  touch_.reserve(64);
  if (method_.coaching) {
    coach_ = std::make_unique<Coach>(method_.registrar);
  }
}

const Guidance& Session::step(const StereoFrame& frame, const Inputs& inputs) {
  // Nothing that was measured in another map may answer an event.
  watch_map(frame);
  // Events first: a press before this pair makes this pair a sample, a release before it does not.
  answer_inputs(inputs);
  track(frame);
  watch_active_tool(frame.time);
  collect_samples();
  if (coach_ && step_ == Step::kDigitize) {
    coach_->step(level().plan, digitizer_.regions());
  }
  publish(frame, inputs.display_time);
  return guidance_;
}

const Guidance& Session::expire(Timestamp display_time) {
  guidance_.display_time = display_time;
  guidance_.tool.reset();
  for (ToolSight& sight : sights_) {
    sight.status = PoseStatus::kLost;
  }
  write_step_text();
  guidance_.heard.clear();
  guidance_.detail = "no camera images";
  return guidance_;
}

const Guidance& Session::end(Timestamp display_time) {
  expire(display_time);
  guidance_.blank = true;
  guidance_.detail = "ended";
  return guidance_;
}

void Session::answer_inputs(const Inputs& inputs) {
  std::size_t c = 0;
  std::size_t p = 0;
  while (c < inputs.clicks.size() || p < inputs.phrases.size()) {
    // The clicker goes first at equal times: what is said refers to what was done.
    const bool clicker_next =
        p == inputs.phrases.size() ||
        (c < inputs.clicks.size() && inputs.clicks[c].time <= inputs.phrases[p].time);
    if (clicker_next) {
      click(inputs.clicks[c++]);
    } else {
      hear(inputs.phrases[p++]);
    }
  }
}

void Session::click(const ClickerEvent& event) { handle(event_of(event.action), event.time); }

void Session::hear(const Phrase& phrase) {
  const auto event = command_event(phrase.text);
  const bool sure = phrase.confidence >= options_.min_voice_confidence;
  if (event) {
    echo(phrase, sure);
  }
  if (!event || !sure) {
    if (!sure) {
      say("not understood", phrase.time);
    }
    if (observer_) {
      observer_->not_understood(phrase);
    }
  } else if (precedes_the_hologram(*event, phrase.time)) {
    if (observer_) {
      observer_->happened(phrase.time, step_, *event, Cell{step_, Action::kRefuse});
    }
    say("not accepted: said before the hologram was shown", phrase.time);
  } else {
    handle(*event, phrase.time);
  }
}

bool Session::precedes_the_hologram(Event event, Timestamp spoken) const {
  if (step_ != Step::kVerify || event != Event::kSayAccept) {
    return false;
  }
  return !verify_visible_at_ || spoken < *verify_visible_at_;
}

void Session::handle(Event event, Timestamp time) {
  const Cell cell = answer(step_, event, method_.verification);
  if (observer_) {
    observer_->happened(time, step_, event, cell);
  }
  // The step changes first, so that an action may raise the next event from where it now stands.
  step_ = cell.next;
  act(cell.action, event, time);
}

void Session::track(const StereoFrame& frame) {
  states_ = tracker_->track(frame);
  for (std::size_t i = 0; i < watches_.size() && i < states_.size(); ++i) {
    watches_[i].update(states_[i].world_from_marker);
    sights_[i].status = states_[i].world_from_marker.status;
  }
}

std::optional<std::size_t> Session::active_tool() const {
  if (step_ == Step::kDigitize || step_ == Step::kRod || checks_by_touch()) {
    return pointer_;
  }
  if (step_ == Step::kGuide) {
    return guide_;
  }
  return std::nullopt;
}

void Session::watch_map(const StereoFrame& frame) {
  const bool moved = map_epoch_ && *map_epoch_ != frame.map_epoch;
  map_epoch_ = frame.map_epoch;
  if (moved) {
    handle(Event::kMapMoved, frame.time);
  }
}

void Session::watch_active_tool(Timestamp now) {
  const auto tool = active_tool();
  if (tool != seen_tool_) {
    // A tool that was just taken into use was not lost; it has not been found yet.
    seen_tool_ = tool;
    seen_ = Seen::kNever;
    guidance_hidden_ = false;
  }
  if (!tool) {
    return;
  }
  const ToolWatch& watch = watches_[*tool];
  if (watch.measured_now()) {
    if (std::exchange(seen_, Seen::kMeasured) != Seen::kMeasured) {
      handle(Event::kTrackingRegained, now);
    }
  } else if (seen_ == Seen::kMeasured) {
    seen_ = Seen::kLost;
    handle(Event::kTrackingLost, now);
  } else if (seen_ == Seen::kLost && !watch.fresh(now, options_.stale_after)) {
    seen_ = Seen::kStale;
    handle(Event::kPoseStale, now);
  }
}

void Session::collect_samples() {
  const nav::TrackedPose& pose = watches_[pointer_].newest();
  const nav::ToolGeometry& pointer = tracker_->tools()[pointer_];
  const Point<Marker> tip = pointer.tip_in_marker;
  if (step_ == Step::kDigitize && digitizer_.recording()) {
    digitizer_.add(pose, tip, pointer.axis_in_marker);
  }
  if (touching_ && (step_ == Step::kRod || checks_by_touch()) &&
      pose.status == PoseStatus::kMeasured) {
    touch_.push_back(pose.value * tip);
  }
}

void Session::publish(const StereoFrame& frame, Timestamp display_time) {
  Guidance& out = guidance_;
  out.frame_time = frame.time;
  out.display_time = display_time;
  if (step_ == Step::kVerify && !verify_visible_at_) {
    verify_visible_at_ = display_time;
  }
  const auto tool = active_tool();
  out.pose_time = tool ? watches_[*tool].last_measured().value_or(Timestamp{}) : frame.time;
  out.step = step_;
  out.levels = levels_;
  out.level = level_;
  out.screw = screw_;
  out.regions = digitizer_.regions();
  const bool fading =
      !dropped_.region.samples.empty() && display_time - dropped_.dropped_at <= options_.fade;
  out.dropped = fading ? &dropped_ : nullptr;
  out.stale_after = options_.stale_after;
  out.fade = options_.fade;
  out.blank = false;
  out.rods = rods_;
  out.rods_moved_away = rods_moved_away_;
  out.tools = sights_;
  if (frame.world_from_rig) {
    out.head = frame.world_from_rig;
  }
  out.twin = twin_;
  out.residuals_m = {};
  out.unstroked = {};
  out.to_check = {};
  if (step_ == Step::kVerify) {
    out.residuals_m = residuals_m_;
    out.unstroked = unstroked_;
    out.to_check = to_check_;
  }
  publish_tool_guidance(frame.time, display_time);
  write_step_text();
  write_detail();
}

void Session::publish_tool_guidance(Timestamp now, Timestamp display_time) {
  guidance_.tool.reset();
  if (step_ != Step::kGuide || guidance_hidden_ || !level().registration) {
    return;
  }
  const ToolWatch& watch = watches_[guide_];
  if (!watch.fresh(now, options_.stale_after)) {
    return;
  }
  // Between two measurements the overlay is predicted, as long as the tracker itself still follows
  // the tool; the number is not.
  const nav::TrackedPose at_display = watch.at(display_time, options_.stale_after);
  if (watch.newest().status == PoseStatus::kLost || at_display.status == PoseStatus::kLost) {
    return;
  }
  const nav::ToolGeometry& tool = tracker_->tools()[guide_];
  const auto& world_from_vertebra = level().registration->world_from_vertebra;
  const nav::ScrewPlan& plan = level().plan.screws[screw_];
  const auto guide = [&](const Transform<World, Marker>& pose) {
    return nav::guide(world_from_vertebra, plan, pose * tool.tip_in_marker,
                      (pose * tool.axis_in_marker).v);
  };
  guidance_.tool = ToolGuidance{std::nullopt, guide(at_display.value),
                                watch.last_measured().value_or(Timestamp{})};
  if (!watch.measured_now()) {
    return;
  }
  guidance_.tool->measured = guide(watch.newest().value);
  last_guidance_ = guidance_.tool;
}

}  // namespace orthonav::engine
