#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/case/screw_sizes.h"
#include "nav/guidance/changed_screw.h"

namespace orthonav::engine {

/// How far a screw may be changed in surgery in total, compared with the preoperative plan.
struct ReplanLimits {
  double entry_m = 0.010;                ///< of the entry
  double tilt_rad = 0.2617993877991494;  ///< 15°, of the axis
  ScrewSizes sizes = ScrewSizes::built_in();

  /// Every problem at once; empty when all is well.
  [[nodiscard]] std::vector<std::string> check() const;
};

// A surgeon's request to change a screw, as data. It comes with Event::kSayReplan; the workflow's
// table says in which steps it is accepted.

/// "screw six forty five", "diameter six", "length forty five".
struct SetScrewSize {
  std::optional<double> diameter_m;
  std::optional<double> length_m;
  friend bool operator==(const SetScrewSize&, const SetScrewSize&) = default;
};
/// "longer", "thinner": to the next size of the list.
struct NextScrewSize {
  enum class Which : std::uint8_t { kLonger, kShorter, kThicker, kThinner };
  Which which = Which::kLonger;
  friend bool operator==(const NextScrewSize&, const NextScrewSize&) = default;
};
/// "move cranial one", "entry medial two", "target caudal three".
struct MoveScrew {
  nav::ScrewPart part = nav::ScrewPart::kWhole;
  nav::ScrewDirection direction = nav::ScrewDirection::kCranial;
  double by_m = 0.0;
  friend bool operator==(const MoveScrew&, const MoveScrew&) = default;
};
/// "tilt cranial two".
struct TiltScrew {
  nav::ScrewDirection direction = nav::ScrewDirection::kCranial;
  double by_rad = 0.0;
  friend bool operator==(const TiltScrew&, const TiltScrew&) = default;
};
/// "undo": takes back the last change of this screw.
struct UndoChange {
  friend bool operator==(const UndoChange&, const UndoChange&) = default;
};

/// A screw as planned by another program; it has no spoken form.
struct PlaceScrew {
  std::string level;
  nav::Side side = nav::Side::kLeft;
  Point<Vertebra> entry;
  Point<Vertebra> target;
  double radius_m = 0.0;  ///< 0: unchanged
  friend bool operator==(const PlaceScrew&, const PlaceScrew&) = default;
};

using Replan =
    std::variant<SetScrewSize, NextScrewSize, MoveScrew, TiltScrew, UndoChange, PlaceScrew>;

/// Why a screw is not changed.
struct ReplanRefusal {
  enum class Kind : std::uint8_t {
    kDrillSet,       ///< the tip rests on the bone at the entry
    kDrilling,       ///< the drill is in the bone
    kWireIn,         ///< its wire is in, and no measured wire waits for a decision
    kNoScrewLeft,    ///< every screw of the level is done
    kOtherScrew,     ///< a screw other than the current one was asked for
    kNothingToUndo,  ///< this screw was not changed
    kNoSuchSize,     ///< `diameter_m` × `length_m` is not in the list
    kLastSize,       ///< the list has no further size in that direction
    kNoDiameter,     ///< the plan states no diameter, so there is no next one
    kNoDirections,   ///< its directions have no names
    kOffTheBone,     ///< its axis would not meet the bone where a pointer can reach it
    kIllSized,       ///< shorter, longer, thinner or thicker than any screw
    kEntryTooFar,    ///< `value` metres from the preoperative plan in total, above `limit`
    kTiltTooFar,     ///< `value` radians
    /// It would leave the cortex: a clearance of `value` metres, below `limit`. "accept" applies it
    /// anyway.
    kBreach,
  };
  Kind kind = Kind::kNothingToUndo;
  double value = 0.0;
  double limit = 0.0;
  double diameter_m = 0.0;
  double length_m = 0.0;
  const char* towards = "";  ///< of a breach: "medial"
};

/// A screw that was just changed.
struct ScrewReplanned {
  std::string level;
  nav::ScrewPlan from;
  nav::ScrewPlan to;
  bool undone = false;                ///< `to` was in use before
  bool as_before_surgery = false;     ///< `to` is the preoperative plan
  nav::ScrewDifference difference;    ///< of `to` from the preoperative plan
  std::optional<double> clearance_m;  ///< of `to`; absent: no diameter is stated
  const char* towards = "";           ///< direction of the least clearance
};

}  // namespace orthonav::engine
