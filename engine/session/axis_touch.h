#pragma once

#include <cstddef>
#include <variant>

#include "engine/session/message.h"
#include "engine/session/pressed_samples.h"
#include "nav/guidance/screw.h"

namespace orthonav::engine {

/// A tool's axis at rest, and the SDs of its mean that follow from the scatter: of the direction
/// about each axis, and of the tip along each.
struct RestingAxis {
  nav::Axis<World> mean;  ///< from the tip, unit along the tool's axis
  double direction_sd_rad = 0.0;
  double tip_sd_m = 0.0;
  std::size_t pairs = 0;
};

/// The axis of a tool at rest, from a press to the click that follows, like `Touch` for a place.
/// Time at rest before the press counts too.
class AxisTouch {
 public:
  /// A press: the axes from here on belong to one touch.
  void begin() { axes_.begin(); }
  /// The button is released; a click that follows still uses the touch.
  void release() { axes_.release(); }
  /// Drops the touch.
  void drop() { axes_.drop(); }
  /// Adds a measured axis, once for each pair.
  void add(const nav::Axis<World>& axis) { axes_.add(axis); }
  /// The tool was not measured in this pair, which spoils a touch under way.
  void lose() { axes_.lose(); }

  /// Ends the touch in every case. Refused if the press fell into another step, the tool was not
  /// seen throughout, its tip scatters more than `max_spread_m` or its direction more than
  /// `max_turn_rad` (root mean squares about their means).
  [[nodiscard]] std::variant<RestingAxis, TouchRefusal> take(double max_spread_m,
                                                             double max_turn_rad);

 private:
  [[nodiscard]] std::variant<RestingAxis, TouchRefusal> mean(double max_spread_m,
                                                             double max_turn_rad) const;

  PressedSamples<nav::Axis<World>> axes_;
};

}  // namespace orthonav::engine
