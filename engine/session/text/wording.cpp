#include "engine/session/text/wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "base/angle.h"
#include "base/printed.h"
#include "base/reason.h"
#include "base/translation.h"
#include "engine/session/steps/digitizing.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/steps/landmarking.h"
#include "engine/session/steps/placing.h"
#include "engine/session/steps/replanning.h"
#include "engine/session/steps/rod_templating.h"
#include "engine/session/steps/verifying.h"
#include "engine/session/work_watch.h"
#include "engine/session/workflow/commands.h"

namespace orthonav::engine {

namespace {

constexpr const char* k99Percent =
    translatable("99 %% of errors at the screws are below %.1f mm, limit %.1f mm");
constexpr const char* kThroughBone = translatable(
    "the pointer would have gone through bone at %.0f %% of the points, limit %.0f %%");

/// The words for a number and its limit, and the unit in which it is shown.
struct LimitWords {
  const char* format;
  double unit;
};

LimitWords words_about(nav::RefusalReason::Kind kind) {
  using enum nav::RefusalReason::Kind;
  switch (kind) {
    case kNoise:
      return {translatable("the points scatter %.1f mm about the surface, limit %.1f mm"), 1e3};
    case kInliers:
      return {translatable("only %.0f %% of the points lie on the model, at least %.0f %%"), 100.0};
    case kShaftCollision:
      return {kThroughBone, 100.0};
    case kLogLikelihoodRatio:
      return {translatable("another pose fits nearly as well (margin %.1f, at least %.1f)"), 1.0};
    case kTre99AtScrews:
      return {k99Percent, 1e3};
    case kTre99AtEnds:
      return {translatable("99 %% of errors at the ends of the bone are below %.1f mm, limit %.1f "
                           "mm"),
              1e3};
    case kSoftTissue:
      return {translatable(
                  "soft tissue? The tip's height over the bone varies by %.1f mm, limit %.1f mm"),
              1e3};
    case kModelSize:
      return {translatable("the points fit a bone of %.3f times the model's size"), 1.0};
    case kMirrored:
      return {translatable(
                  "the points fit the mirror image of this model better (by %.1f, limit %.1f)"),
              1.0};
    case kFitsOtherLevel:
      break;
  }
  return {"", 1.0};
}

}  // namespace

std::string_view word_of(Side side) {
  return side == Side::kLeft ? translated("left") : translated("right");
}

void append_registration_only(std::string& out) {
  out.append(" ").append(translated("(registration only)"));
}

namespace {

/// "left upper lamina", in the place of the format's `%s`.
void append_part(std::string& out, const char* format, const nav::BonePlace& place) {
  using Part = nav::BonePlace::Part;
  using Height = nav::BonePlace::Height;
  constexpr std::array<const char*, 3> kParts = {translatable("spinous process"),
                                                 translatable("lamina"), translatable("facet")};
  static_assert(static_cast<int>(Part::kFacet) == 2);
  const std::size_t begin = out.size();
  out += translated(kParts[static_cast<std::size_t>(place.part)]);
  if (place.height != Height::kMiddle) {
    enclose(out, begin,
            place.height == Height::kUpper ? translated("upper %s") : translated("lower %s"));
  }
  if (place.side) {
    enclose(out, begin,
            *place.side == Side::kLeft ? translated("left %s") : translated("right %s"));
  }
  enclose(out, begin, format);
}

}  // namespace

void append(std::string& out, const nav::BonePlace& place) {
  append_part(out, translated("digitize the %s"), place);
}

void append(std::string& out, const nav::UncertainMotion& motion) {
  using Kind = nav::UncertainMotion::Kind;
  constexpr std::array<const char*, 6> kMotions = {
      translatable("medial-lateral shift"), translatable("anterior-posterior shift"),
      translatable("cranial-caudal shift"), translatable("flexion/extension"),
      translatable("lateral bending"),      translatable("axial rotation")};
  static_assert(static_cast<std::size_t>(Kind::kAxialRotation) + 1 == kMotions.size());
  out.append(translated(kMotions[static_cast<std::size_t>(motion.kind)])).append(" ");
  append_printed(out, translated("(%.1f mm at the screws)"), motion.error_m * 1e3);
}

void append(std::string& out, const nav::RefusalReason& reason) {
  if (reason.kind == nav::RefusalReason::Kind::kFitsOtherLevel) {
    if (reason.level == nav::kSeveralLevels) {
      out += translated("the points fit several levels as well");
    } else {
      append_with(out, translated("the points fit level %s as well"), reason.level);
    }
    return;
  }
  const auto [format, unit] = words_about(reason.kind);
  append_beside_limit(out, translated(format), reason.value * unit, reason.limit * unit);
  if (reason.motion) {
    out += ": ";
    append(out, *reason.motion);
  }
  if (reason.scrape) {
    out += ": ";
    append_part(out, translated("scrape to the bone at the %s"), *reason.scrape);
  }
}

void append(std::string& out, std::span<const nav::RefusalReason> reasons) {
  if (reasons.empty()) {
    out += translated("registration not accepted");
    return;
  }
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    out += i > 0 ? "; " : "";
    append(out, reasons[i]);
  }
}

