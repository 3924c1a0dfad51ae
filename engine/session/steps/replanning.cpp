#include "engine/session/steps/replanning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <utility>

#include "base/angle.h"
#include "base/length_text.h"
#include "base/printed.h"
#include "base/translation.h"
#include "engine/case/screw_place.h"
#include "engine/session/steps/guiding.h"
#include "engine/session/steps/placing.h"
#include "engine/session/text/wording.h"
#include "nav/guidance/anatomical_deviation.h"
#include "nav/guidance/predicted_error.h"
#include "nav/guidance/screw_clearance.h"

namespace orthonav::engine {

namespace {

using Kind = ReplanRefusal::Kind;
using ChangedOrNot = std::variant<nav::ScrewPlan, ReplanRefusal>;

/// Tolerance for rounding, so that a move by exactly the limit is allowed.
constexpr double kLastBits = 1e-9;
/// Radii that differ by less are the same, apart from rounding in files.
constexpr double kSameRadius_m = 1e-6;

ReplanRefusal no_size(Kind kind, double diameter_m, double length_m) {
  ReplanRefusal refusal{kind};
  refusal.diameter_m = diameter_m;
  refusal.length_m = length_m;
  return refusal;
}

/// Applies each kind of change to a screw.
struct Changer {
  const nav::ScrewPlan& now;
  const nav::VertebraModel& bone;
  const ScrewSizes& sizes;

