#include "engine/session/journal_reader.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "base/angle.h"
#include "base/units.h"
#include "engine/io/json_document.h"
#include "engine/session/journal_replay.h"
#include "engine/session/journal_rod_reading.h"
#include "engine/session/journal_screw_reading.h"
#include "engine/session/recorded_replan.h"

namespace orthonav::engine {
namespace {

constexpr std::size_t kLongestLine = 1U << 20U;
/// Clicks and phrases delayed by a network arrive some seconds after later images.
constexpr auto kMostBack = std::chrono::minutes(1);
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
      replay_.replanned(line.text("level"), side_of(line), planned_in_surgery(line), line);
    } else if (what == "head" || what == "head dropped") {
      replay_.head(side_of(line), what == "head", line);
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
      replay_.wire_measured(level, side_of(line), wire_of(line), line);
    } else {
      replay_.screw_redone(level, side_of(line), line);
    }
  }

  void take_event(const JsonNode& line, Timestamp time) {
    (void)named<Step>(line, "step", kStepCount);
    const auto event = named<Event>(line, "event", kEventCount);
    const auto action = named<Action>(line, "action", kActionCount);
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
