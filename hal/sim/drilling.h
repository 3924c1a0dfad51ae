#pragma once

#include <cstddef>

#include "base/side.h"
#include "base/time.h"
#include "hal/sim/error_model.h"
#include "hal/sim/guidance_profile.h"
#include "hal/sim/room.h"

namespace orthonav::sim {

/// So long a median surgeon drives a wire; the tool's tip advances by so much meanwhile.
inline constexpr double kDriving_s = 3.5;
inline constexpr double kAdvance_m = 0.010;
/// Visual reaction to a moving target (Jeannerod 1988: 0.2-0.3 s), and the share of the seen
/// deviation taken out in a second: times the reaction well below 1, or the hand would swing.
inline constexpr double kReaction_s = 0.25;
inline constexpr double kGain_per_s = 1.6;

/// A hand that drives a wire, at a moment.
struct Drilling {
  std::size_t level = 0;
  Side side = Side::kLeft;
  double way = 0.0;        ///< fraction of the advance, 0 to 1
  Vec3 unseen_turn_rad{};  ///< by which the wire turns and the tool does not, in Room
};

/// How a hand turns while it drills: SDs about each direction across the tool.
struct HandWhileDrilling {
  double of_wire_rad = 0.0;  ///< what the hand's turn makes of the wire if nothing is corrected
  double unseen_rad = 0.0;   ///< of the wire and not of the tool, so that no display shows it
};
/// By the two magnitudes of drilling hands, which are totals: of the wire's axis without a number,
/// and with one. In a closed loop the hand turns as without a number and the surgeon takes part of
/// that out; `unseen_rad` is what is then missing, in quadrature, from the second magnitude.
[[nodiscard]] HandWhileDrilling hand_while_drilling(const ErrorModel& error_model,
                                                    GuidanceProfile guidance);
/// What correcting with that reaction and gain leaves of a hand's turn in the wire of a median
/// surgeon: 0.46, from reaction, gain and `kDriving_s`.
[[nodiscard]] double left_by_correcting();

/// A wire on its way into a bone. Its tip goes where the tool points at each moment, so its axis
/// is the chord of its way: what the hand does early counts as much as what it does late.
class AdvancingWire {
 public:
  AdvancingWire(const Drilling& begun, Point<Vertebra> entry, Timestamp pierced = {})
      : newest_(begun), entry_(entry), pierced_(pierced) {}
  /// The tool points along `inwards` (Vertebra, unit) as the wire gets to `way`.
  void follow(Vec3 inwards, const Drilling& now);
  [[nodiscard]] const Drilling& last() const { return newest_; }
  [[nodiscard]] Point<Vertebra> entry() const { return entry_; }
  [[nodiscard]] Timestamp pierced() const { return pierced_; }
  /// Unit; `first` before it advanced at all.
  [[nodiscard]] Vec3 direction(Vec3 first) const;

 private:
  Drilling newest_;
  Point<Vertebra> entry_;
  Timestamp pierced_{};
  Vec3 sum_{};
};

}  // namespace orthonav::sim
