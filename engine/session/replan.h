#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "nav/guidance/changed_screw.h"

namespace orthonav::engine {

// What a surgeon asks to be changed of a screw, as data. It comes with Event::kSayReplan, whose
// cell in the workflow's table says where it is taken.

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
/// "undo": the last change of this screw.
struct UndoChange {
  friend bool operator==(const UndoChange&, const UndoChange&) = default;
};

/// A screw as another program planned it; it has no spoken form.
struct PlaceScrew {
  std::string level;
  nav::Side side = nav::Side::kLeft;
  Point<Vertebra> entry;
  Point<Vertebra> target;
  double radius_m = 0.0;  ///< 0: as it is
  friend bool operator==(const PlaceScrew&, const PlaceScrew&) = default;
};

using Replan =
    std::variant<SetScrewSize, NextScrewSize, MoveScrew, TiltScrew, UndoChange, PlaceScrew>;

/// Why a screw is not changed.
struct ReplanRefusal {
  enum class Kind : std::uint8_t {
    kDrillSet,       ///< the tip rests on the bone at the entry
    kDrilling,       ///< the drill is in the bone
    kWireIn,         ///< its wire is in, and none that was measured waits for a word
    kNoScrewLeft,    ///< every screw of the level is done
    kOtherScrew,     ///< another one than that in work was asked for
    kNothingToUndo,  ///< this screw was not changed
    kNoSuchSize,     ///< `diameter_m` × `length_m` is not in the list
    kLastSize,       ///< there is no further one that way
    kNoDiameter,     ///< the plan states none, so there is no next one
    kNoDirections,   ///< its directions have no names
    kOffTheBone,     ///< its axis would not meet the bone where a pointer reaches it
    kIllSized,       ///< shorter, longer, thinner or thicker than any screw is
    kEntryTooFar,    ///< `value` metres from the preoperative plan in all, above `limit`
    kTiltTooFar,     ///< `value` radians
    /// It would leave the cortex: a clearance of `value` metres, below `limit`. "accept" takes it
    /// all the same.
    kBreach,
  };
  Kind kind = Kind::kNothingToUndo;
  double value = 0.0;
  double limit = 0.0;
  double diameter_m = 0.0;
  double length_m = 0.0;
  const char* towards = "";  ///< of a breach: "medial"
};

/// A screw as it was changed just now.
struct ScrewReplanned {
  std::string level;
  nav::ScrewPlan from;
  nav::ScrewPlan to;
  bool undone = false;                ///< `to` was in use before
  bool as_before_surgery = false;     ///< `to` is the preoperative plan
  nav::ScrewDifference difference;    ///< of `to` from the preoperative plan
  std::optional<double> clearance_m;  ///< of `to`; absent: no diameter is stated
  const char* towards = "";           ///< where that is least
};

}  // namespace orthonav::engine
