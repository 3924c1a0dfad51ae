#include "engine/session/replan_wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "base/angle.h"
#include "base/length_text.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/session/findings_wording.h"
#include "engine/session/said.h"

namespace orthonav::engine {
namespace {

/// Smaller values round to 0.0.
constexpr double kLeastShown = 0.05;
/// A change of the entry's depth follows from the bone's surface; smaller ones are not mentioned.
constexpr double kLeastDepth_m = 0.0005;

/// A way in one direction or the other.
struct Way {
  double by;
  const char* to;
  const char* away;
};

constexpr const char* kCranial = translatable("cranial");
constexpr const char* kCaudal = translatable("caudal");
constexpr const char* kMedial = translatable("medial");
constexpr const char* kLateral = translatable("lateral");

/// "entry moved 1.0 mm cranial and 0.4 mm medial", of the ways that do not round to zero.
void append_ways(std::string& out, const char* what, const char* format,
                 std::span<const Way> ways) {
  const std::size_t begin = out.size();
  bool first = true;
  for (const auto& [by, to, away] : ways) {
    if (std::abs(by) >= kLeastShown) {
      out += first && begin > 0 ? ", " : (first ? "" : " ");
      out.append(first ? what : translated("and")).append(" ");
      append_printed(out, format, std::abs(by));
      out.append(" ").append(translated(by > 0.0 ? to : away));
      first = false;
    }
  }
}

void append_entry(std::string& out, const nav::ScrewDifference& d) {
  const double inward_m = std::abs(d.entry_inward_m) < kLeastDepth_m ? 0.0 : d.entry_inward_m;
  const std::array<Way, 3> ways = {
      {{d.entry_cranial_m * 1e3, kCranial, kCaudal},
       {d.entry_medial_m * 1e3, kMedial, kLateral},
       {inward_m * 1e3, translatable("deeper"), translatable("shallower")}}};
  append_ways(out, translated("entry moved"), "%.1f mm", ways);
}

void append_aim(std::string& out, const nav::ScrewDifference& d) {
  const std::array<Way, 2> ways = {{{degrees(d.aim_cranial_rad), kCranial, kCaudal},
                                    {degrees(d.aim_medial_rad), kMedial, kLateral}}};
  append_ways(out, translated("aims"), translated("%.1f\u00b0 more"), ways);
}

const char* name_of(nav::ScrewDirection direction) {
  constexpr std::array<const char*, 4> kNames = {"cranial", "caudal", "medial", "lateral"};
  return kNames[static_cast<std::size_t>(direction)];
}

struct RequestText {
  std::string operator()(const SetScrewSize& size) const {
    if (size.diameter_m && size.length_m) {
      std::string out = "size ";
      append_size(out, *size.diameter_m, *size.length_m);
      return out;
    }
    return size.diameter_m ? "diameter " + in_mm(*size.diameter_m)
                           : "length " + in_mm(size.length_m.value_or(0.0));
  }
  std::string operator()(const NextScrewSize& next) const {
    constexpr std::array<const char*, 4> kNames = {"longer", "shorter", "thicker", "thinner"};
    return kNames[static_cast<std::size_t>(next.which)];
  }
  std::string operator()(const MoveScrew& move) const {
    constexpr std::array<const char*, 3> kNames = {"move ", "entry ", "target "};
    return std::string(kNames[static_cast<std::size_t>(move.part)]) + name_of(move.direction) +
           " " + in_mm(move.by_m);
  }
  std::string operator()(const TiltScrew& tilt) const {
    return std::string("tilt ") + name_of(tilt.direction) +
           printed(" %.1f\u00b0", degrees(tilt.by_rad));
  }
  std::string operator()(const UndoChange& /*undo*/) const { return "undo"; }
  std::string operator()(const PlaceScrew& place) const {
    return "plan " + place.level + " " + orthonav::name_of(place.side);
  }
};

void write_size_refusal(std::string& out, const ReplanRefusal& refusal) {
  const std::size_t begin = out.size();
  const bool both = refusal.diameter_m > 0.0 && refusal.length_m > 0.0;
  if (both) {
    append_size(out, refusal.diameter_m, refusal.length_m);
  } else {
    append_mm(out, std::max(refusal.diameter_m, refusal.length_m), 1);
  }
  enclose(out, begin,
          refusal.kind == ReplanRefusal::Kind::kLastSize
              ? translated("%s is the last of the list")
              : translated("%s is not in the list of screws"));
}

/// The reason of a kind without numbers.
std::string_view plain_reason(ReplanRefusal::Kind kind) {
  using enum ReplanRefusal::Kind;
  switch (kind) {
    case kDrillSet:
      return translated("the tip is set on the bone, lift it first");
    case kDrilling:
      return translated("drilling, draw the drill out first");
    case kWireIn:
      return translated(
          "its wire is in: the plan can change only once the wire was measured beyond a limit");
    case kNoScrewLeft:
      return translated("every screw of this level is done");
    case kNothingToUndo:
      return translated("nothing to undo");
    case kNoDiameter:
      return translated("the plan states no diameter");
    case kNoDirections:
      return translated("it runs too far off the usual directions");
    case kOffTheBone:
      return translated("its axis misses the bone that a pointer reaches");
    case kOtherScrew:
      return translated("another screw is in work");
    case kIllSized:
      return translated("no pedicle screw is so short, long, thin or thick");
    case kNoSuchSize:
    case kLastSize:
    case kEntryTooFar:
    case kTiltTooFar:
    case kBreach:
      return {};  // worded with their numbers
  }
  return {};
}

/// Where the nearest wall lies, by nav::direction_of: " (medial)".
void append_towards(std::string& out, std::string_view towards) {
  out.append(" (").append(translated(towards)).append(")");
}

void write_breach(PartedText text, const ReplanRefusal& refusal) {
  append_beside_limit(text.out,
                      translated("breaks through the cortex: clearance %.1f mm, limit %.1f mm"),
                      refusal.value * 1e3, refusal.limit * 1e3);
  append_towards(text.out, refusal.towards);
  text.begin(Importance::kNext, ": ");
  text.out += translated("say accept result to take it");
}

}  // namespace

void append_size(std::string& out, double diameter_m, double length_m) {
  const std::size_t begin = out.size();
  const double length_mm = length_m * 1e3;
  const bool whole = std::abs(length_mm - std::round(length_mm)) < kLeastShown;
  if (diameter_m > 0.0) {
    append_printed(out, "%.1f \u00d7 ", diameter_m * 1e3);
  }
  append_printed(out, whole ? "%.0f mm" : "%.1f mm", length_mm);
  if (!(diameter_m > 0.0)) {
    enclose(out, begin, translated("%s long"));
  }
}

std::string text_of(const nav::ScrewDifference& d) {
  std::string out;
  append_entry(out, d);
  append_aim(out, d);
  if (std::abs(d.diameter_to_m - d.diameter_from_m) * 1e3 >= kLeastShown ||
      std::abs(d.length_to_m - d.length_from_m) * 1e3 >= kLeastShown) {
    out += out.empty() ? "" : ", ";
    append_size(out, d.diameter_to_m, d.length_to_m);
    out.append(" ").append(translated("instead of")).append(" ");
    append_size(out, d.diameter_from_m, d.length_from_m);
  }
  return out.empty() ? translated("no difference") : out;
}

std::string text_of(const Replan& replan) { return std::visit(RequestText{}, replan); }

void write(PartedText text, const ReplanRefusal& refusal) {
  using enum ReplanRefusal::Kind;
  std::string& out = text.out;
  text.begin(refusal.kind == kBreach ? Importance::kDanger : Importance::kMessage);
  out.append(translated("screw not changed:")).append(" ");
  switch (refusal.kind) {
    case kNoSuchSize:
    case kLastSize:
      return write_size_refusal(out, refusal);
    case kEntryTooFar:
      return append_beside_limit(
          out, translated("entry %.1f mm from the preoperative plan, limit %.1f mm"),
          refusal.value * 1e3, refusal.limit * 1e3);
    case kTiltTooFar:
      return append_beside_limit(
          out, translated("tilted %.1f\u00b0 from the preoperative plan, limit %.1f\u00b0"),
          degrees(refusal.value), degrees(refusal.limit));
    case kBreach:
      return write_breach(text, refusal);
    case kDrillSet:
    case kDrilling:
    case kWireIn:
    case kNoScrewLeft:
    case kOtherScrew:
    case kNothingToUndo:
    case kNoDiameter:
    case kNoDirections:
    case kOffTheBone:
    case kIllSized:
      out += plain_reason(refusal.kind);
  }
}

void write(PartedText text, const ScrewReplanned& done) {
  std::string& out = text.out;
  text.begin(Importance::kMessage);
  if (done.undone) {
    out.append(translated("undone:")).append(" ");
  }
  out.append(done.level).append(" ").append(word_of(done.to.side)).append(" ");
  append_size(out, 2.0 * done.to.radius_m, nav::screw_length_m(done.to));
  if (done.clearance_m) {
    out += ", ";
    append_printed(out, translated("clearance %s"), said_mm(*done.clearance_m).c_str());
    append_towards(out, done.towards);
  } else {
    out.append(", ").append(translated("clearance not known"));
  }
  text.begin(Importance::kMore, "; ");
  out +=
      done.as_before_surgery ? translated("as planned before surgery") : text_of(done.difference);
}

}  // namespace orthonav::engine
