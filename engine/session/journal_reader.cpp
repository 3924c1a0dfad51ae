#include "engine/session/journal_reader.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/angle.h"
#include "base/units.h"
#include "engine/io/json_document.h"
#include "engine/session/operation_json.h"
#include "engine/session/session_record.h"
#include "nav/guidance/changed_screw.h"

namespace orthonav::engine {
namespace {

std::optional<double> optional_number(const JsonNode& line, const char* key, double unit = 1.0) {
  return line.has(key) ? std::optional(line.number(key) * unit) : std::nullopt;
}

RecordedRod recorded_rod_of(const JsonNode& line) {
  RecordedRod rod;
  rod.side = side_from(line);
  rod.heads = count_of(line, "heads");
  rod.done = true;
  rod.length_m = optional_number(line, "length_mm", kMetresPerMm);
  if (line.has("bends")) {
    for (const JsonNode& bend : line.list("bends")) {
      rod.bends.push_back({bend.number("arc_length_mm") * kMetresPerMm,
                           bend.number("angle_deg") * kRadiansPerDegree});
    }
  }
  rod.cut_length_m = optional_number(line, "cut_length_mm", kMetresPerMm);
  rod.no_instructions = line.text_or("no_instructions", "");
  if (line.has("instructions")) {
    for (const JsonNode& bend : line.list("instructions")) {
      rod.instructions.push_back({bend.number("arc_length_mm") * kMetresPerMm,
                                  bend.number("roll_deg") * kRadiansPerDegree,
                                  bend.number("angle_deg") * kRadiansPerDegree,
                                  bend.number("set_deg") * kRadiansPerDegree});
    }
  }
  if (line.has("touched")) {
    for (const JsonNode& head : line.list("touched")) {
      rod.touched.push_back({count_of(head, "touches"), head.number("sd_mm") * kMetresPerMm});
    }
  }
  rod.expected_within = optional_number(line, "expected_within_share");
  return rod;
}

std::optional<std::array<double, nav::kPedicleGrades>> grades_of(const JsonNode& line) {
  if (!line.has("grade_probability")) {
    return std::nullopt;
  }
  const JsonNode node = line.child("grade_probability");
  std::array<double, nav::kPedicleGrades> out{};
  for (std::size_t g = 0; g < nav::kPedicleGrades; ++g) {
    out[g] = node.number(nav::name_of(static_cast<nav::PedicleGrade>(g)));
  }
  return out;
}

std::optional<RecordedPose> pose_of(const JsonNode& line) {
  if (!line.has("angle_deg")) {
    return std::nullopt;
  }
  return RecordedPose{line.number("angle_deg") * kRadiansPerDegree,
                      line.number("tip_to_entry_mm") * kMetresPerMm,
                      line.number("tip_off_axis_mm") * kMetresPerMm,
                      line.number("depth_mm") * kMetresPerMm,
                      optional_number(line, "clearance_mm", kMetresPerMm),
                      optional_number(line, "clearance_95_mm", kMetresPerMm),
                      line.text_or("grade", ""),
                      grades_of(line)};
}

std::optional<std::array<double, 9>> covariance_of(const JsonNode& node, const char* key,
                                                   double unit) {
  if (!node.has(key)) {
    return std::nullopt;
  }
  const std::vector<double> values = node.numbers(key, 9);
  std::array<double, 9> out{};
  for (std::size_t i = 0; i < std::min(values.size(), out.size()); ++i) {
    out[i] = values[i] * unit;
  }
  return out;
}

std::optional<nav::ExecutedTrajectory> executed_of(const JsonNode& line) {
  if (!line.has("executed")) {
    return std::nullopt;
  }
  const JsonNode node = line.child("executed");
  nav::ExecutedTrajectory out;
  out.axis = {{node.vec3("entry_mm") * kMetresPerMm}, node.vec3("direction")};
  out.depth_m = node.number("depth_mm") * kMetresPerMm;
  out.pairs = static_cast<std::size_t>(std::max(0, node.integer("pairs")));
  out.point_covariance_m2 =
      covariance_of(node, "entry_covariance_mm2", kMetresPerMm * kMetresPerMm);
  out.direction_covariance_rad2 = covariance_of(node, "direction_covariance_rad2", 1.0);
  if (out.point_covariance_m2.has_value() != out.direction_covariance_rad2.has_value()) {
    node.refuse("direction_covariance_rad2", "must stand beside entry_covariance_mm2");
  }
  return out;
}

RecordedWire wire_of(const JsonNode& line) {
  return {line.number("angle_deg") * kRadiansPerDegree,
          line.number("angle_sd_deg") * kRadiansPerDegree,
          line.number("entry_mm") * kMetresPerMm,
          line.number("entry_sd_mm") * kMetresPerMm,
          line.flag_or("within", false),
          line.flag_or("kept", false)};
}

RecordedScrew screw_of(const JsonNode& line, Timestamp time) {
  RecordedScrew screw;
  screw.side = side_from(line);
  screw.done = true;
  screw.time = time;
  screw.at_depth = pose_of(line);
  screw.executed = executed_of(line);
  if (line.has("not_measured")) {
    screw.not_measured = line.texts("not_measured");
  }
  screw.wire_asked = line.has("wire");
  return screw;
}

std::optional<nav::ScrewDifference> planned_in_surgery(const JsonNode& line) {
  if (!line.has("planned_in_surgery")) {
    return std::nullopt;
  }
  const JsonNode by = line.child("planned_in_surgery");
  return nav::ScrewDifference{by.number("entry_cranial_mm") * kMetresPerMm,
                              by.number("entry_medial_mm") * kMetresPerMm,
                              by.number("entry_inward_mm") * kMetresPerMm,
                              by.number("aim_cranial_deg") * kRadiansPerDegree,
                              by.number("aim_medial_deg") * kRadiansPerDegree,
                              by.number("diameter_from_mm") * kMetresPerMm,
                              by.number("diameter_to_mm") * kMetresPerMm,
                              by.number("length_from_mm") * kMetresPerMm,
                              by.number("length_to_mm") * kMetresPerMm};
}

/// Follows a session by the lines of its journal, as the session itself did (Session::act): which
/// level is current, what a rejection or a moved map revoked. Errors are noted in `line`.
class JournalReplay {
 public:
  explicit JournalReplay(SessionRecord& record) : record_(record) {}