  ChangedOrNot operator()(const SetScrewSize& size) const {
    const double diameter_m = size.diameter_m.value_or(2.0 * now.radius_m);
    const double length_m = size.length_m.value_or(nav::screw_length_m(now));
    // A planned size that is not mentioned stays, listed or not.
    const bool of_both = size.diameter_m && size.length_m;
    const bool listed = of_both           ? sizes.has(diameter_m, length_m)
                        : size.diameter_m ? sizes.of_diameter(diameter_m) != nullptr
                                          : sizes.has_length(length_m);
    if (!listed) {
      return no_size(Kind::kNoSuchSize, size.diameter_m.value_or(0.0), size.length_m.value_or(0.0));
    }
    return nav::resized_screw(now, 0.5 * diameter_m, size.length_m.value_or(0.0));
  }
  ChangedOrNot operator()(const NextScrewSize& next) const {
    using Which = NextScrewSize::Which;
    const double diameter_m = 2.0 * now.radius_m;
    if (next.which == Which::kThicker || next.which == Which::kThinner) {
      if (!(diameter_m > 0.0)) {
        return ReplanRefusal{Kind::kNoDiameter};
      }
      const auto other_m = sizes.next_diameter_m(diameter_m, next.which == Which::kThicker);
      return other_m ? ChangedOrNot(nav::resized_screw(now, 0.5 * *other_m, 0.0))
                     : no_size(Kind::kLastSize, diameter_m, 0.0);
    }
    const double length_m = nav::screw_length_m(now);
    const auto other_m = sizes.next_length_m(diameter_m, length_m, next.which == Which::kLonger);
    return other_m ? ChangedOrNot(nav::resized_screw(now, 0.0, *other_m))
                   : no_size(Kind::kLastSize, 0.0, length_m);
  }
  ChangedOrNot operator()(const MoveScrew& move) const {
    if (!nav::directions_of(now)) {
      return ReplanRefusal{Kind::kNoDirections};
    }
    const auto moved = nav::moved_screw(now, move.part, move.direction, move.by_m, bone.surface(),
                                        bone.reachable_surface());
    return moved ? ChangedOrNot(*moved) : ReplanRefusal{Kind::kOffTheBone};
  }
  ChangedOrNot operator()(const TiltScrew& tilt) const {
    const auto tilted = nav::tilted_screw(now, tilt.direction, tilt.by_rad);
    return tilted ? ChangedOrNot(*tilted) : ReplanRefusal{Kind::kNoDirections};
  }
  /// Position and length are free within the limits; the diameter must be in the list or unchanged.
  ChangedOrNot operator()(const PlaceScrew& place) const {
    nav::ScrewPlan placed = now;
    placed.entry = place.entry;
    placed.target = place.target;
    if (place.radius_m > 0.0 && std::abs(place.radius_m - now.radius_m) > kSameRadius_m) {
      if (sizes.of_diameter(2.0 * place.radius_m) == nullptr) {
        return no_size(Kind::kNoSuchSize, 2.0 * place.radius_m, 0.0);
      }
      placed.radius_m = place.radius_m;
    }
    if (ill_sized(placed.entry, placed.target, placed.radius_m)) {
      return ReplanRefusal{Kind::kIllSized};
    }
    if (misplaced(bone.surface(), placed.entry, placed.target, placed.radius_m)) {
      return ReplanRefusal{Kind::kOffTheBone};
    }
    return placed;
  }
  /// Undoing is handled elsewhere.
  ChangedOrNot operator()(const UndoChange& /*undo*/) const { return now; }
};

std::optional<ReplanRefusal> too_far(const nav::ScrewPlan& changed,
                                     const nav::ScrewPlan& preoperative,
                                     const ReplanLimits& limits) {
  const double moved_m = (changed.entry - preoperative.entry).norm();
  if (!(moved_m <= limits.entry_m + kLastBits)) {
    return ReplanRefusal{Kind::kEntryTooFar, moved_m, limits.entry_m};
  }
  const double tilted_rad = nav::tilt_between_rad(preoperative, changed);
  if (!(tilted_rad <= limits.tilt_rad + kLastBits)) {
    return ReplanRefusal{Kind::kTiltTooFar, tilted_rad, limits.tilt_rad};
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> ReplanLimits::check() const {
  std::vector<std::string> problems;
  if (!(entry_m >= 0.0 && entry_m <= 0.02)) {
    problems.push_back("entry_m must lie in [0, 0.02]");
  }
  if (!(tilt_rad >= 0.0 && tilt_rad <= 0.5)) {
    problems.push_back("tilt_rad must lie in [0, 0.5]");
  }
  for (const std::string& problem : sizes.check()) {
    problems.push_back("screw sizes: " + problem);
  }
  return problems;
}

ChangedOrNot changed(const Replan& replan, const nav::ScrewPlan& now,
                     const nav::ScrewPlan& preoperative, const nav::VertebraModel& bone,
                     const ReplanLimits& limits) {
  ChangedOrNot made = std::visit(Changer{now, bone, limits.sizes}, replan);
  if (const auto* screw = std::get_if<nav::ScrewPlan>(&made)) {
    if (const auto refusal = too_far(*screw, preoperative, limits)) {
      return *refusal;
    }
  }
  return made;
}

namespace {

using Kind = ReplanRefusal::Kind;

constexpr const char* kConsented = "accepted in surgery";
/// Tolerance of the search for the least clearance: a screw that is no worse may seem worse by
/// this.
constexpr double kNoWorse_m = 0.00005;

std::optional<nav::Clearance> clearance_of(const nav::VertebraModel& bone,
                                           const nav::ScrewPlan& screw) {
  const auto cylinder = nav::cylinder_of(screw);
  return cylinder ? nav::least_clearance(bone.surface(), *cylinder) : std::nullopt;
}

/// An earlier breach was accepted for a reason, which covers the new one as long as it is no worse.
std::optional<ReplanRefusal> worse_breach(const nav::VertebraModel& bone, const nav::ScrewPlan& now,
                                          const nav::ScrewPlan& changed) {
  const auto least = clearance_of(bone, changed);
  if (!least || !(least->clearance_m < 0.0)) {
    return std::nullopt;
  }
  const auto before = now.accepted_breach.empty() ? std::nullopt : clearance_of(bone, now);
  if (before && least->clearance_m >= before->clearance_m - kNoWorse_m) {
    return std::nullopt;
  }
  ReplanRefusal refusal{Kind::kBreach, least->clearance_m, 0.0};
  refusal.towards = nav::direction_of(*least, changed.side);
  return refusal;
}

void predict_again(LevelState& level) {
  if (level.registration) {
    level.predicted = nav::predicted_errors(*level.registration, level.plan.screws);
  }
}

/// Makes `plan` the plan in use.
ScrewReplanned put(LevelState& level, std::size_t screw, const nav::ScrewPlan& plan) {
  nav::ScrewPlan& in_use = level.plan.screws[screw];
  ScrewReplanned done;
  done.level = level.plan.label;
  done.from = std::exchange(in_use, plan);
  const auto least = clearance_of(*level.plan.model, in_use);
  if (least) {
    done.clearance_m = least->clearance_m;
    done.towards = nav::direction_of(*least, in_use.side);
  }
  if (least && least->clearance_m >= 0.0 && !level.screws[screw].earlier_plans.empty()) {
    in_use.accepted_breach.clear();
  }
  predict_again(level);
  done.to = in_use;
  done.difference = nav::difference_of(level.screws[screw].preoperative, in_use);
  done.as_before_surgery = level.screws[screw].earlier_plans.empty();
  return done;
}

ScrewReplanned put_new(LevelState& level, std::size_t screw, const nav::ScrewPlan& plan) {
  level.screws[screw].earlier_plans.push_back(level.plan.screws[screw]);
  return put(level, screw, plan);
}

std::variant<std::size_t, ReplanRefusal> screw_to_replan(const SessionState& work,
                                                         const Guiding& guiding,
                                                         const Placing& placing) {
  if (work.step == Step::kGuide) {
    switch (guiding.drill().phase) {
      case nav::DrillPhase::kAway:
        return guiding.screw();
      case nav::DrillPhase::kSet:
        return ReplanRefusal{Kind::kDrillSet};
      case nav::DrillPhase::kDrilling:
        return ReplanRefusal{Kind::kDrilling};
    }
  }
  if (work.step == Step::kMeasureWire) {
    return placing.undecided() ? std::variant<std::size_t, ReplanRefusal>(guiding.screw())
                               : ReplanRefusal{Kind::kWireIn};
  }
  const auto open = work.level().open_screw();
  if (!open) {
    return ReplanRefusal{Kind::kNoScrewLeft};
  }
  return *open;
}

}  // namespace

void Replanning::replan(SessionState& work, Guiding& guiding, Placing& placing, Timestamp time) {
  const auto screw = screw_to_replan(work, guiding, placing);
  if (const auto* refusal = std::get_if<ReplanRefusal>(&screw)) {
    return take(*refusal, work, guiding, placing, time);
  }
  take(change(work.level(), std::get<std::size_t>(screw)), work, guiding, placing, time);
}

bool Replanning::pending(const SessionState& work, const Guiding& guiding, const Placing& placing,
                         Timestamp said) const {
  if (!question_ || !question_->shown_at || said < *question_->shown_at ||
      said > *question_->shown_at + work.options.message_for ||
      question_->level != work.level().plan.label) {
    return false;
  }
  const auto screw = screw_to_replan(work, guiding, placing);
  const auto* index = std::get_if<std::size_t>(&screw);
  return index != nullptr && *index == question_->screw;
}

void Replanning::take_breach(SessionState& work, Guiding& guiding, Placing& placing,
                             Timestamp time) {
  const Question question = *std::exchange(question_, std::nullopt);
  take(put_new(work.level(), question.screw, question.plan), work, guiding, placing, time);
}

void Replanning::take(const Outcome& outcome, SessionState& work, Guiding& guiding,
                      Placing& placing, Timestamp time) const {
  if (const auto* refusal = std::get_if<ReplanRefusal>(&outcome)) {
    return work.messages.say(*refusal, time);
  }
  const auto& done = std::get<ScrewReplanned>(outcome);
  work.messages.say(done, time);
  work.observer->replanned(time, work.level(), asked_, done);
  if (work.step != Step::kMeasureWire) {
    // No frame may show a number, a depth or an alarm of the previous plan.
    return guiding.forget_guidance();
  }
  // The tool's path is kept; its wire is compared with the plan in use.
  placing.judge_again(work, guiding.screw(), time);
}

Replanning::Outcome Replanning::change(LevelState& level, std::size_t screw) {
  question_.reset();
  if (std::holds_alternative<UndoChange>(asked_)) {
    return undo(level, screw);
  }
  const nav::ScrewPlan& now = level.plan.screws[screw];
  if (const auto* place = std::get_if<PlaceScrew>(&asked_);
      place != nullptr && (place->level != level.plan.label || place->side != now.side)) {
    return ReplanRefusal{Kind::kOtherScrew};
  }
  const auto made =
      changed(asked_, now, level.screws[screw].preoperative, *level.plan.model, limits_);
  if (const auto* refusal = std::get_if<ReplanRefusal>(&made)) {
    return *refusal;
  }
  const auto& plan = std::get<nav::ScrewPlan>(made);
  if (const auto breach = worse_breach(*level.plan.model, now, plan)) {
    question_ = Question{level.plan.label, screw, plan, {}};
    question_->plan.accepted_breach = kConsented;
    return *breach;
  }
  return put_new(level, screw, plan);
}

void put_other_entry(LevelState& level, std::size_t screw, Point<Vertebra> entry) {
  nav::ScrewPlan& in_use = level.plan.screws[screw];
  level.screws[screw].earlier_plans.assign(1, in_use);
  in_use.entry = entry;
  predict_again(level);
}

void Replanning::show(const Message* message, Timestamp display_time) {
  const auto* asks = message != nullptr ? std::get_if<ReplanRefusal>(message) : nullptr;
  if (question_ && !question_->shown_at && asks != nullptr && asks->kind == Kind::kBreach) {
    question_->shown_at = display_time;
  }
}

Replanning::Outcome Replanning::undo(LevelState& level, std::size_t screw) const {
  auto& earlier = level.screws[screw].earlier_plans;
  if (!level.screws[screw].can_undo()) {
    return ReplanRefusal{Kind::kNothingToUndo};
  }
  const nav::ScrewPlan plan = earlier.back();
  earlier.pop_back();
  ScrewReplanned done = put(level, screw, plan);
  done.undone = true;
  return done;
}

// Its records.

void log_plan(LogJson& json, const LevelState& level, const std::string& why) {
  json["why"] = why;
  json["screws"] = LogJson::array();
  for (std::size_t i = 0; i < level.plan.screws.size(); ++i) {
    LogJson screw = json_of(level.plan.screws[i]);
    screw["redone"] = level.screws[i].redone;
    screw["earlier"] = LogJson::array();
    for (const nav::ScrewPlan& earlier : level.screws[i].earlier_plans) {
      screw["earlier"].push_back(json_of(earlier));
    }
    json["screws"].push_back(std::move(screw));
  }
}

void read_plan(const JsonNode& node, LevelState& level) {
  const std::vector<JsonNode> screws = node.list("screws");
  if (screws.size() != level.screws.size()) {
    node.refuse("screws", "must be " + std::to_string(level.screws.size()));
    return;
  }
  for (std::size_t i = 0; i < screws.size(); ++i) {
    level.plan.screws[i] = screw_from(screws[i]);
    const int redone = screws[i].integer("redone");
    if (redone != std::exchange(level.screws[i].redone, redone)) {
      level.screws[i].wire = {};  // it was of the wire that was taken out
    }
    level.screws[i].earlier_plans.clear();
    for (const JsonNode& earlier : screws[i].list("earlier")) {
      level.screws[i].earlier_plans.push_back(screw_from(earlier));
    }
  }
}

// Its words.

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
      return translated("it is too far off the usual directions");
    case kOffTheBone:
      return translated("its axis misses the bone that a pointer reaches");
    case kOtherScrew:
      return translated("another screw is in work");
    case kIllSized:
      return translated("no pedicle screw has this size");
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
    append_printed(out, translated("clearance %s"), format_mm(*done.clearance_m).c_str());
    append_towards(out, done.towards);
  } else {
    out.append(", ").append(translated("clearance unknown"));
  }
  text.begin(Importance::kMore, "; ");
  out +=
      done.as_before_surgery ? translated("as planned before surgery") : text_of(done.difference);
}

}  // namespace orthonav::engine
