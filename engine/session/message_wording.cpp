#include "engine/session/message_wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/angle.h"
#include "base/length_text.h"
#include "base/printed.h"
#include "engine/session/replan_wording.h"
#include "engine/session/wording.h"

namespace orthonav::engine {
namespace {

/// The refusals that only concern a sleeve over a wire.
void append_sleeve_refusal(std::string& out, const TouchRefusal& why) {
  using enum TouchRefusal::Kind;
  const auto length = [&](const char* format) {
    append_beside_limit(out, format, why.value_m * 1e3, why.limit_m * 1e3);
  };
  const auto angle = [&](const char* format) {
    append_beside_limit(out, format, degrees(why.turn_rad), degrees(why.turn_limit_rad));
  };
  switch (why.kind) {
    case kGuideNotSeen:
      out += "guide not seen all the while";
      break;
    case kReferenceNotSeen:
      out += "reference not seen";
      break;
    case kSleeveTurned:
      angle("sleeve turned %.1f°, limit %.1f°");
      break;
    case kOffTheScrew:
      length("sleeve %.0f mm off the entry, limit %.0f mm");
      break;
    case kAcrossTheScrew:
      angle("sleeve %.0f° off the plan, limit %.0f°");
      break;
    case kEntryUnsure:
      if (std::isfinite(why.value_m)) {
        length("place known to ± %.1f mm, limit %.1f mm");
      } else {
        out += "how sure the registration is, is not known";
      }
      break;
    case kAngleUnsure:
      angle("angle known to ± %.1f°, limit %.1f°");
      break;
    default:
      break;
  }
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
    case TouchRefusal::Kind::kTouchesApart:
      append_beside_limit(out, "touches %.1f mm apart, limit %.1f mm: touch it anew",
                          why.value_m * 1e3, why.limit_m * 1e3);
      break;
    case TouchRefusal::Kind::kTooNear:
      append_beside_limit(out, "%.0f mm from the reference, at least %.0f mm: make it farther away",
                          why.value_m * 1e3, why.limit_m * 1e3);
      break;
    case TouchRefusal::Kind::kGuideNotSeen:
    case TouchRefusal::Kind::kReferenceNotSeen:
    case TouchRefusal::Kind::kSleeveTurned:
    case TouchRefusal::Kind::kOffTheScrew:
    case TouchRefusal::Kind::kAcrossTheScrew:
    case TouchRefusal::Kind::kEntryUnsure:
    case TouchRefusal::Kind::kAngleUnsure:
      append_sleeve_refusal(out, why);
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
      out +=
          "not possible now: a screw is changed once its level is accepted, before it is drilled";
      return;
    }
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
    constexpr std::array<std::string_view, 5> kTexts = {
        "nothing to delete", "no check point to delete", "no head to delete",
        "no touch of the dimple to delete", "measure the wire first"};
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
      out += "verify the vertebral level";
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
    constexpr std::array<std::string_view, 5> kWhat = {"check point", "head", "dimple",
                                                       "guide's tip", "wire"};
    out.append(kWhat[static_cast<std::size_t>(m.what)]).append(" not recorded: ");
    append_refusal(out, m.why);
  }
  void operator()(const LandmarkMissing& m) {
    text.begin(Importance::kNext);
    out += "not yet: ";
    out += m.recorded ? words::kTouchDimple : words::kMakeDimple;
  }
  void operator()(const LandmarkMoved& m) {
    text.begin(Importance::kDanger);
    out += m.anchored ? "the reference moved " : "the patient or the map moved ";
    append_beside_limit(out, "%.1f mm, limit %.1f mm", m.off_m * 1e3, m.limit_m * 1e3);
    text.begin(Importance::kNext, ": ");
    out += "check again or reject";
  }
  void operator()(const BoneUnchecked& m) {
    text.begin(Importance::kDanger);
    append_printed(out, "bone not checked for %.0f s, the map may have drifted ", m.for_s);
    append_mm(out, m.drift_m, 1);
    text.begin(Importance::kNext, ": ");
    out += words::kTouchDimple;
  }
  void operator()(const TipCorrected& m) {
    text.begin(Importance::kMessage);
    out += "guide's tip corrected by ";
    append_mm(out, m.by_m, 1);
  }
  void operator()(const AxisCorrected& m) {
    text.begin(Importance::kMessage);
    append_printed(out, "guide's axis corrected by %.1f°", degrees(m.by_rad));
  }
  void operator()(const WireUndecided& /*m*/) {
    text.begin(Importance::kNext);
    out += "not yet: ";
    out += words::kKeepOrRedo;
  }
  void operator()(const NoOtherEntry& /*m*/) {
    text.begin(Importance::kNext);
    out += words::kNoOtherEntry;
  }
  void operator()(const ConfirmRedo& m) {
    text.begin(Importance::kNext);
    append_printed(out, m.redone == 1 ? "redone once already" : "redone %d times already",
                   m.redone);
    out += ": say delete again to redo it, accept to keep it";
  }
  void operator()(const ScrewRedone& m) {
    text.begin(Importance::kMessage);
    out += "new entry ";
    append_mm(out, m.from_hole_m, 1);
    out += " from the hole, clearance ";
    append_mm(out, m.clearance_m, 1);
    text.begin(Importance::kNext, ": ");
    out += "take the wire out and touch the dimple";
  }
  void operator()(const ReplanUnclear& m) {
    text.begin(Importance::kMessage);
    out += m.why.message;
  }
  void operator()(const ReplanRefusal& m) { write(text, m); }
  void operator()(const ScrewReplanned& m) { write(text, m); }
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

}  // namespace

void write_message(PartedText text, const Message& message) {
  std::visit(MessageWriter{text}, message);
}

void append(std::string& out, const Message& message) { write_message(PartedText{out}, message); }

}  // namespace orthonav::engine