  /// A level of the plan with the sides of its screws.
  void plan(const std::string& label, const std::vector<std::string>& sides, const JsonNode& line);
  void happened(Timestamp time, Event event, Cell answer);
  void registered(RecordedRegistration found, const JsonNode& line);
  /// The uncertainty of the level's registration, which now includes the touched places.
  struct Expected {
    std::optional<double> predicted_tre_m;
    std::optional<double> tre_95_m;
  };
  void accepted(const std::string& label, const Expected& expected, const JsonNode& line);
  void checked(const std::string& label, RecordedCheck check, const JsonNode& line);
  void check_dropped(const std::string& label, const JsonNode& line);
  void landmark(const std::string& label, RecordedLandmark touch, const JsonNode& line);
  void landmark_dropped(const std::string& label, const JsonNode& line);
  void wire_measured(const std::string& label, Side side, const RecordedWire& wire,
                     const JsonNode& line);
  void screw_redone(const std::string& label, Side side, const JsonNode& line);
  /// An absent difference: back to the preoperative plan.
  void replanned(const std::string& label, Side side,
                 const std::optional<nav::ScrewDifference>& difference, const JsonNode& line);
  void screw_done(const std::string& label, const RecordedScrew& screw, const JsonNode& line);
  /// A head was touched, or the last touch taken back.
  void head(Side side, bool touched, const JsonNode& line);
  void rod_done(RecordedRod rod);

 private:
  /// The level of that name, added if the plan does not contain it. Null, with the line refused, if
  /// there are too many.
  RecordedLevel* level_named(const std::string& label, const JsonNode& line);
  /// Null if there is no such level. The screw is added if the plan does not contain it.
  RecordedScrew* screw_of(const std::string& label, Side side, const JsonNode& line);
  RecordedLevel* current();
  RecordedRod& rod_of(Side side);
  void forget_registration(RecordedLevel& level);
  void forget_map();

