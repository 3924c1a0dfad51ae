#include "engine/session/message_wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/angle.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/replan_wording.h"
#include "engine/session/said.h"
#include "engine/session/spoken_commands.h"
#include "engine/session/wording.h"

namespace orthonav::engine {
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
      append_printed(out, translated("limit of %zu check points reached"), nav::kMostCheckPoints);
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
  void operator()(const SaidBeforeShown& /*m*/) {
    text.begin(Importance::kMessage);
    out += translated("not accepted: said before the hologram was shown");
  }
  void operator()(const NothingToDelete& m) {
    text.begin(Importance::kMessage);
    constexpr std::array<const char*, 5> kTexts = {
        translatable("nothing to delete"), translatable("no check point to delete"),
        translatable("no head to delete"), translatable("no touch of the dimple to delete"),
        translatable("measure the wire first")};
    out += translated(kTexts[static_cast<std::size_t>(m.what)]);
  }
  void operator()(const ConfirmDelete& m) {
    text.begin(Importance::kNext);
    if (m.points == 1) {
      out += translated("say delete last again to drop the last saved point");
      return;
    }
    append_printed(out, translated("say delete last again to drop the last saved %zu points"),
                   m.points);
  }
  void operator()(const RegistrationRefused& m) {
    text.begin(Importance::kMessage);
    out.append(translated("refused:")).append(" ");
    const std::span<const nav::RefusalReason> reasons = m.reasons;
    if (m.error) {
      append_retold(out, m.error->message);
    } else {
      append(out, reasons.first(std::min<std::size_t>(1, reasons.size())));
    }
    if (m.another_level_fits) {
      text.begin(Importance::kNext, "; ");
      out += translated("verify the vertebral level");
    } else if (m.stroke_next) {
      text.begin(Importance::kNext, "; ");
      append(out, *m.stroke_next);
    }
  }
  void operator()(const ChecksMissing& m) {
    text.begin(Importance::kNext);
    out.append(translated("not accepted:")).append(" ");
    append(out, m.advice);
  }
  void operator()(const TouchNotRecorded& m) {
    text.begin(Importance::kMessage);
    constexpr std::array<const char*, 5> kTexts = {
        translatable("check point not recorded:"), translatable("head not recorded:"),
        translatable("dimple not recorded:"), translatable("guide's tip not recorded:"),
        translatable("wire not recorded:")};
    out.append(translated(kTexts[static_cast<std::size_t>(m.what)])).append(" ");
    append_refusal(out, m.why);
  }
  void operator()(const LandmarkMissing& m) {
    text.begin(Importance::kNext);
    out.append(translated(words::kNotYet)).append(" ");
    out += translated(m.recorded ? words::kTouchDimple : words::kMakeDimple);
  }
  void operator()(const LandmarkMoved& m) {
    text.begin(Importance::kDanger);
    append_beside_limit(out,
                        m.anchored
                            ? translated("the reference moved %.1f mm, limit %.1f mm")
                            : translated("the patient or the map moved %.1f mm, limit %.1f mm"),
                        m.off_m * 1e3, m.limit_m * 1e3);
    text.begin(Importance::kNext, ": ");
    out += translated("check again or reject level");
  }
  void operator()(const BoneUnchecked& m) {
    text.begin(Importance::kDanger);
    append_printed(out, translated("bone not checked for %.0f s, the map may have drifted %s"),
                   m.for_s, said_mm(m.drift_m).c_str());
    text.begin(Importance::kNext, ": ");
    out += translated(words::kTouchDimple);
  }
  void operator()(const TipCorrected& m) {
    text.begin(Importance::kMessage);
    append_printed(out, translated("guide's tip corrected by %s"), said_mm(m.by_m).c_str());
  }
  void operator()(const AxisCorrected& m) {
    text.begin(Importance::kMessage);
    append_printed(out, translated("guide's axis corrected by %.1f°"), degrees(m.by_rad));
  }
  void operator()(const WireUndecided& /*m*/) {
    text.begin(Importance::kNext);
    out.append(translated(words::kNotYet)).append(" ").append(translated(words::kKeepOrRedo));
  }
  void operator()(const NoOtherEntry& /*m*/) {
    text.begin(Importance::kNext);
    out += translated(words::kNoOtherEntry);
  }
  void operator()(const ConfirmRedo& m) {
    text.begin(Importance::kNext);
    append_printed(
        out,
        m.redone == 1 ? translated("redone once already") : translated("redone %d times already"),
        m.redone);
    out.append(": ").append(
        translated("say delete last again to redo it, accept result to keep it"));
  }
  void operator()(const ScrewRedone& m) {
    text.begin(Importance::kMessage);
    append_printed(out, translated("new entry %s from the hole, clearance %s"),
                   said_mm(m.from_hole_m).c_str(), said_mm(m.clearance_m).c_str());
    text.begin(Importance::kNext, ": ");
    out += translated("take the wire out and touch the dimple");
  }
  void operator()(const ReplanUnclear& m) {
    text.begin(Importance::kMessage);
    append_retold(out, m.why.message);
  }
  void operator()(const ReplanRefusal& m) { write(text, m); }
  void operator()(const ScrewReplanned& m) { write(text, m); }
  void operator()(const NoRod& m) {
    text.begin(Importance::kMessage);
    out.append(translated("no rod:")).append(" ");
    append_retold(out, m.why.message);
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

}  // namespace orthonav::engine
