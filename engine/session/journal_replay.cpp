#include "engine/session/journal_replay.h"

#include <algorithm>
#include <utility>

#include "engine/session/journal_rod_reading.h"

namespace orthonav::engine {
namespace {

/// More than any spine has.
constexpr std::size_t kMostLevels = 100;

}  // namespace

void JournalReplay::plan(const std::string& label, const std::vector<std::string>& sides,
                         const JsonNode& line) {
  RecordedLevel* level = level_named(label, line);
  for (const std::string& side : sides) {
    if (side != "left" && side != "right") {
      return line.refuse("screws", "must be left or right");
    }
    if (level) {
      level->screws.emplace_back().side = side == "right" ? Side::kRight : Side::kLeft;
    }
  }
}

RecordedLevel* JournalReplay::level_named(const std::string& label, const JsonNode& line) {
  auto& levels = record_.levels;
  const auto found = std::find_if(levels.begin(), levels.end(),
                                  [&](const RecordedLevel& level) { return level.label == label; });
  if (found != levels.end()) {
    return &*found;
  }
  if (levels.size() >= kMostLevels) {
    line.refuse("level", "is the 101st, limit 100");
    return nullptr;
  }
  levels.emplace_back().label = label;
  return &levels.back();
}

RecordedLevel* JournalReplay::current() { return level_ ? &record_.levels[*level_] : nullptr; }

RecordedRod& JournalReplay::rod_of(Side side) {
  auto& rods = record_.rods;
  const auto found = std::find_if(rods.begin(), rods.end(),
                                  [side](const RecordedRod& rod) { return rod.side == side; });
  if (found != rods.end()) {
    return *found;
  }
  rods.emplace_back().side = side;
  return rods.back();
}

void JournalReplay::forget_registration(RecordedLevel& level) {
  level.registration.reset();
  level.digitization_s.reset();
  level.checks.clear();
  level.accepted = false;
}

void JournalReplay::forget_map() {
  for (RecordedLevel& level : record_.levels) {
    if (!level.finished) {
      forget_registration(level);
    }
  }
  for (RecordedRod& rod : record_.rods) {
    if (!rod.done) {
      rod.heads = 0;
    }
  }
  first_press_.reset();
}

void JournalReplay::happened(Timestamp time, Event event, Cell answer) {
  if (record_.steps.empty() || record_.steps.back().step != answer.next) {
    record_.steps.push_back({time, answer.next});
  }
  RecordedLevel* const level = current();
  if (level && (event == Event::kAnotherLevel || event == Event::kNoScrewLeft ||
                event == Event::kNoRodPlanned)) {
    level->finished = true;
  }
  switch (answer.action) {
    case Action::kStartSampling:
      first_press_ = first_press_.value_or(time);
      return;
    case Action::kBeginLevel:
      first_press_.reset();
      return;
    case Action::kAccept:
      if (level) {
        level->accepted = true;
      }
      return;
    case Action::kClearLevel:
      if (level) {
        forget_registration(*level);
      }
      first_press_.reset();
      return;
    case Action::kVerifyAgain:
      if (level) {
        level->accepted = false;
        level->checks.clear();
      }
      return;
    case Action::kForgetMap:
      return forget_map();
    default:
      return;
  }
}

void JournalReplay::registered(RecordedRegistration found, const JsonNode& line) {
  RecordedLevel* const level = level_named(found.level, line);
  if (!level) {
    return;
  }
  level_ = static_cast<std::size_t>(level - record_.levels.data());
  level->attempts = std::max(level->attempts, found.attempt);
  if (found.passed) {
    level->accepted = found.accepted_earlier;
    level->registration = record_.registrations.size();
    level->digitization_s.reset();
    if (first_press_) {
      level->digitization_s = seconds(found.time - *first_press_);
    }
  }
  record_.registrations.push_back(std::move(found));
}

void JournalReplay::accepted(const std::string& label, const Expected& expected,
                             const JsonNode& line) {
  RecordedLevel* const level = level_named(label, line);
  if (level && !level->registration) {
    line.refuse("level", "has no registration that could be accepted");
  } else if (level) {
    RecordedRegistration& found = record_.registrations[*level->registration];
    found.predicted_tre_m = expected.predicted_tre_m;
    found.tre_95_m = expected.tre_95_m;
  }
}

void JournalReplay::checked(const std::string& label, RecordedCheck check, const JsonNode& line) {
  if (RecordedLevel* const level = level_named(label, line)) {
    level->checks.push_back(check);
  }
}

void JournalReplay::check_dropped(const std::string& label, const JsonNode& line) {
  RecordedLevel* const level = level_named(label, line);
  if (level && level->checks.empty()) {
    line.refuse("level", "has no check point that could be dropped");
  } else if (level) {
    level->checks.pop_back();
  }
}

void JournalReplay::landmark(const std::string& label, RecordedLandmark touch,
                             const JsonNode& line) {
  if (RecordedLevel* const level = level_named(label, line)) {
    level->landmark.push_back(touch);
  }
}

void JournalReplay::landmark_dropped(const std::string& label, const JsonNode& line) {
  RecordedLevel* const level = level_named(label, line);
  if (level && level->landmark.empty()) {
    line.refuse("level", "has no touch of a landmark that could be dropped");
  } else if (level) {
    level->landmark.back().dropped = true;
  }
}

RecordedScrew* JournalReplay::screw_of(const std::string& label, Side side, const JsonNode& line) {
  RecordedLevel* const level = level_named(label, line);
  if (!level) {
    return nullptr;
  }
  for (RecordedScrew& screw : level->screws) {
    if (screw.side == side) {
      return &screw;
    }
  }
  level->screws.emplace_back().side = side;
  return &level->screws.back();
}

void JournalReplay::wire_measured(const std::string& label, Side side, const RecordedWire& wire,
                                  const JsonNode& line) {
  if (RecordedScrew* const screw = screw_of(label, side, line)) {
    screw->wire = wire;
  }
}

/// The measurement was of a wire that is taken out.
void JournalReplay::screw_redone(const std::string& label, Side side, const JsonNode& line) {
  if (RecordedScrew* const screw = screw_of(label, side, line)) {
    screw->wire.reset();
    ++screw->redone;
  }
}

void JournalReplay::screw_done(const std::string& label, const RecordedScrew& screw,
                               const JsonNode& line) {
  RecordedScrew* const known = screw_of(label, screw.side, line);
  if (!known) {
    return;
  }
  known->done = screw.done;
  known->time = screw.time;
  known->at_depth = screw.at_depth;
  known->executed = screw.executed;
  known->not_measured = screw.not_measured;
  known->wire_asked = screw.wire_asked;
  if (line.text_or("wire", "") == "not measured") {
    known->wire.reset();  // an earlier one belongs to a discarded registration
  }
}

void JournalReplay::replanned(const std::string& label, Side side,
                              const std::optional<nav::ScrewDifference>& difference,
                              const JsonNode& line) {
  if (RecordedScrew* const screw = screw_of(label, side, line)) {
    screw->planned_in_surgery = difference;
  }
}

void JournalReplay::head(Side side, bool touched, const JsonNode& line) {
  RecordedRod& rod = rod_of(side);
  rod.heads = heads_after(line, touched, rod.heads);
}

void JournalReplay::rod_done(RecordedRod rod) {
  RecordedRod& known = rod_of(rod.side);
  known = std::move(rod);
}

}  // namespace orthonav::engine
