#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "engine/session/message.h"
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
  AxisTouch();
  /// A press: the axes from here on are one.
  void begin();
  /// The button is up; the click that may follow still uses what was touched.
  void release() { down_ = false; }
  /// There is none any more. Keeps its room.
  void drop();
  /// Measured, once for each pair.
  void add(const nav::Axis<World>& axis);
  /// Not measured in this pair: a touch under way is not one of a tool that was seen.
  void lose();

  /// Ends the touch, whatever the answer. Refused where the press fell into another step, the tool
  /// was not seen all the while, its tip scatters more than `max_spread_m` or its direction more
  /// than `max_turn_rad` (root mean squares about their means).
  [[nodiscard]] std::variant<RestingAxis, TouchRefusal> take(double max_spread_m,
                                                             double max_turn_rad);

 private:
  void take_rest_before();
  [[nodiscard]] std::variant<RestingAxis, TouchRefusal> mean(double max_spread_m,
                                                             double max_turn_rad) const;

  std::vector<nav::Axis<World>> axes_;    ///< while the button is down
  std::vector<nav::Axis<World>> before_;  ///< of the last half second before, the oldest first
  bool begun_ = false;
  bool down_ = false;
  bool lost_ = false;  ///< since it was begun
};

}  // namespace orthonav::engine
