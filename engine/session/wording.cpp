#include "engine/session/wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/angle.h"
#include "base/length_text.h"
#include "base/printed.h"
#include "engine/session/message_wording.h"
#include "engine/session/numbers_wording.h"
#include "engine/session/part_wording.h"
#include "engine/session/saved_wording.h"
#include "engine/session/wire_wording.h"

namespace orthonav::engine {
namespace {

constexpr std::string_view kBetweenParts = " | ";

std::string_view word_of(Step step) {
  constexpr std::array<std::string_view, kStepCount> kWords = {
      "setup", "digitize", "verify", "accepted", "guide", "placed", "rod", "done"};
  return kWords[static_cast<std::size_t>(step)];
}

/// What is to be touched, and the result of the last touch.
void write_checks(PartedText text, const ChecksSoFar& checks, std::string_view separator) {
  std::string& out = text.out;
  if (checks.last_m) {
    text.begin(Importance::kMessage, separator);
    append_printed(out, "check %zu: ", checks.count);
    append_mm(out, *checks.last_m, 1);
    separator = "; ";
  }
  text.begin(Importance::kNext, separator);
  if (checks.verdict->passed) {
    out += "passed, worst ";
    append_mm(out, checks.verdict->worst_m, 1);
  } else {
    append(out, checks.verdict->advice);
  }
}

/// How far the landmark has moved since the registration was accepted.
void write_moved(PartedText text, const ChecksSoFar& checks, std::string_view separator) {
  if (checks.moved_m) {
    text.begin(Importance::kDanger, separator);
    text.out += "moved ";
    append_mm(text.out, *checks.moved_m, 1);
  }
}

/// The guide's tip and the pointer's: what is to be done, or how far apart they were.
void write_tips(PartedText text, const TipCheck& tips, std::string_view separator) {
  std::string& out = text.out;
  if (tips.due()) {
    text.begin(Importance::kNext, separator);
    out += "put the guide's tip in it too, or say next";
    return;
  }
  if (!tips.last() || tips.last()->corrected) {
    return;
  }
  text.begin(tips.offers() ? Importance::kDanger : Importance::kMessage, separator);
  out += tips.offers() ? "guide's tip " : "tips agree, ";
  append_mm(out, tips.last()->apart_m.norm(), 1);
  out += tips.offers() ? " from the pointer's" : " apart";
  if (tips.offers()) {
    text.begin(Importance::kNext, ": ");
    out += "say accept to correct it";
  }
}

/// The error of the guide's axis according to the last wire, if it is worth correcting.
void write_axis(PartedText text, const LandmarkSoFar& landmark, std::string_view separator) {
  if (landmark.axis == nullptr || !landmark.axis->offers() || landmark.tips->offers()) {
    return;
  }
  text.begin(Importance::kDanger, separator);
  append_printed(text.out, "guide's axis %.1f° off", degrees(landmark.axis->last()->off_rad));
  text.begin(Importance::kNext, ": ");
  text.out += "say accept to correct it";
}

/// Whether the landmark is still to be touched, and the result of the last touch.
void write_landmark(PartedText text, const LandmarkSoFar& landmark, std::string_view separator) {
  std::string& out = text.out;
  if (!landmark.last) {
    text.begin(Importance::kNext, separator);
    out += landmark.recorded ? words::kTouchDimple : words::kMakeDimple;
    return;
  }
  if (landmark.last->missing > 0) {
    text.begin(Importance::kNext, separator);
    out += "lift the tip and touch the dimple again";
    return;
  }
  text.begin(Importance::kMessage, separator);
  if (landmark.last->first) {
    out += "dimple recorded";
  } else {
    out += "dimple found, ";
    append_mm(out, landmark.last->off_m, 1);
    out += " off";
  }
  if (landmark.tips != nullptr) {
    write_tips(text, *landmark.tips, "; ");
    write_axis(text, landmark, "; ");
  }
}

void write_unused_tool(PartedText text, const StatusLine& line, std::string_view separator) {
  if (!line.unused_tool.empty()) {
    text.begin(Importance::kNext, separator);
    text.out.append(line.unused_tool).append(" in view: not used in this step");
  }
}

/// Writes the state of each step.
struct StateWriter {
  PartedText text;
  std::string& out = text.out;

