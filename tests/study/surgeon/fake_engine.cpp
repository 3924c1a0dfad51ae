#include "tests/study/surgeon/fake_engine.h"

#include <algorithm>

namespace orthonav::sim {
std::size_t tool_of(const RoomDescription& room, ToolKind kind) {
  for (std::size_t i = 0; i < room.tools.size(); ++i) {
    if (room.tools[i].kind == kind) {
      return i;
    }
  }
  return 0;
}

SimOptions without_pixels(std::uint64_t seed, const ErrorModel& error_model) {
  SimOptions options;
  options.surgeon = ScriptedSurgeon::bring;
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
    const auto next = headset_.cameras()->next(frame);
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
    sample();
    draw(frame);
    if (on_frame) {
      on_frame(frame, step_);
    }
  }
}

void FakeEngine::enter(const StepOnDisplay& step) {
  step_ = step;
  view_at_first_.reset();
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
  if (event.action == ClickerAction::kClick && step_.step == Step::kTouchLandmark &&
      options_.landmark) {
    touched_landmark();
  } else if (event.action == ClickerAction::kClick && step_.step == Step::kMeasureWire) {
    measured_wire();
  } else if (event.action == ClickerAction::kClick && (checking || (step_.step == Step::kRod))) {
    touched();
  }
}

void FakeEngine::sample() {
  const RoomState state = headset_.state();
  const std::size_t pointer = tool_of(case_.room, ToolKind::kPointer);
  if (!pressed_ || step_.step != Step::kDigitize || !state.tool_present[pointer]) {
    return;
  }
  const auto tip = world_from_vertebra(level_label()).inverse() * headset_.world_from_room() *
                   state.room_from_marker[pointer] * case_.room.tools[pointer].tip_in_marker;
  region_.push_back(tip.v);
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
  enter({Step::kMeasureWire, level_label(), case_.screws[screw_].side});
  checks_ = ChecksAsked::kRecordWire;
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
  if (phrase == "accept result") {
    checks_ = ChecksAsked::kPassed;
  } else if (phrase == "delete last" && options_.no_other_entry) {
    checks_ = ChecksAsked::kKeepWire;
  } else if (phrase == "delete last") {
    enter({Step::kGuide, level_label(), case_.screws[screw_].side});
  } else if (phrase == "go to next" && checks_ != ChecksAsked::kDecideOnWire) {
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
  if (step_.step == Step::kSetup && phrase.text == "begin guiding") {
    enter({Step::kDigitize, level_label(), {}});
  } else if ((step_.step == Step::kDigitize) && phrase.text == "save points") {
    level.saved_samples += static_cast<int>(region_.size());
    level.samples_in_vertebra.insert(level.samples_in_vertebra.end(), region_.begin(),
                                     region_.end());
    region_.clear();
  } else if ((step_.step == Step::kDigitize) && phrase.text == "delete last") {
    ++level.deleted_regions;
    region_.clear();
  } else if ((step_.step == Step::kVerify) && phrase.text == "accept result") {
    enter({Step::kTouchLandmark, level_label(), {}});
    checks_ = options_.landmark ? ChecksAsked::kTouchMore : ChecksAsked::kNone;
  } else if ((step_.step == Step::kVerify) && phrase.text == "reject level") {
    level = {};
    first_press_.reset();
    enter({Step::kDigitize, level_label(), {}});
  } else if (step_.step == Step::kGuide && options_.wire && phrase.text == "go to next") {
    look_at_wire();
  } else if (step_.step == Step::kMeasureWire) {
    answer_about_wire(phrase.text);
  } else if (((step_.step == Step::kTouchLandmark) || (step_.step == Step::kGuide)) &&
             phrase.text == "go to next") {
    next_screw();
  } else if (step_ == StepOnDisplay{Step::kRod, {}, Side::kLeft} && phrase.text == "finish rod") {
    enter({Step::kRod, {}, Side::kRight});
  } else if (step_ == StepOnDisplay{Step::kRod, {}, Side::kRight} && phrase.text == "finish rod") {
    enter({Step::kDone, {}, {}});
  }
}

void FakeEngine::next_screw() {
  const bool before_one = (step_.step == Step::kTouchLandmark);
  const std::size_t first = before_one ? (guided_here_ ? screw_ + 1 : 0) : screw_ + 1;
  for (std::size_t i = first; i < case_.screws.size(); ++i) {
    if (case_.screws[i].level == level_label() && options_.landmark && !before_one) {
      enter({Step::kTouchLandmark, level_label(), {}});
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

}  // namespace orthonav::sim
