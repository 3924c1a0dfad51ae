#include "hal/replay/event_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hal/replay/layout.h"
#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

constexpr std::uintmax_t kMaxEventsBytes = std::uintmax_t{64} << 20U;
constexpr std::uintmax_t kMaxHeadBytes = std::uintmax_t{1} << 31U;

constexpr std::array<std::pair<ClickerAction, std::string_view>, 5> kActions = {
    {{ClickerAction::kPress, "press"},
     {ClickerAction::kRelease, "release"},
     {ClickerAction::kClick, "click"},
     {ClickerAction::kDoubleClick, "double click"},
     {ClickerAction::kHold, "hold"}}};

constexpr std::array<std::pair<PoseStatus, std::string_view>, 3> kOrigins = {
    {{PoseStatus::kMeasured, "measured"},
     {PoseStatus::kPredicted, "predicted"},
     {PoseStatus::kLost, "lost"}}};

template <class Value, std::size_t N>
std::string_view name_in(const std::array<std::pair<Value, std::string_view>, N>& table,
                         Value value) {
  for (const auto& [candidate, name] : table) {
    if (candidate == value) {
      return name;
    }
  }
  return "";
}

template <class Value, std::size_t N>
std::optional<Value> value_in(const std::array<std::pair<Value, std::string_view>, N>& table,
                              std::string_view name) {
  for (const auto& [value, candidate] : table) {
    if (candidate == name) {
      return value;
    }
  }
  return std::nullopt;
}

/// Escapes the text, so that every event is one line.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\\\";
    } else if (c == '\n' || c == '\r') {
      out += c == '\n' ? "\\n" : "\\r";
    } else {
      out += c;
    }
  }
  return out;
}

std::string unescaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    const char c = text[++i];
    out += c == 'n' ? '\n' : (c == 'r' ? '\r' : c);
  }
  return out;
}

std::optional<Timestamp> parse_time(std::string_view field) {
  const auto ns = parse_integer(field);
  return ns ? std::optional<Timestamp>(Timestamp(Duration(*ns))) : std::nullopt;
}

void append_times(std::string& line, Timestamp time, Timestamp available) {
  append_number(line, std::int64_t{time.time_since_epoch().count()});
  line += ',';
  append_number(line, std::int64_t{available.time_since_epoch().count()});
  line += ',';
}

/// Delivery keeps the order, in time and in availability.
template <class Event>
Status add_in_order(std::vector<Delivered<Event>>& events, Delivered<Event> event) {
  if (event.available < event.event.time) {
    return Error{"available_ns lies before time_ns"};
  }
  if (!events.empty() &&
      (event.event.time < events.back().event.time || event.available < events.back().available)) {
    return Error{"comes before the event above it"};
  }
  events.push_back(std::move(event));
  return {};
}

Status take_event(std::string_view line, std::vector<std::string_view>& fields,
                  RecordedEvents& events) {
  split(line, fields);
  if (fields.size() < 6) {
    return Error{"holds " + std::to_string(fields.size()) + " fields, must be 6"};
  }
  const auto time = parse_time(fields[3]);
  const auto available = parse_time(fields[4]);
  if (!time || !available) {
    return Error{"time_ns or available_ns is not a whole number"};
  }
  for (const Timestamp t : {*time, *available}) {
    if (t < Timestamp(Duration(-kMaxNs)) || t > Timestamp(Duration(kMaxNs))) {
      return Error{"time_ns and available_ns must lie within 9e18"};
    }
  }
  if (fields[0] == "clicker") {
    const auto action = value_in(kActions, fields[1]);
    if (!action) {
      return Error{"what is unknown; known are press, release, click, double click and hold"};
    }
    return add_in_order(events.clicker, {{*action, *time}, *available});
  }
  if (fields[0] != "voice") {
    return Error{"device is unknown; known are clicker and voice"};
  }
  const auto confidence = parse_double(fields[2]);
  if (!confidence || !(*confidence >= 0.0 && *confidence <= 1.0)) {
    return Error{"confidence must lie in [0, 1]"};
  }
  // The text comes last and may hold commas.
  const std::string_view text =
      line.substr(static_cast<std::size_t>(fields[5].data() - line.data()));
  if (text.empty()) {
    return Error{"text is empty"};
  }
  return add_in_order(events.voice, {{unescaped(text), *confidence, *time}, *available});
}

Status take_head_answer(std::string_view line, std::vector<std::string_view>& fields,
                        HeadAnswers& answers) {
  split(line, fields);
  if (fields.size() != 19 && fields.size() != 19 + 36) {
    return Error{"holds " + std::to_string(fields.size()) + " fields, must be 19 or 55"};
  }
  const auto sequence = parse_integer(fields[0]);
  const auto at = parse_time(fields[1]);
  const auto origin = value_in(kOrigins, fields[2]);
  if (!sequence || !at) {
    return Error{"sequence or at_ns is not a whole number"};
  }
  if (!origin) {
    return Error{"origin is unknown; known are measured, predicted and lost"};
  }
  const auto pose = parse_pose<World, Rig>(fields, 3, kMaxWorldM);
  if (!pose) {
    return pose.error();
  }
  Tracked<Transform<World, Rig>> answer{*pose, *at, *origin, {}};
  for (std::size_t i = 19; i < fields.size(); ++i) {
    const auto entry = parse_double(fields[i]);
    if (!entry || !std::isfinite(*entry)) {
      return Error{"covariance must be finite numbers"};
    }
    answer.covariance[i - 19] = *entry;
  }
  answers.add(*sequence, answer);
  return {};
}

}  // namespace

Result<RecordedEvents> read_events(const std::filesystem::path& path) {
  RecordedEvents events;
  std::vector<std::string_view> fields;
  Status status =
      for_each_grown_row(path, kMaxEventsBytes, kEventsHeader,
                         [&](std::string_view line) { return take_event(line, fields, events); });
  if (!status) {
    return status.error();
  }
  return events;
}

void append_event(std::string& line, const Delivered<ClickerEvent>& event) {
  line += "clicker,";
  line += name_in(kActions, event.event.action);
  line += ",,";
  append_times(line, event.event.time, event.available);
}

void append_event(std::string& line, const Delivered<Phrase>& event) {
  line += "voice,phrase,";
  append_number(line, event.event.confidence);
  line += ',';
  append_times(line, event.event.time, event.available);
  line += escaped(event.event.text);
}

Result<HeadAnswers> read_head_answers(const std::filesystem::path& path) {
  HeadAnswers answers;
  std::vector<std::string_view> fields;
  Status status = for_each_grown_row(path, kMaxHeadBytes, kHeadHeader, [&](std::string_view line) {
    return take_head_answer(line, fields, answers);
  });
  if (!status) {
    return status.error();
  }
  return answers;
}

void append_head_answer(std::string& line, std::int64_t sequence,
                        const Tracked<Transform<World, Rig>>& answer) {
  append_number(line, sequence);
  line += ',';
  append_number(line, std::int64_t{answer.time.time_since_epoch().count()});
  line += ',';
  line += name_in(kOrigins, answer.status);
  // A lost pose has no value; its memory must not be read.
  const Transform<World, Rig> pose =
      answer.status == PoseStatus::kLost ? Transform<World, Rig>{} : answer.value;
  for (const double entry : pose.row_major()) {
    line += ',';
    append_number(line, entry);
  }
  if (answer.status == PoseStatus::kLost || answer.covariance == PoseCovariance{}) {
    return;
  }
  for (const double entry : answer.covariance) {
    line += ',';
    append_number(line, entry);
  }
}

}  // namespace orthonav::replay
