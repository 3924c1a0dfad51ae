#include "engine/session/replan_wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "base/angle.h"
#include "base/length_text.h"
#include "base/printed.h"
#include "engine/session/findings_wording.h"

namespace orthonav::engine {
namespace {

/// Smaller values round to 0.0.
constexpr double kLeastShown = 0.05;
/// A change of the entry's depth follows from the bone's surface; smaller ones are not mentioned.
constexpr double kLeastDepth_m = 0.0005;

void begin_item(std::string& out, std::size_t begin, const char* first, const char* further) {
  out += out.size() == begin ? first : further;
}

/// "1.0 mm cranial".
void append_way(std::string& out, const char* format, double value, const char* to,
                const char* away) {
  append_printed(out, format, std::abs(value));
  out.append(" ").append(value > 0.0 ? to : away);
}

void append_entry(std::string& out, const nav::ScrewDifference& d, std::size_t begin) {
  const std::size_t own = out.size();
  for (const auto& [by_m, to, away] :
       {std::tuple{d.entry_cranial_m, "cranial", "caudal"},
        std::tuple{d.entry_medial_m, "medial", "lateral"},
        std::tuple{std::abs(d.entry_inward_m) < kLeastDepth_m ? 0.0 : d.entry_inward_m, "deeper",
                   "shallower"}}) {
    if (std::abs(by_m) * 1e3 >= kLeastShown) {
      begin_item(out, own, begin == own ? "entry moved " : ", entry moved ", " and ");
      append_way(out, "%.1f mm", by_m * 1e3, to, away);
    }
  }
}

void append_aim(std::string& out, const nav::ScrewDifference& d, std::size_t begin) {
  const std::size_t own = out.size();
  for (const auto& [by_rad, to, away] : {std::tuple{d.aim_cranial_rad, "cranial", "caudal"},
                                         std::tuple{d.aim_medial_rad, "medial", "lateral"}}) {
    if (std::abs(degrees(by_rad)) >= kLeastShown) {
      begin_item(out, own, begin == own ? "aims " : ", aims ", " and ");
      append_way(out, "%.1f\u00b0 more", degrees(by_rad), to, away);
    }
  }
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
  const bool both = refusal.diameter_m > 0.0 && refusal.length_m > 0.0;
  if (both) {
    append_size(out, refusal.diameter_m, refusal.length_m);
  } else {
    append_mm(out, std::max(refusal.diameter_m, refusal.length_m), 1);
  }
  if (refusal.kind == ReplanRefusal::Kind::kLastSize) {
    out += " is the last of the list";
  } else {
    out += " is not in the list of screws";
  }
}

/// The reason of a kind without numbers.
std::string_view plain_reason(ReplanRefusal::Kind kind) {
  using enum ReplanRefusal::Kind;
  switch (kind) {
    case kDrillSet:
      return "the tip is set on the bone, lift it first";
    case kDrilling:
      return "drilling, draw the drill out first";
    case kWireIn:
      return "its wire is in: the plan can change only once the wire was measured beyond a limit";
    case kNoScrewLeft:
      return "every screw of this level is done";
    case kNothingToUndo:
      return "nothing to undo";
    case kNoDiameter:
      return "the plan states no diameter";
    case kNoDirections:
      return "it runs too far off the usual directions";
    case kOffTheBone:
      return "its axis misses the bone that a pointer reaches";
    case kOtherScrew:
      return "another screw is in work";
    case kIllSized:
      return "no pedicle screw is so short, long, thin or thick";
    case kNoSuchSize:
    case kLastSize:
    case kEntryTooFar:
    case kTiltTooFar:
    case kBreach:
      return {};  // worded with their numbers
  }
  return {};
}

void write_breach(PartedText text, const ReplanRefusal& refusal) {
  text.out += "breaks through the cortex: clearance ";
  append_beside_limit(text.out, "%.1f mm, limit %.1f mm", refusal.value * 1e3, refusal.limit * 1e3);
  text.out.append(" (").append(refusal.towards).append(")");
  text.begin(Importance::kNext, ": ");
  text.out += "say accept to take it";
}

}  // namespace

void append_size(std::string& out, double diameter_m, double length_m) {
  const double length_mm = length_m * 1e3;
  const bool whole = std::abs(length_mm - std::round(length_mm)) < kLeastShown;
  if (diameter_m > 0.0) {
    append_printed(out, "%.1f \u00d7 ", diameter_m * 1e3);
  }
  append_printed(out, whole ? "%.0f mm" : "%.1f mm", length_mm);
  out += diameter_m > 0.0 ? "" : " long";
}

std::string text_of(const nav::ScrewDifference& d) {
  std::string out;
  append_entry(out, d, 0);
  append_aim(out, d, 0);
  if (std::abs(d.diameter_to_m - d.diameter_from_m) * 1e3 >= kLeastShown ||
      std::abs(d.length_to_m - d.length_from_m) * 1e3 >= kLeastShown) {
    begin_item(out, 0, "", ", ");
    append_size(out, d.diameter_to_m, d.length_to_m);
    out += " instead of ";
    append_size(out, d.diameter_from_m, d.length_from_m);
  }
  return out.empty() ? "no difference" : out;
}

std::string text_of(const Replan& replan) { return std::visit(RequestText{}, replan); }

void write(PartedText text, const ReplanRefusal& refusal) {
  using enum ReplanRefusal::Kind;
  std::string& out = text.out;
  text.begin(refusal.kind == kBreach ? Importance::kDanger : Importance::kMessage);
  out += "screw not changed: ";
  switch (refusal.kind) {
    case kNoSuchSize:
    case kLastSize:
      return write_size_refusal(out, refusal);
    case kEntryTooFar:
      return append_beside_limit(out, "entry %.1f mm from the preoperative plan, limit %.1f mm",
                                 refusal.value * 1e3, refusal.limit * 1e3);
    case kTiltTooFar:
      return append_beside_limit(out,
                                 "tilted %.1f\u00b0 from the preoperative plan, limit %.1f\u00b0",
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
  out.append(done.undone ? "undone: " : "").append(done.level).append(" ");
  out.append(word_of(done.to.side)).append(" ");
  append_size(out, 2.0 * done.to.radius_m, nav::screw_length_m(done.to));
  if (done.clearance_m) {
    out += ", clearance ";
    append_mm(out, *done.clearance_m, 1);
    out.append(" (").append(done.towards).append(")");
  } else {
    out += ", clearance not known";
  }
  text.begin(Importance::kMore, "; ");
  out +=
      done.as_before_surgery ? std::string("as planned before surgery") : text_of(done.difference);
}

}  // namespace orthonav::engine
