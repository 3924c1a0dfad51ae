#pragma once

#include <optional>
#include <variant>

#include "engine/session/landmark.h"
#include "engine/session/touch.h"

namespace orthonav::engine {

/// The guide's tip against the pointer's, both put into the same dimple. The pointer says where the
/// bone is and the guide is aimed by it, so an error that they do not share goes into every entry.
struct TipDifference {
  Vec3 apart_m;       ///< from the pointer's tip to the guide's, in the guide's marker
  double sd_m = 0.0;  ///< along an axis, of that
  /// By how the tips are known and by this: what they are most probably apart by.
  Vec3 by_m;
  double limit_m = 0.0;    ///< of `apart_m`: beyond it, `by_m` is offered as a correction
  bool corrected = false;  ///< with the surgeon's consent

  [[nodiscard]] bool agrees() const { return apart_m.norm() <= limit_m; }
};

struct TipCheckRules {
  /// Tags that are 0.3 % larger put their tool 1.35 mm too far at this distance from the cameras.
  /// From another side the same error points elsewhere, so no correction of the tip makes up for
  /// it: what is not known of the two tools' tag sizes is part of the difference's SD.
  double distance_m = 0.45;
  /// The SD of that, as a fraction, is never taken to be less: lenses differ from place to place.
  double least_size_sd = 0.0003;
  /// SD along an axis of how far the two described tips are apart, as their calibrations leave
  /// them. In a session it follows from `PlacedWireRules::tip_sd_m`.
  double prior_sd_m = 0.0007;
  /// A correction of less is not worth a word.
  double worth_m = 0.0002;
  /// Farther apart they were not in the same dimple.
  double most_m = 0.010;
};

/// Done once in an operation, after the landmark was touched, or again whenever the surgeon likes.
class TipCheck {
 public:
  TipCheck() = default;
  /// `compare` false: the tips are not asked for.
  TipCheck(const TipCheckRules& rules, const LandmarkRules& landmark, bool compare = true)
      : rules_(rules), landmark_(landmark), compare_(compare) {}

  /// Of the guide's tip at `place`, the guide standing as `world_from_guide`, the pointer's tip
  /// having been at `pointer_tip`; or why not. `size_sd`: of how much larger
  /// the tags of one are than those of the other, as a fraction.
  [[nodiscard]] std::variant<TipDifference, TouchRefusal> take(
      const nav::PressedPlace& place, const Transform<World, Marker>& world_from_guide,
      const nav::PressedPlace& pointer_tip, bool anchored, double size_sd);
  /// Still to be done.
  [[nodiscard]] bool due() const { return compare_ && !last_; }
  /// A difference waits for consent to be corrected.
  [[nodiscard]] bool offers() const { return last_ && !last_->corrected && !last_->agrees(); }
  /// SD along an axis by which the guide's tip is off where the pointer's would be, as far as is
  /// known by now; `size_sd` as in `take`.
  [[nodiscard]] double difference_sd_m(double size_sd) const;
  /// The surgeon consents: what is taken off the guide's tip.
  [[nodiscard]] Vec3 correct();
  [[nodiscard]] const std::optional<TipDifference>& last() const { return last_; }

 private:
  [[nodiscard]] double along_sight_m(double size_sd) const;

  TipCheckRules rules_;
  LandmarkRules landmark_;
  bool compare_ = true;
  std::optional<TipDifference> last_;
};

}  // namespace orthonav::engine
