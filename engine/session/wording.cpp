#include "engine/session/wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/angle.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/landmark_wording.h"
#include "engine/session/message_wording.h"
#include "engine/session/numbers_wording.h"
#include "engine/session/part_wording.h"
#include "engine/session/said.h"
#include "engine/session/saved_wording.h"
#include "engine/session/wire_wording.h"

namespace orthonav::engine {
namespace {

constexpr std::string_view kBetweenParts = " | ";

std::string_view word_of(Step step) {
  constexpr std::array<const char*, kStepCount> kWords = {
      translatable("setup"),  translatable("digitize"), translatable("registering"),
      translatable("verify"), translatable("accepted"), translatable("guide"),
      translatable("placed"), translatable("rod"),      translatable("done")};
  static_assert(kWords.back() != nullptr, "every step has its word");
  return translated(kWords[static_cast<std::size_t>(step)]);
}

/// What is to be touched.
void write_checks(PartedText text, const ChecksSoFar& checks, std::string_view separator) {
  text.begin(Importance::kNext, separator);
  if (checks.verdict->passed) {
    text.out += translated("passed: say accept result");
  } else {
    append(text.out, checks.verdict->advice);
  }
}

/// How far the landmark has moved since the registration was accepted.
void write_moved(PartedText text, const ChecksSoFar& checks, std::string_view separator) {
  if (checks.moved_m) {
    text.begin(Importance::kDanger, separator);
    append_printed(text.out, translated("moved %s"), said_mm(*checks.moved_m).c_str());
  }
}

void write_unused_tool(PartedText text, const StatusLine& line, std::string_view separator) {
  if (!line.unused_tool.empty()) {
    text.begin(Importance::kNext, separator);
    append_with(text.out, translated("%s in view: not used in this step"), line.unused_tool);
  }
}

/// What to do next in each step: an act, no figures.
struct StateWriter {
  PartedText text;
  Step step;
  std::string& out = text.out;

  void next(const char* act) {
    text.begin(Importance::kNext);
    out += translated(act);
  }
  void operator()(std::monostate /*none*/) {
    if (step == Step::kSetup) {
      next(translatable("say begin guiding"));
    } else if (step == Step::kRegistering) {
      next(translatable("wait"));
    }
  }
  void operator()(const StrokesSoFar& strokes) {
    if (strokes.coaching != nullptr) {
      write_coaching(text, *strokes.coaching, "");
    } else {
      next(translatable("stroke the bone"));
    }
  }
  void operator()(ByEye /*state*/) {
    next(step == Step::kVerify ? translatable("say accept result or reject level")
                               : translatable("say go to next"));
  }
  void operator()(const ChecksSoFar& checks) {
    write_moved(text, checks, "");
    write_checks(text, checks, checks.moved_m ? "; " : "");
  }
  void operator()(const LandmarkSoFar& landmark) { write_landmark(text, landmark, ""); }
  void operator()(const WireSoFar& wire) { write_wire(text, wire, ""); }
  void operator()(const HeadsSoFar& heads) {
    if (heads.touch_again) {
      text.begin(Importance::kNext);
      append_printed(out, translated("touch head %zu again"), *heads.touch_again + 1);
    } else if (heads.cut_length_m) {
      next(translatable("bend it, then say finish rod"));
    } else if (heads.count > 0) {
      next(translatable("touch the next head"));
    } else {
      next(heads.unplanned ? translatable("touch the first head; none: say finish rod")
                           : translatable("touch the first head"));
    }
    if (heads.seat_by_pointer_m) {
      const double seat_m = *heads.seat_by_pointer_m;
      text.begin(Importance::kFigures, "; ");
      append_printed(out,
                     seat_m < 0.0 ? translated("rod %s above the touches")
                                  : translated("rod %s below the touches"),
                     said_mm(std::abs(seat_m)).c_str());
    }
  }
};

bool is_correction(const Message& message) {
  return std::holds_alternative<TipCorrected>(message) ||
         std::holds_alternative<AxisCorrected>(message);
}

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
  } else if (line.pictures_apart) {
    text.begin(Importance::kDanger);
    out += translated("the two cameras' pictures do not belong together");
  } else if (line.tool_lost) {
    text.begin(Importance::kDanger);
    append_with(out, translated("%s lost"), line.tool);
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
    } else if (is_correction(*line.message)) {
      if (const auto* landmark = std::get_if<LandmarkSoFar>(&line.state)) {
        write_beside_correction(text, *landmark);
      }
    }
  } else if (!taken) {
    out += told && !std::holds_alternative<std::monostate>(line.state) ? "; " : "";
    std::visit(StateWriter{text, line.at.step}, line.state);
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
  if (line.no_clicker) {
    text.begin(Importance::kNext, out.size() > begin ? "; " : "");
    out += translated("no clicker");
  }
  write_saved(text, line.saved, out.size() > begin ? "; " : "");
}

void append_heard(std::string& out, const HeardCommand& heard) {
  if (heard.from.empty()) {
    append_with(out, translated("heard: %s"), heard.phrase);
  } else {
    append_printed(out, translated("%s asks: %s"), heard.from.c_str(), heard.phrase.c_str());
  }
  if (!heard.sure) {
    out.append("? ").append(translated("not sure"));
  }
}

void append_beside_step(std::string& out, const StatusLine& line, StatusParts* parts) {
  const std::size_t begin = out.size();
  append_detail(out, line, parts);
  const bool answered = line.heard && line.heard->sure && line.saved == Saved::kSaved;
  if (line.heard && !answered) {
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
  out.append(tool).append(": ");
  append_printed(out,
                 fraction > 0.0
                     ? translated("tag %.1f %% larger than stated, check print and unit")
                     : translated("tag %.1f %% smaller than stated, check print and unit"),
                 100.0 * std::abs(fraction));
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
