#include "tests/hal/sim/fake_engine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/sim/shown_cross.h"

namespace orthonav::sim {
namespace {

std::size_t tool_of(const RoomDescription& room, ToolKind kind) {
  for (std::size_t i = 0; i < room.tools.size(); ++i) {
    if (room.tools[i].kind == kind) {
      return i;
    }
  }
  return 0;
}

}  // namespace

SimOptions without_pixels(std::uint64_t seed, const ErrorModel& error_model) {
  SimOptions options;
  options.seed = seed;
  options.error_model = error_model;
  options.render = false;
  return options;
}

FakeEngine::FakeEngine(SimHeadset& headset, const TestCase& test_case, EngineOptions options)
    : headset_(headset), case_(test_case), options_(options) {
  order_ = test_case.room.operated;
  if (order_.empty()) {
    for (const RoomLevel& level : test_case.room.levels) {
      order_.push_back(level.label);
    }
  }
}

int FakeEngine::run() {
  StereoFrame frame;
  std::vector<ClickerEvent> clicks;
  std::vector<Phrase> phrases;
  int frames = 0;
  for (;;) {
    const auto next = headset_.cameras().next(frame);
    if (!next || *next == Next::kEnd) {
      return next ? frames : -1;
    }
    ++frames;
    clicks.clear();
    phrases.clear();
    if (!headset_.clicker().poll(frame.time, clicks)) {
      return -1;
    }
    if (!headset_.voice().poll(frame.time, phrases)) {
      return -1;
    }
    for (const ClickerEvent& event : clicks) {
      take(event);
    }
    for (const Phrase& phrase : phrases) {
      take(phrase);
    }
    draw(frame);
    if (on_frame) {
      on_frame(frame, step_);
    }
  }
}

void FakeEngine::enter(const StepOnDisplay& step) {
  step_ = step;
  notice_ = Notice::kNone;
  checks_ = ChecksAsked::kNone;
  history_.push_back(name_of(step));
}

void FakeEngine::take(const ClickerEvent& event) {
  clicks_.push_back(event);
  const bool digitizing = (step_.step == Step::kDigitize);
  if (event.action == ClickerAction::kPress) {
    pressed_ = true;
    if (digitizing && !first_press_) {
      first_press_ = event.time;
    }
  }
  if (event.action == ClickerAction::kRelease) {
    pressed_ = false;
  }
  if (event.action == ClickerAction::kDoubleClick && digitizing) {
    double_clicked(event.time);
  }
  const bool checking = options_.check_points > 0 && (step_.step == Step::kVerify);
  if (event.action == ClickerAction::kClick && step_.step == Step::kAccepted && options_.landmark) {
    touched_landmark();
  } else if (event.action == ClickerAction::kClick && step_.step == Step::kPlaced) {
    measured_wire();
  } else if (event.action == ClickerAction::kClick && (checking || (step_.step == Step::kRod))) {
    touched();
  }
}

Point<World> FakeEngine::tip() const {
  const std::size_t pointer = tool_of(case_.room, ToolKind::kPointer);
  return headset_.world_from_room() * headset_.state().room_from_marker[pointer] *
         case_.room.tools[pointer].tip_in_marker;
}

void FakeEngine::touched() {
  const bool head = (step_.step == Step::kRod);
  notice_ = Notice::kNone;
  checks_ = ChecksAsked::kNone;
  if (options_.lost_touches-- > 0) {
    notice_ = Notice::kTouchNotRecorded;
    return;
  }
  if (head) {
    heads_.push_back(tip());
    return;
  }
  levels_[level_label()].checks_in_vertebra.push_back(
      (world_from_vertebra(level_label()).inverse() * tip()).v);
  ask_for_checks();
}

void FakeEngine::touched_landmark() {
  std::vector<Vec3>& touched = levels_[level_label()].landmark_in_vertebra;
  touched.push_back((world_from_vertebra(level_label()).inverse() * tip()).v);
  checks_ = ChecksAsked::kPassed;
  if (touched.size() > 1 && options_.landmark_moves > 0) {
    --options_.landmark_moves;
    enter({Step::kVerify, level_label(), {}});
    notice_ = Notice::kLandmarkMoved;
  }
}

void FakeEngine::look_at_wire() {
  enter({Step::kPlaced, level_label(), case_.screws[screw_].side});
  checks_ = ChecksAsked::kMeasureWire;
}

void FakeEngine::measured_wire() {
  const std::size_t guide = tool_of(case_.room, ToolKind::kGuide);
  const RoomTool& tool = case_.room.tools[guide];
  const auto vertebra_from_marker =
      room_from_vertebra(level_label()).inverse() * headset_.state().room_from_marker[guide];
  levels_[level_label()].sleeves_in_vertebra.emplace_back(
      (vertebra_from_marker * tool.tip_in_marker).v,
      -(vertebra_from_marker * Direction<Marker>{tool.axis_in_marker}).v);
  checks_ = options_.wires_off-- > 0 ? ChecksAsked::kDecideOnWire : ChecksAsked::kPassed;
}

void FakeEngine::answer_about_wire(const std::string& phrase) {
  if (phrase == "accept") {
    checks_ = ChecksAsked::kPassed;
  } else if (phrase == "delete" && options_.no_other_entry) {
    checks_ = ChecksAsked::kKeepWire;
  } else if (phrase == "delete") {
    enter({Step::kGuide, level_label(), case_.screws[screw_].side});
  } else if (phrase == "next" && checks_ != ChecksAsked::kDecideOnWire) {
    next_screw();
  }
}

void FakeEngine::ask_for_checks() {
  const int done = static_cast<int>(levels_[level_label()].checks_in_vertebra.size());
  if (options_.off && done > 1) {
    checks_ = ChecksAsked::kReject;
  } else {
    checks_ = done < options_.check_points ? ChecksAsked::kTouchMore : ChecksAsked::kPassed;
  }
}

void FakeEngine::double_clicked(Timestamp time) {
  region_.clear();
  DigitizedLevel& level = levels_[level_label()];
  level.duration_s = seconds(time - *first_press_);
  if (attempts_++ < options_.refusals) {
    notice_ = Notice::kRegistrationRefused;
    return;
  }
  enter({Step::kVerify, level_label(), {}});
  level.checks_in_vertebra.clear();
  if (options_.check_points > 0) {
    ask_for_checks();
  }
}

void FakeEngine::take(const Phrase& phrase) {
  phrases_.push_back(phrase);
  if (options_.deaf) {
    return;
  }
  DigitizedLevel& level = levels_[level_label()];
  if (step_.step == Step::kSetup && phrase.text == "start") {
    enter({Step::kDigitize, level_label(), {}});
  } else if ((step_.step == Step::kDigitize) && phrase.text == "save") {
    level.saved_samples += static_cast<int>(region_.size());
    level.samples_in_vertebra.insert(level.samples_in_vertebra.end(), region_.begin(),
                                     region_.end());
    region_.clear();
  } else if ((step_.step == Step::kDigitize) && phrase.text == "delete") {
    ++level.deleted_regions;
    region_.clear();
  } else if ((step_.step == Step::kVerify) && phrase.text == "accept") {
    enter({Step::kAccepted, level_label(), {}});
    checks_ = options_.landmark ? ChecksAsked::kTouchMore : ChecksAsked::kNone;
  } else if ((step_.step == Step::kVerify) && phrase.text == "reject") {
    level = {};
    first_press_.reset();
    enter({Step::kDigitize, level_label(), {}});
  } else if (step_.step == Step::kGuide && options_.wire && phrase.text == "next") {
    look_at_wire();
  } else if (step_.step == Step::kPlaced) {
    answer_about_wire(phrase.text);
  } else if (((step_.step == Step::kAccepted) || (step_.step == Step::kGuide)) &&
             phrase.text == "next") {
    next_screw();
  } else if (step_ == StepOnDisplay{Step::kRod, {}, Side::kLeft} && phrase.text == "done") {
    enter({Step::kRod, {}, Side::kRight});
  } else if (step_ == StepOnDisplay{Step::kRod, {}, Side::kRight} && phrase.text == "done") {
    enter({Step::kDone, {}, {}});
  }
}

void FakeEngine::next_screw() {
  const bool before_one = (step_.step == Step::kAccepted);
  const std::size_t first = before_one ? (guided_here_ ? screw_ + 1 : 0) : screw_ + 1;
  for (std::size_t i = first; i < case_.screws.size(); ++i) {
    if (case_.screws[i].level == level_label() && options_.landmark && !before_one) {
      enter({Step::kAccepted, level_label(), {}});
      checks_ = ChecksAsked::kTouchMore;
      return;
    }
    if (case_.screws[i].level == level_label()) {
      guided_here_ = true;
      screw_ = i;
      return enter({Step::kGuide, level_label(), case_.screws[i].side});
    }
  }
  guided_here_ = false;
  first_press_.reset();
  attempts_ = 0;
  if (++level_ < order_.size()) {
    return enter({Step::kDigitize, level_label(), {}});
  }
  --level_;
  enter({Step::kRod, {}, Side::kLeft});
}

const RoomLevel& FakeEngine::level_named(const std::string& label) const {
  return *std::find_if(case_.room.levels.begin(), case_.room.levels.end(),
                       [&label](const RoomLevel& level) { return level.label == label; });
}

Transform<Room, Vertebra> FakeEngine::room_from_vertebra(const std::string& label) const {
  return headset_.state().room_from_spine * level_named(label).spine_from_vertebra;
}

Transform<Room, Vertebra> FakeEngine::room_from_shown(const std::string& label) const {
  const Transform<Room, Vertebra> truth = room_from_vertebra(label);
  return {rotation_from_vector(options_.registration_rotation_rad) * truth.rotation(),
          truth.translation() + options_.registration_error_m};
}

Transform<World, Vertebra> FakeEngine::world_from_vertebra(const std::string& label) const {
  return headset_.world_from_room() *
         (options_.peeks ? room_from_vertebra(label) : room_from_shown(label));
}

Transform<Vertebra, Vertebra> FakeEngine::vertebra_from_shown(const std::string& label) const {
  return room_from_vertebra(label).inverse() * room_from_shown(label);
}

void FakeEngine::draw(const StereoFrame& frame) {
  const RoomState state = headset_.state();
  const double time_s = seconds(frame.time.time_since_epoch()) - 100.0;
  const bool blind = time_s >= options_.blind_from_s && time_s < options_.blind_to_s;
  if (pressed_ && (step_.step == Step::kDigitize)) {
    const std::size_t pointer = tool_of(case_.room, ToolKind::kPointer);
    const auto tip = world_from_vertebra(level_label()).inverse() * headset_.world_from_room() *
                     state.room_from_marker[pointer] * case_.room.tools[pointer].tip_in_marker;
    if (state.tool_present[pointer]) {
      region_.push_back(tip.v);
    }
  }
  ShownFrame shown;
  shown.pose_time = frame.time;
  shown.display_time = headset_.display().predicted_display_time(headset_.clock().now());
  shown.status = ShownStatus{step_, notice_, checks_, {}, {}};
  if ((step_.step == Step::kVerify)) {
    ShownHologram model{.kind = HologramKind::kVertebra};
    const auto& vertices = level_named(level_label()).vertices_m;
    for (const Vec3 d : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}}) {
      const Vec3 extreme = *std::max_element(vertices.begin(), vertices.end(),
                                             [d](Vec3 a, Vec3 b) { return a.dot(d) < b.dot(d); });
      model.points_in_world.push_back(world_from_vertebra(level_label()) *
                                      Point<Vertebra>{extreme});
    }
    shown.holograms.push_back(model);
  }
  if ((step_.step == Step::kGuide)) {
    draw_screw(shown, state, blind);
  }
  static_cast<void>(headset_.display().shown(shown));
}

