#include "engine/session/wording.h"

#include <array>
#include <cmath>
#include <span>

#include "engine/session/printed.h"

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
      append_printed(out, "tip moved %.1f mm, limit %.1f mm", why.value_m * 1e3, why.limit_m * 1e3);
      break;
    case TouchRefusal::Kind::kHeldTooLong:
      out += "hold too long";
      break;
    case TouchRefusal::Kind::kTooMany:
      append_printed(out, "there are %zu already", nav::kMostCheckPoints);
      break;
  }
}

/// Appends each kind of message.
struct MessageWriter {
  std::string& out;

  void operator()(std::monostate /*none*/) const {}
  void operator()(const NotPossibleNow& m) const {
    out.append("not possible now: ").append(name_of(m.event));
  }
  void operator()(const NotUnderstood& /*m*/) const { out += "not understood"; }
  void operator()(const SaidBeforeShown& /*m*/) const {
    out += "not accepted: said before the hologram was shown";
  }
  void operator()(const NothingToDelete& m) const {
    constexpr std::array<std::string_view, 3> kTexts = {
        "nothing to delete", "no check point to delete", "no head to delete"};
    out += kTexts[static_cast<std::size_t>(m.what)];
  }
  void operator()(const ConfirmDelete& m) const {
    append_printed(out, "say delete again to drop the last saved %zu points", m.points);
  }
  void operator()(const RegistrationRefused& m) const {
    out += "refused: ";
    if (m.error) {
      out += m.error->message;
    } else {
      append(out, std::span<const nav::RefusalReason>(m.reasons));
    }
    if (m.another_level_fits) {
      out += "; make sure of the level";
    } else if (m.stroke_next) {
      out += "; ";
      append(out, *m.stroke_next);
    }
  }
  void operator()(const ChecksMissing& m) const {
    out += "not accepted: ";
    append(out, m.advice);
  }
  void operator()(const TouchNotRecorded& m) const {
    const bool head = m.what == TouchNotRecorded::What::kHead;
    out += head ? "head not recorded: " : "check point not recorded: ";
    append_refusal(out, m.why);
  }
  void operator()(const NoRod& m) const { out.append("no rod: ").append(m.why.message); }
  void operator()(const MapMoved& m) const {
    out += "the headset's map moved";
    if (m.step == Step::kDigitize) {
      out += ": digitize again";
    } else if (m.step == Step::kRod) {
      out += ": touch this rod's heads again";
    }
  }
  void operator()(const NoImages& /*m*/) const { out += "no camera images"; }
  void operator()(const Ended& /*m*/) const { out += "ended"; }
};

/// What is to be touched, and how the last touch was.
void append_checks(std::string& out, const ChecksSoFar& checks) {
  if (checks.last_m) {
    append_printed(out, "check point %zu: ", checks.count);
    append_mm(out, *checks.last_m, 1);
    out += " off; ";
  }
  if (checks.verdict->passed) {
    out += "checked, worst ";
    append_mm(out, checks.verdict->worst_m, 1);
  } else {
    append(out, checks.verdict->advice);
  }
}

/// Appends how each step stands.
struct StateWriter {
  std::string& out;

  void operator()(std::monostate /*none*/) const {}
  void operator()(const StrokesSoFar& strokes) const {
    append_printed(out, "%zu points", strokes.points);
    if (strokes.coaching) {
      out += " | ";
      append(out, *strokes.coaching);
    }
  }
  void operator()(const RegistrationFigures& figures) const {
    out += "RMSE ";
    append_mm(out, figures.rmse_m, 2);
    out += ", ";
    append_mm(out, figures.expected_m, 1);
    out += figures.of_one_screw ? " expected" : " expected at the screws";
  }
  void operator()(const ChecksSoFar& checks) const {
    append_mm(out, checks.expected_m, 1);
    out += " expected; ";
    append_checks(out, checks);
  }
  void operator()(const HeadsSoFar& heads) const { append_printed(out, "%zu heads", heads.count); }
};

}  // namespace

void append(std::string& out, const Coaching& coaching) {
  if (!coaching.unique) {
    // An error about a pose that may be the wrong one says nothing.
    out += "could be more than one pose";
  } else {
    append_mm(out, coaching.expected_m, 1);
    out += " expected";
  }
  if (coaching.enough) {
    out += ", enough to register";
  } else if (coaching.against) {
    out += ", ";
    append(out, *coaching.against);
  } else if (coaching.stroke_next) {
    out += ", ";
    append(out, *coaching.stroke_next);
  }
}

void append(std::string& out, const Message& message) { std::visit(MessageWriter{out}, message); }

void append_step(std::string& out, const StepOnDisplay& at) {
  out += word_of(at.step);
  if (!at.level.empty()) {
    out.append(" ").append(at.level);
  }
  if (at.side) {
    out.append(" ").append(word_of(*at.side));
  }
}

void append_detail(std::string& out, const StatusLine& line) {
  const std::size_t begin = out.size();
  if (line.tool_lost) {
    out.append(line.tool).append(" lost");
  } else if (line.tag_size_off) {
    append_tag_size_off(out, line.tool, *line.tag_size_off);
  }
  const bool taken = out.size() > begin;
  if (line.message) {
    out += taken ? "; " : "";
    append(out, *line.message);
  } else if (!taken) {
    std::visit(StateWriter{out}, line.state);
  } else if (const auto* checks = std::get_if<ChecksSoFar>(&line.state)) {
    // What is to be touched counts on beside a warning that stays.
    out += "; ";
    append_checks(out, *checks);
  }
}

void append_heard(std::string& out, const HeardCommand& heard) {
  out.append("heard: ").append(heard.phrase).append(heard.sure ? "" : "? not sure");
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