  SessionRecord& record_;
  std::optional<std::size_t> level_;      ///< registered last
  std::optional<Timestamp> first_press_;  ///< of the digitization under way
};

/// More than any spine has.
constexpr std::size_t kMostLevels = 100;

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

constexpr std::size_t kLongestLine = 1U << 20U;
/// Clicks and phrases delayed by a network arrive some seconds after later images.
constexpr auto kMostBack = std::chrono::minutes(1);
/// What earlier versions called answers by which nothing changes.
constexpr std::array<std::string_view, 8> kEarlierActions = {
    "count refusal", "ask for checks", "ask for landmark", "ask about wire",
    "offer to keep", "finish",         "warn: not seen",   "consent to breach"};
/// Larger times in nanoseconds are invalid.
constexpr double kLatest_ns = 4e18;

/// The value of an enumeration named under `key`.
template <class Enum>
Enum named(const JsonNode& line, const char* key, std::size_t count) {
  const std::string name = line.text(key);
  for (std::size_t i = 0; i < count; ++i) {
    if (name_of(static_cast<Enum>(i)) == name) {
      return static_cast<Enum>(i);
    }
  }
  line.refuse(key, "\"" + name.substr(0, 40) + "\" is unknown");
  return {};
}

RecordedRegistration registration_of(const JsonNode& line, Timestamp time) {
  RecordedRegistration found;
  found.time = time;
  found.level = line.text("level");
  found.attempt = line.integer("attempt");
  found.passed = line.flag_or("accepted", false);
  found.accepted_earlier = line.flag_or("accepted_earlier", false);
  found.reason = line.text_or("reason", "");
  found.warning = line.text_or("warning", "");
  if (line.has("points")) {
    found.points = count_of(line, "points");
  }
  found.rmse_m = optional_number(line, "rmse_mm", kMetresPerMm);
  found.runner_up_rmse_m = optional_number(line, "runner_up_rmse_mm", kMetresPerMm);
  found.predicted_tre_m = optional_number(line, "predicted_tre_mm", kMetresPerMm);
  found.tre_95_m = optional_number(line, "tre_95_mm", kMetresPerMm);
  if (line.has("registration_only")) {
    found.registration_only = line.flag_or("registration_only", false);
  }
  return found;
}

RecordedLandmark landmark_of(const JsonNode& line) {
  const bool first = line.flag_or("first", false);
  return {first, first ? 0.0 : line.number("off_mm") * kMetresPerMm,
          line.number("limit_mm") * kMetresPerMm, first || line.flag_or("within", false), false};
}

RecordedTips tips_of(const JsonNode& line) {
  const double apart_m = line.number("apart_mm") * kMetresPerMm;
  return {apart_m, line.number("limit_mm") * kMetresPerMm,
          optional_number(line, "by_mm", kMetresPerMm).value_or(apart_m),
          line.flag_or("corrected", false)};
}

RecordedAxis axis_of(const JsonNode& line) {
  return {line.number("off_deg") * kRadiansPerDegree, line.number("sd_deg") * kRadiansPerDegree,
          line.number("by_deg") * kRadiansPerDegree, line.flag_or("corrected", false)};
}

/// Goes through a journal line by line.
class Reading {
 public:
  explicit Reading(std::string name) : name_(std::move(name)) {}

  Status take(std::string_view text) {
    const std::string where = name_ + ":" + std::to_string(++record_.lines);
    if (text.size() > kLongestLine) {
      return Error{where + ": " + std::to_string(text.size()) + " bytes long, limit " +
                   std::to_string(kLongestLine)};
    }
    const auto document = JsonDocument::parse(text, where);
    if (!document) {
      return document.error();
    }
    if (record_.lines == 1) {
      take_header(document->root());
    } else {
      take_line(document->root());
    }
    return document->status();
  }

  SessionRecord finish(bool torn) {
    record_.last_line_torn = torn;
    record_.cut = torn || !ended_;
    return std::move(record_);
  }

 private:
  void take_header(const JsonNode& line) {
    if (line.text("format") != "orthonav session") {
      return line.refuse("format", "is not \"orthonav session\"");
    }
    if (const int version = line.integer("format_version"); version != 1) {
      return line.refuse("format_version", "is " + std::to_string(version) + ", known is 1");
    }
    record_.orthonav = line.text("orthonav");
    record_.device = line.text("device");
    record_.method = line.text("method");
    record_.case_name = line.text("case");
    record_.seed = line.unsigned_integer("seed");
    if (line.has("patient_reference")) {
      record_.patient_reference = line.flag_or("patient_reference", false);
    }
    if (line.has("common_errors")) {
      record_.errors = errors_from(line.child("common_errors"));
    }
    if (!line.has("levels")) {
      return;
    }
    record_.has_plan = true;
    for (const JsonNode& level : line.list("levels")) {
      replay_.plan(level.text("label"), level.texts("screws"), level);
    }
  }

  /// Refuses what can't be a time; otherwise notes it as the newest.
  Timestamp time_of(const JsonNode& line) {
    const double ns = line.number("time_ns");
    if (!(std::abs(ns) <= kLatest_ns)) {
      line.refuse("time_ns", "is not a time of a session");
      return {};
    }
    const Timestamp time{Duration(static_cast<std::int64_t>(ns))};
    if (record_.end && *record_.end - time > kMostBack) {
      char text[80];
      std::snprintf(text, sizeof text, "goes back by %.1f s, limit 60 s",
                    seconds(*record_.end - time));
      line.refuse("time_ns", text);
    }
    record_.begin = std::min(time, record_.begin.value_or(time));
    record_.end = std::max(time, record_.end.value_or(time));
    return time;
  }