  void operator()(std::monostate /*none*/) {}
  void operator()(const StrokesSoFar& strokes) {
    text.begin(Importance::kCount);
    append_printed(out, "%zu points", strokes.points);
    if (strokes.coaching != nullptr) {
      write_coaching(text, *strokes.coaching, kBetweenParts);
    }
  }
  void operator()(const RegistrationFigures& figures) {
    text.begin(Importance::kFigures);
    out += "RMSE ";
    append_mm(out, figures.rmse_m, 2);
    text.begin(Importance::kFigures, ", ");
    out += kExpectedError;
    append_mm(out, figures.expected_m, 1);
    out += figures.of_one_screw ? "" : " at the screws";
    out += figures.registration_only ? kRegistrationOnly : "";
    if (figures.replanned) {
      text.begin(Importance::kMessage, "; ");
      out += "planned in surgery";
    }
  }
  void operator()(const ChecksSoFar& checks) {
    text.begin(Importance::kFigures);
    out += kExpectedError;
    append_mm(out, checks.expected_m, 1);
    out += checks.registration_only ? kRegistrationOnly : "";
    write_moved(text, checks, "; ");
    write_checks(text, checks, "; ");
  }
  void operator()(const LandmarkSoFar& landmark) {
    (*this)(landmark.figures);
    write_landmark(text, landmark, "; ");
  }
  void operator()(const WireSoFar& wire) { write_wire(text, wire, ""); }
  void operator()(const HeadsSoFar& heads) {
    text.begin(Importance::kCount);
    append_printed(out, "%zu heads", heads.count);
    if (heads.cut_length_m) {
      text.begin(Importance::kFigures, ", ");
      out += "cut to ";
      append_mm(out, *heads.cut_length_m, 1);
      append_printed(out, heads.bends == 1 ? ", %zu bend" : ", %zu bends", heads.bends);
    }
  }
};

}  // namespace

void append_step(std::string& out, const StepOnDisplay& at) {
  out += word_of(at.step);
  if (!at.level.empty()) {
    out.append(" ").append(at.level);
  }
  if (at.side) {
    out.append(" ").append(word_of(*at.side));
  }
}

/// Keeps the step's request visible beside the outcome of a change of the screw.
void write_beside_replan(PartedText text, const StepState& state) {
  if (const auto* landmark = std::get_if<LandmarkSoFar>(&state)) {
    write_landmark(text, *landmark, "; ");
  } else if (const auto* wire = std::get_if<WireSoFar>(&state)) {
    write_wire(text, *wire, "; ");
  }
}

void append_detail(std::string& out, const StatusLine& line, StatusParts* parts) {
  PartedText text{out, parts};
  const std::size_t begin = out.size();
  if (line.stalled) {
    text.begin(Importance::kDanger);
    out += stalled_text(*line.stalled);
  } else if (line.tool_lost) {
    text.begin(Importance::kDanger);
    out.append(line.tool).append(" lost");
  } else if (line.tag_size_off) {
    text.begin(Importance::kDanger);
    append_tag_size_off(out, line.tool, *line.tag_size_off);
  }
  const bool taken = out.size() > begin;
  if (line.stop_past_target_m) {
    text.begin(Importance::kDanger, taken ? "; " : "");
    append_stop_too_deep(out, *line.stop_past_target_m);
  }
  const bool told = out.size() > begin;
  if (line.message) {
    out += told ? "; " : "";
    write_message(text, *line.message);
    if (is_about_replan(*line.message)) {
      write_beside_replan(text, line.state);
    }
  } else if (!taken) {
    out += told && !std::holds_alternative<std::monostate>(line.state) ? "; " : "";
    std::visit(StateWriter{text}, line.state);
  } else if (const auto* checks = std::get_if<ChecksSoFar>(&line.state)) {
    // The places to touch are still counted beside a lasting warning.
    write_moved(text, *checks, "; ");
    write_checks(text, *checks, "; ");
  } else if (const auto* landmark = std::get_if<LandmarkSoFar>(&line.state)) {
    write_landmark(text, *landmark, "; ");
  } else if (const auto* wire = std::get_if<WireSoFar>(&line.state)) {
    write_wire(text, *wire, "; ");
  }
  write_unused_tool(text, line, out.size() > begin ? "; " : "");
  write_saved(text, line.saved, out.size() > begin ? "; " : "");
}

void append_heard(std::string& out, const HeardCommand& heard) {
  out.append(heard.from).append(heard.from.empty() ? "heard: " : " asks: ");
  out.append(heard.phrase).append(heard.sure ? "" : "? not sure");
}

void append_beside_step(std::string& out, const StatusLine& line, StatusParts* parts) {
  const std::size_t begin = out.size();
  append_detail(out, line, parts);
  if (line.heard) {
    PartedText{out, parts}.begin(Importance::kHeard, out.size() > begin ? kBetweenParts : "");
    append_heard(out, *line.heard);
  }
}

void append_screw(std::string& out, std::string_view level, Side side) {
  out.append(level).append(" ").append(word_of(side));
}

void append_without_heard(std::string& out, const StatusLine& line) {
  append_step(out, line.at);
  const std::size_t end_of_step = out.size();
  out += kBetweenParts;
  append_detail(out, line);
  if (out.size() == end_of_step + kBetweenParts.size()) {
    out.resize(end_of_step);
  }
}

void append_status(std::string& out, const StatusLine& line) {
  append_without_heard(out, line);
  if (line.heard) {
    out += kBetweenParts;
    append_heard(out, *line.heard);
  }
}

void append_tag_size_off(std::string& out, std::string_view tool, double fraction) {
  out += tool;
  append_printed(out, ": tag %.1f %% %s than stated, check print and unit",
                 100.0 * std::abs(fraction), fraction > 0.0 ? "larger" : "smaller");
}

std::string step_text(const StepOnDisplay& at) {
  std::string out;
  append_step(out, at);
  return out;
}

std::string detail_text(const StatusLine& line) {
  std::string out;
  append_detail(out, line);
  return out;
}

std::string refusal_text(const RegistrationOutcome& outcome) {
  if (outcome.passed()) {
    return {};
  }
  if (outcome.error) {
    return outcome.error->message;
  }
  return text_of(std::span<const nav::RefusalReason>(outcome.result->reasons));
}

}  // namespace orthonav::engine
