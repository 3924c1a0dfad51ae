#include "engine/session/wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/length_text.h"
#include "base/printed.h"

namespace orthonav::engine {
namespace {

constexpr std::string_view kBetweenParts = " | ";

std::string_view word_of(Step step) {
  constexpr std::array<std::string_view, kStepCount> kWords = {
      "setup", "digitize", "verify", "accepted", "guide", "rod", "done"};
  return kWords[static_cast<std::size_t>(step)];
}

void append_refusal(std::string& out, const TouchRefusal& why) {
  switch (why.kind) {
    case TouchRefusal::Kind::kPressAgain:
      out += "press again";
      break;
    case TouchRefusal::Kind::kPointerNotSeen:
      out += "pointer not seen";
      break;
    case TouchRefusal::Kind::kTipMoved:
      append_beside_limit(out, "tip moved %.1f mm, limit %.1f mm", why.value_m * 1e3,
                          why.limit_m * 1e3);
      break;
    case TouchRefusal::Kind::kHeldTooLong:
      out += "hold too long";
      break;
    case TouchRefusal::Kind::kTooMany:
      append_printed(out, "there are %zu already", nav::kMostCheckPoints);
      break;
  }
}

/// The words of each kind of message; as parts where they are more than one.
struct MessageWriter {
  PartedText text;
  std::string& out = text.out;

  void operator()(std::monostate /*none*/) {}
  void operator()(const NotPossibleNow& m) {
    text.begin(Importance::kMessage);
    out.append("not possible now: ").append(name_of(m.event));
  }
  void operator()(const NotUnderstood& /*m*/) {
    text.begin(Importance::kMessage);
    out += "not understood";
  }
  void operator()(const SaidBeforeShown& /*m*/) {
    text.begin(Importance::kMessage);
    out += "not accepted: said before the hologram was shown";
  }
  void operator()(const NothingToDelete& m) {
    text.begin(Importance::kMessage);
    constexpr std::array<std::string_view, 3> kTexts = {
        "nothing to delete", "no check point to delete", "no head to delete"};
    out += kTexts[static_cast<std::size_t>(m.what)];
  }
  void operator()(const ConfirmDelete& m) {
    text.begin(Importance::kNext);
    append_printed(out, "say delete again to drop the last saved %zu points", m.points);
  }
  void operator()(const RegistrationRefused& m) {
    text.begin(Importance::kMessage);
    out += "refused: ";
    const std::span<const nav::RefusalReason> reasons = m.reasons;
    if (m.error) {
      out += m.error->message;
    } else {
      append(out, reasons.first(std::min<std::size_t>(1, reasons.size())));
    }
    for (std::size_t i = 1; !m.error && i < reasons.size(); ++i) {
      text.begin(Importance::kMore, "; ");
      append(out, reasons[i]);
    }
    if (m.another_level_fits) {
      text.begin(Importance::kNext, "; ");
      out += "make sure of the level";
    } else if (m.stroke_next) {
      text.begin(Importance::kNext, "; ");
      append(out, *m.stroke_next);
    }
  }
  void operator()(const ChecksMissing& m) {
    text.begin(Importance::kNext);
    out += "not accepted: ";
    append(out, m.advice);
  }
  void operator()(const TouchNotRecorded& m) {
    text.begin(Importance::kMessage);
    const bool head = m.what == TouchNotRecorded::What::kHead;
    out += head ? "head not recorded: " : "check point not recorded: ";
    append_refusal(out, m.why);
  }
  void operator()(const NoRod& m) {
    text.begin(Importance::kMessage);
    out.append("no rod: ").append(m.why.message);
  }
  void operator()(const MapMoved& m) {
    text.begin(Importance::kDanger);
    out += "the headset's map moved";
    ask_again(m.step);
  }
  void operator()(const ReferenceMoved& m) {
    text.begin(Importance::kDanger);
    out += "a patient reference moved";
    ask_again(m.step);
  }
  void ask_again(Step step) {
    if (step == Step::kDigitize) {
      text.begin(Importance::kNext, ": ");
      out += "digitize again";
    } else if (step == Step::kRod) {
      text.begin(Importance::kNext, ": ");
      out += "touch this rod's heads again";
    }
  }
  void operator()(const NoImages& /*m*/) {
    text.begin(Importance::kDanger);
    out += "no camera images";
  }
  void operator()(const Ended& /*m*/) {
    text.begin(Importance::kDanger);
    out += "ended";
  }
};

/// What is to be touched, and how the last touch was.
void write_checks(PartedText text, const ChecksSoFar& checks, std::string_view separator) {
  std::string& out = text.out;
  if (checks.last_m) {
    text.begin(Importance::kMessage, separator);
    append_printed(out, "check point %zu: ", checks.count);
    append_mm(out, *checks.last_m, 1);
    out += " off";
    separator = "; ";
  }
  text.begin(Importance::kNext, separator);
  if (checks.verdict->passed) {
    out += "checked, worst ";
    append_mm(out, checks.verdict->worst_m, 1);
  } else {
    append(out, checks.verdict->advice);
  }
}

/// How each step stands.
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
    append_mm(out, figures.expected_m, 1);
    out += figures.of_one_screw ? " expected" : " expected at the screws";
    out += figures.registration_only ? kRegistrationOnly : "";
  }
  void operator()(const ChecksSoFar& checks) {
    text.begin(Importance::kFigures);
    append_mm(out, checks.expected_m, 1);
    out += " expected";
    out += checks.registration_only ? kRegistrationOnly : "";
    write_checks(text, checks, "; ");
  }
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

void write_message(PartedText text, const Message& message) {
  std::visit(MessageWriter{text}, message);
}

}  // namespace

void append(std::string& out, const Message& message) { write_message(PartedText{out}, message); }

void append_step(std::string& out, const StepOnDisplay& at) {
  out += word_of(at.step);
  if (!at.level.empty()) {
    out.append(" ").append(at.level);
  }
  if (at.side) {
    out.append(" ").append(word_of(*at.side));
  }
}

void append_detail(std::string& out, const StatusLine& line, StatusParts* parts) {
  PartedText text{out, parts};
  const std::size_t begin = out.size();
  if (line.tool_lost) {
    text.begin(Importance::kDanger);
    out.append(line.tool).append(" lost");
  } else if (line.tag_size_off) {
    text.begin(Importance::kDanger);
    append_tag_size_off(out, line.tool, *line.tag_size_off);
  }
  const bool taken = out.size() > begin;
  if (line.message) {
    out += taken ? "; " : "";
    write_message(text, *line.message);
  } else if (!taken) {
    std::visit(StateWriter{text}, line.state);
  } else if (const auto* checks = std::get_if<ChecksSoFar>(&line.state)) {
    // What is to be touched counts on beside a warning that stays.
    write_checks(text, *checks, "; ");
  }
}

void append_heard(std::string& out, const HeardCommand& heard) {
  out.append("heard: ").append(heard.phrase).append(heard.sure ? "" : "? not sure");
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