  void take_line(const JsonNode& line) {
    if (ended_) {
      return line.refuse("stands after the end of the session");
    }
    const Timestamp time = time_of(line);
    const std::string what = line.text("what");
    if (what == "event") {
      take_event(line, time);
    } else if (what == "registration") {
      replay_.registered(registration_of(line, time), line);
    } else if (what == "accepted") {
      replay_.accepted(line.text("level"),
                       {optional_number(line, "predicted_tre_mm", kMetresPerMm),
                        optional_number(line, "tre_95_mm", kMetresPerMm)},
                       line);
    } else if (what == "check point" || what == "check point dropped" || what == "landmark" ||
               what == "landmark dropped") {
      take_touch_line(what, line);
    } else if (what == "tips") {
      record_.tips = tips_of(line);
    } else if (what == "calibration") {
      record_.calibration = calibration_of(line);
    } else if (what == "axis") {
      record_.axis = axis_of(line);
    } else if (what == "screw" || what == "wire" || what == "screw redone") {
      take_screw_line(what, line, time);
    } else if (what == "replanned") {
      replay_.replanned(line.text("level"), side_from(line), planned_in_surgery(line), line);
    } else if (what == "head" || what == "head dropped") {
      replay_.head(side_from(line), what == "head", line);
    } else if (what.starts_with("rod")) {
      take_rod_line(what, line);
    } else if (what == "ended") {
      record_.reason = line.text_or("reason", "");
      ended_ = true;
    } else if (what != "not understood" && what != "asked from outside") {
      refuse_unknown(what, line);
    }
  }

  static void refuse_unknown(const std::string& what, const JsonNode& line) {
    line.refuse("what", "\"" + what.substr(0, 40) + "\" is unknown");
  }

  void take_rod_line(const std::string& what, const JsonNode& line) {
    if (what == "rod") {
      replay_.rod_done(recorded_rod_of(line));
    } else {
      refuse_unknown(what, line);
    }
  }

  void take_touch_line(const std::string& what, const JsonNode& line) {
    const std::string level = line.text("level");
    if (what == "check point") {
      replay_.checked(
          level, {line.number("distance_mm") * kMetresPerMm, line.flag_or("within", false)}, line);
    } else if (what == "check point dropped") {
      replay_.check_dropped(level, line);
    } else if (what == "landmark") {
      replay_.landmark(level, landmark_of(line), line);
    } else {
      replay_.landmark_dropped(level, line);
    }
  }

  void take_screw_line(const std::string& what, const JsonNode& line, Timestamp time) {
    const std::string level = line.text("level");
    if (what == "screw") {
      replay_.screw_done(level, screw_of(line, time), line);
    } else if (what == "wire") {
      replay_.wire_measured(level, side_from(line), wire_of(line), line);
    } else {
      replay_.screw_redone(level, side_from(line), line);
    }
  }

  void take_event(const JsonNode& line, Timestamp time) {
    (void)named<Step>(line, "step", kStepCount);
    const auto event = named<Event>(line, "event", kEventCount);
    const auto* const earlier = std::ranges::find(kEarlierActions, line.text("action"));
    const auto action = earlier != kEarlierActions.end()
                            ? Action::kIgnore
                            : named<Action>(line, "action", kActionCount);
    const auto next = named<Step>(line, "next", kStepCount);
    replay_.happened(time, event, {next, action});
  }

  std::string name_;
  SessionRecord record_;
  JournalReplay replay_{record_};
  bool ended_ = false;
};

}  // namespace

Result<SessionRecord> read_journal_text(const std::string& text, const std::string& name) {
  // After a loss of power a disk may hold zeros in place of the last lines.
  const std::size_t last = text.find_last_not_of('\0');
  const std::string_view content =
      std::string_view(text).substr(0, last == std::string::npos ? 0 : last + 1);
  if (content.empty()) {
    return Error{name + ": is empty"};
  }
  Reading reading(name);
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t end = std::min(content.find('\n', at), content.size());
    const std::string_view line = content.substr(at, end - at);
    // Only the last line may lack its end. If it is not a whole object, its writing was cut off.
    if (end == content.size() && at > 0 && !JsonDocument::parse(line, name)) {
      return reading.finish(true);
    }
    if (const Status taken = reading.take(line); !taken) {
      return taken.error();
    }
    at = end + 1;
  }
  return reading.finish(content.size() < text.size());
}

Result<SessionRecord> read_journal(const std::string& path) {
  const auto text = read_text(path);
  if (!text) {
    return text.error();
  }
  return read_journal_text(*text, path);
}

}  // namespace orthonav::engine