namespace {

void append_refusal(std::string& out, const TouchRefusal& why) {
  using enum TouchRefusal::Kind;
  const auto length = [&](const char* format) {
    append_beside_limit(out, format, why.value_m * 1e3, why.limit_m * 1e3);
  };
  const auto angle = [&](const char* format) {
    append_beside_limit(out, format, degrees(why.turn_rad), degrees(why.turn_limit_rad));
  };
  switch (why.kind) {
    case kPressAgain:
      out += translated("press again");
      break;
    case kPointerNotSeen:
      out += translated("pointer not seen");
      break;
    case kTipMoved:
      length(translated("tip moved %.1f mm, limit %.1f mm"));
      break;
    case kHeldTooLong:
      out += translated("hold too long");
      break;
    case kTooMany:
      append_printed(out, translated("limit of %zu check points reached"), nav::kMaxCheckPoints);
      break;
    case kTouchesApart:
      length(translated("touches %.1f mm apart, limit %.1f mm: touch again"));
      break;
    case kTooNear:
      length(translated("%.0f mm from the reference, at least %.0f mm: make it farther away"));
      break;
    case kGuideNotSeen:
      out += translated("guide was hidden during the press");
      break;
    case kReferenceNotSeen:
      out += translated("reference not seen");
      break;
    case kSleeveTurned:
      angle(translated("sleeve turned %.1f°, limit %.1f°"));
      break;
    case kOffTheScrew:
      length(translated("sleeve %.0f mm off the entry, limit %.0f mm"));
      break;
    case kAcrossTheScrew:
      angle(translated("sleeve %.0f° off the plan, limit %.0f°"));
      break;
    case kEntryUnsure:
      if (std::isfinite(why.value_m)) {
        length(translated("place known to ± %.1f mm, limit %.1f mm"));
      } else {
        out += translated("registration uncertainty unknown");
      }
      break;
    case kAngleUnsure:
      angle(translated("angle known to ± %.1f°, limit %.1f°"));
      break;
  }
}

/// The words of each kind of message, in several parts where needed.
struct MessageWriter {
  PartedText text;
  std::string& out = text.out;

