#pragma once

#include <cstddef>
#include <variant>

#include "engine/session/message.h"
#include "engine/session/pressed_samples.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// A tool's axis at rest, and what its scatter leaves of the mean: SDs of the direction about each
/// axis, and of the tip along each.
struct RestingAxis {
  nav::Axis<World> mean;  ///< from the tip, unit along the tool's axis
  double direction_sd_rad = 0.0;
  double tip_sd_m = 0.0;
  std::size_t pairs = 0;
};

/// One axis that a tool rests in, from a press to the click that follows: what `Touch` is for a
/// place. Where the tool rested already before the press, that counts too.
class AxisTouch {
 public:
  /// A press: the axes from here on are one.
  void begin() { axes_.begin(); }
  /// The button is up; the click that may follow still uses what was touched.
  void release() { axes_.release(); }
  /// There is none any more.
  void drop() { axes_.drop(); }
  /// Measured, once for each pair.
  void add(const nav::Axis<World>& axis) { axes_.add(axis); }
  /// Not measured in this pair: a touch under way is not one of a tool that was seen.
  void lose() { axes_.lose(); }

  /// Ends the touch, whatever the answer. Refused where the press fell into another step, the tool
  /// was not seen all the while, its tip scatters more than `max_spread_m` or its direction more
  /// than `max_turn_rad` (root mean squares about their means).
  [[nodiscard]] std::variant<RestingAxis, TouchRefusal> take(double max_spread_m,
                                                             double max_turn_rad);

 private:
  [[nodiscard]] std::variant<RestingAxis, TouchRefusal> mean(double max_spread_m,
                                                             double max_turn_rad) const;

  PressedSamples<nav::Axis<World>> axes_;
};

}  // namespace orthonav::engine
