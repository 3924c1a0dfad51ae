#include "engine/session/rod_wording.h"

#include "base/angle.h"
#include "base/printed.h"
#include "engine/session/said.h"

namespace orthonav::engine {
namespace {

void write_to_stroke(PartedText text, const RodInHandSoFar& rod) {
  text.begin(Importance::kNext);
  if (rod.made == 0) {
    text.out += translated(
        "stroke the straight rod from its first end on 3 sides, then say save points; if bend 1 is "
        "made, say go to next");
  } else {
    append_printed(
        text.out,
        translated(
            "bend %zu made: stroke the rod from its first end on 3 sides, then say save points"),
        rod.made);
  }
}

void write_to_do(PartedText text, const RodInHandSoFar& rod, const char* separator) {
  text.begin(Importance::kNext, separator);
  if (rod.cut_to_m) {
    append_cut(text.out, *rod.cut_to_m);
    text.out += "; ";
  }
  if (!rod.next) {
    text.out += translated("all bends are made, say finish rod");
    return;
  }
  append_next_bend(text.out, *rod.next);
  text.out += ", ";
  text.out += translated("then say go to next");
}

}  // namespace

void append_next_bend(std::string& out, const NextBend& bend) {
  const double set_deg = degrees(bend.set_rad);
  if (bend.number == 1) {
    append_printed(out, translated("bend %zu: %.0f mm, towards the line, set %.1f°"), bend.number,
                   bend.at_m * 1e3, set_deg);
    return;
  }
  append_printed(out, translated("bend %zu: %.0f mm, roll %.0f°, set %.1f°"), bend.number,
                 bend.at_m * 1e3, degrees(bend.roll_rad), set_deg);
}

void append_cut(std::string& out, double length_m) {
  append_printed(out, translated("cut to %s"), said_mm(length_m).c_str());
}

void write_rod_in_hand(PartedText text, const RodInHandSoFar& rod) {
  if (rod.stroking) {
    return write_to_stroke(text, rod);
  }
  write_to_do(text, rod, "");
  if (!rod.shown) {
    text.begin(Importance::kMessage, "; ");
    text.out += translated("no longer shown: it may have moved");
  }
}

void write_rod_not_measured(PartedText text, const RodNotMeasured& message) {
  using enum RodNotMeasured::Kind;
  std::string& out = text.out;
  text.begin(Importance::kMessage);
  switch (message.kind) {
    case kNoInstructions:
      out += translated("no rod to bend: touch its heads first");
      return;
    case kMeasureFirst:
      append_printed(out,
                     translated("bend %zu is not measured: stroke the rod, then say save points"),
                     message.made);
      return;
    case kAllMade:
      out += translated("all bends are made, say finish rod");
      return;
    case kRefused:
      out.append(translated("rod not measured:")).append(" ");
      if (message.why) {
        append_retold(out, message.why->message);
      }
      return;
    case kOneSide:
      out += translated("rod not measured: stroked on one side alone");
      text.begin(Importance::kNext, ": ");
      out += translated("stroke it on 3 sides");
      return;
  }
}

}  // namespace orthonav::engine