  /// Of one step: in its file.
  template <class Kind>
  void operator()(const Kind& m) {
    write(text, m);
  }
  void operator()(std::monostate /*none*/) {}
  void operator()(const NotPossibleNow& m) {
    text.begin(Importance::kMessage);
    if (m.event == Event::kSayReplan) {
      out += translated(
          "not possible now: a screw is changed once its level is accepted, before it is drilled");
      return;
    }
    const char* format = translated("not possible now: %s");
    if (const auto phrase = phrase_of(m.event)) {
      append_with(out, format, "\"" + std::string(*phrase) + "\"");
    } else {
      append_with(out, format, translated(name_of(m.event)));
    }
  }
  void operator()(const NotUnderstood& /*m*/) {
    text.begin(Importance::kMessage);
    out += translated("not understood");
  }
  void operator()(const NothingToDelete& m) {
    text.begin(Importance::kMessage);
    constexpr std::array<const char*, 5> kTexts = {
        translatable("nothing to delete"), translatable("no check point to delete"),
        translatable("no head to delete"), translatable("no touch of the landmark to delete"),
        translatable("measure the wire first")};
    out += translated(kTexts[static_cast<std::size_t>(m.what)]);
  }
  void operator()(const TouchNotRecorded& m) {
    text.begin(Importance::kMessage);
    constexpr std::array<const char*, 5> kTexts = {
        translatable("check point not recorded:"), translatable("head not recorded:"),
        translatable("landmark not recorded:"), translatable("guide's tip not recorded:"),
        translatable("wire not recorded:")};
    out.append(translated(kTexts[static_cast<std::size_t>(m.what)])).append(" ");
    append_refusal(out, m.why);
  }
  void operator()(const TipCorrected& m) {
    text.begin(Importance::kMessage);
    append_printed(out, translated("tip corrected by %s"), format_mm(m.by_m).c_str());
  }
  void operator()(const AxisCorrected& m) {
    text.begin(Importance::kMessage);
    append_printed(out, translated("axis corrected by %.1f°"), degrees(m.by_rad));
  }
  void operator()(const ReplanUnclear& m) {
    text.begin(Importance::kMessage);
    append_error(out, m.why);
  }
  void operator()(const NoRod& m) {
    text.begin(Importance::kMessage);
    out.append(translated("no rod:")).append(" ");
    append_error(out, m.why);
  }
  void operator()(const MapMoved& m) {
    text.begin(Importance::kDanger);
    out += translated("the headset's map moved");
    ask_again(m.step);
  }
  void operator()(const ReferenceMoved& m) {
    text.begin(Importance::kDanger);
    out += translated("a patient reference moved");
    ask_again(m.step);
  }
  void ask_again(Step step) {
    if (step == Step::kDigitize) {
      text.begin(Importance::kNext, ": ");
      out += translated("digitize again");
    } else if (step == Step::kRod) {
      text.begin(Importance::kNext, ": ");
      out += translated("touch this rod's heads again");
    }
  }
  void operator()(const NoImages& m) {
    text.begin(Importance::kDanger);
    if (!m.repeats) {
      out += translated("no camera images");
      return;
    }
    constexpr std::array<const char*, 4> kTexts = {
        translatable("left camera repeats its picture: nothing is guided"),
        translatable("right camera repeats its picture: nothing is guided"),
        translatable("both cameras repeat their pictures: nothing is guided"),
        translatable("head tracking repeats its pose: nothing is guided")};
    out += translated(kTexts[static_cast<std::size_t>(*m.repeats)]);
  }
  void operator()(const Ended& /*m*/) {
    text.begin(Importance::kDanger);
    out += translated("ended");
  }
};

}  // namespace

void write_message(PartedText text, const Message& message) {
  std::visit(MessageWriter{text}, message);
}

void append(std::string& out, const Message& message) { write_message(PartedText{out}, message); }

namespace {

constexpr std::string_view kBetweenParts = " | ";

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
    if (const char* const act = facts_of(step).asks; *act != '\0') {
      next(act);
    }
  }
  void operator()(ByEye /*state*/) { (*this)(std::monostate()); }
  void operator()(const StrokesSoFar& strokes) {
    if (strokes.coaching != nullptr) {
      write_coaching(text, *strokes.coaching, "");
    } else {
      next(translatable("stroke the bone"));
    }
  }
  void operator()(const ChecksSoFar& checks) { write_checks(text, checks, ""); }
  void operator()(const LandmarkSoFar& landmark) { write_landmark(text, landmark, ""); }
  void operator()(const WireSoFar& wire) { write_wire(text, wire, ""); }
  void operator()(const HeadsSoFar& heads) { write_heads(text, heads); }
};

}  // namespace

void append_step(std::string& out, const StepOnDisplay& at) {
  out += translated(name_of(at.step));
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

const char* not_kept_text(Saved saved) {
  return saved == Saved::kNotSaved      ? translatable("NOT SAVED")
         : saved == Saved::kNotRecorded ? translatable("NOT RECORDED")
                                        : nullptr;
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
    }
  } else if (!taken) {
    out += told && !std::holds_alternative<std::monostate>(line.state) ? "; " : "";
    std::visit(StateWriter{text, line.at.step}, line.state);
  } else if (const auto* checks = std::get_if<ChecksSoFar>(&line.state)) {
    // The places to touch are still counted beside a lasting warning.
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
  if (const char* const not_kept = not_kept_text(line.saved)) {
    text.begin(line.saved == Saved::kNotSaved ? Importance::kDanger : Importance::kMessage,
               out.size() > begin ? "; " : "");
    out += translated(not_kept);
  }
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
  const std::string_view separator = out.size() > begin ? kBetweenParts : "";
  // A mark answers what was heard: a word would be one more to read in every step.
  if (line.saved == Saved::kSaved && (!line.heard || line.heard->sure)) {
    PartedText{out, parts}.begin(Importance::kHeard, separator);
    out += "✓";
  } else if (line.heard) {
    PartedText{out, parts}.begin(Importance::kHeard, separator);
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