void FakeEngine::draw_screw(ShownFrame& shown, const RoomState& state, bool blind) const {
  const TestScrew& screw = case_.screws[screw_];
  const auto from_vertebra = world_from_vertebra(screw.level);
  const Point<World> entry = from_vertebra * screw.entry;
  const Point<World> target = from_vertebra * screw.target;
  const Vec3 outwards = (entry - target).normalized();
  shown.holograms.push_back({.kind = HologramKind::kEntry,
                             .level = screw.level,
                             .side = screw.side,
                             .points_in_world = {entry}});
  shown.holograms.push_back({.kind = HologramKind::kTrajectory,
                             .points_in_world = {entry + 0.060 * outwards, entry, target}});
  const std::size_t guide = tool_of(case_.room, ToolKind::kGuide);
  if (blind || !state.tool_present[guide]) {
    return;
  }
  const auto world_from_marker = headset_.world_from_room() * state.room_from_marker[guide];
  const RoomTool& tool = case_.room.tools[guide];
  const Vec3 axis = (world_from_marker * Direction<Marker>{tool.axis_in_marker}).v;
  if ((world_from_marker * tool.tip_in_marker - entry).norm() > 0.040) {
    return;
  }
  // To a tenth of a degree, as the readout has it.
  const double angle_deg = angle_between_rad(axis, outwards) * 180.0 / std::numbers::pi;
  const double reading_rad = std::round(10.0 * angle_deg) / 10.0 * std::numbers::pi / 180.0;
  shown.holograms.push_back(
      {.kind = HologramKind::kTriangle,
       .points_in_world = {entry, entry + kCrossReach_m * axis, entry + kCrossReach_m * outwards}});
  shown.holograms.push_back({.kind = HologramKind::kAngle, .reading = reading_rad});
  const Vec3 tip = world_from_marker * tool.tip_in_marker - entry;
  const auto dot = [&](Vec3 from_entry) {
    const Vec3 offset = from_entry - outwards * from_entry.dot(outwards);
    const double held = std::min(1.0, kCrossRim_m / std::max(kCrossRim_m, offset.norm()));
    return entry + kCrossScale * held * offset;
  };
  shown.holograms.push_back(
      {.kind = HologramKind::kCross,
       .points_in_world = {entry, dot(tip), dot(tip + kCrossReach_m * axis)}});
  draw_numbers(shown, screw, tip, axis);
}

}  // namespace orthonav::sim
