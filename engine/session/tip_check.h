#pragma once

#include <optional>
#include <variant>

#include "engine/session/landmark.h"
#include "engine/session/touch.h"

namespace orthonav::engine {

/// The guide's tip against the pointer's, both put into the same dimple. The pointer says where the
/// bone is and the guide is aimed by it, so an error that they do not share goes into every entry.
struct TipDifference {
  Vec3 apart_m;            ///< from the pointer's tip to the guide's, in the guide's marker
  double sd_m = 0.0;       ///< along an axis, of that
  double limit_m = 0.0;    ///< beyond it, it is offered to be corrected
  bool corrected = false;  ///< with the surgeon's consent

  [[nodiscard]] bool agrees() const { return apart_m.norm() <= limit_m; }
};

struct TipCheckRules {
  /// SD along an axis by which one tool's tag puts it elsewhere for as long as it is seen from one
  /// side: a tag that was printed 0.3 % too large stands 1.35 mm too far at 0.45 m, and two tools'
  /// tags are not off alike. From another side the same error points elsewhere, so no correction of
  /// the tip makes up for it.
  double tag_sd_m = 0.00078;
  /// Of the SD along an axis of the difference: one in 200 lies beyond where nothing but touches
  /// and tags is off (chi-squared with three degrees of freedom).
  double sds = 3.583;
  /// Farther apart they were not in the same dimple.
  double most_m = 0.010;
};

/// Done once in an operation, after the landmark was touched, or again whenever the surgeon likes.
class TipCheck {
 public:
  TipCheck() = default;
  TipCheck(const TipCheckRules& rules, const LandmarkRules& landmark)
      : rules_(rules), landmark_(landmark) {}

  [[nodiscard]] Touch& touch() { return touch_; }
  /// Of the guide's tip at `place`, the guide standing as `world_from_guide`, the pointer's tip
  /// having been at `pointer_tip`; or why not.
  [[nodiscard]] std::variant<TipDifference, TouchRefusal> take(
      const nav::PressedPlace& place, const Transform<World, Marker>& world_from_guide,
      const nav::PressedPlace& pointer_tip, bool anchored);
  /// Still to be done.
  [[nodiscard]] bool due() const { return !last_; }
  /// A difference waits for consent to be corrected.
  [[nodiscard]] bool offers() const { return last_ && !last_->corrected && !last_->agrees(); }
  /// The surgeon consents: the difference, which is none from now on.
  [[nodiscard]] Vec3 correct();
  [[nodiscard]] const std::optional<TipDifference>& last() const { return last_; }

 private:
  TipCheckRules rules_;
  LandmarkRules landmark_;
  std::optional<TipDifference> last_;
  Touch touch_;
};

}  // namespace orthonav::engine
