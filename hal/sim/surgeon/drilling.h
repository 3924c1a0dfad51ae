#pragma once

#include <cstddef>

#include "base/side.h"
#include "base/time.h"
#include "hal/sim/error_model.h"
#include "hal/sim/room/room.h"
#include "hal/sim/surgeon/guidance_profile.h"

namespace orthonav::sim {

/// How long a median surgeon drives a wire, and how far the tool's tip advances meanwhile.
inline constexpr double kDriving_s = 3.5;
inline constexpr double kAdvance_m = 0.010;
/// Visual reaction to a moving target (Jeannerod 1988: 0.2-0.3 s), and the fraction of the seen
/// deviation corrected per second: its product with the reaction time must be well below 1, or the
/// hand would oscillate.
inline constexpr double kReaction_s = 0.25;
inline constexpr double kGain_per_s = 1.6;

/// The state of a hand that drives a wire.
struct Drilling {
  std::size_t level = 0;
  Side side = Side::kLeft;
  double way = 0.0;            ///< fraction of the advance, 0 to 1
  Vec3 unseen_rotation_rad{};  ///< by which the wire turns and the tool does not, in Room
};

/// How a hand turns while it drills: SDs about each direction across the tool.
struct HandWhileDrilling {
  double of_wire_rad = 0.0;  ///< of the wire from the hand's turn, without correction
  double unseen_rad = 0.0;   ///< of the wire but not of the tool, so that no display shows it
};
/// From the two magnitudes of drilling hands, which are totals for the wire's axis without a number
/// and with one. In a closed loop the hand turns as without a number and the surgeon corrects a
/// part of it; `unseen_rad` makes up the difference, in quadrature, to the second magnitude.
[[nodiscard]] HandWhileDrilling hand_while_drilling(const ErrorModel& error_model,
                                                    GuidanceProfile guidance);
/// The fraction of a hand's turn that remains in the wire of a median surgeon after correction:
/// 0.46, from reaction, gain and `kDriving_s`.
[[nodiscard]] double left_by_correcting();

/// A wire advancing into a bone. Its tip moves where the tool points at each moment, so its axis is
/// the chord of its path: early motion of the hand counts as much as late motion.
class AdvancingWire {
 public:
  AdvancingWire(const Drilling& begun, Point<Vertebra> entry, Timestamp pierced = {})
      : newest_(begun), entry_(entry), pierced_(pierced) {}
  /// The tool points along `inwards` (Vertebra, unit) when the wire has advanced to `way`.
  void follow(Vec3 inwards, const Drilling& now);
  [[nodiscard]] const Drilling& last() const { return newest_; }
  [[nodiscard]] Point<Vertebra> entry() const { return entry_; }
  [[nodiscard]] Timestamp pierced() const { return pierced_; }
  /// Unit; `first` before it has advanced.
  [[nodiscard]] Vec3 direction(Vec3 first) const;

 private:
  Drilling newest_;
  Point<Vertebra> entry_;
  Timestamp pierced_{};
  Vec3 sum_{};
};

}  // namespace orthonav::sim
