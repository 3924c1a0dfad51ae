#pragma once

#include <optional>
#include <variant>

#include "base/transform.h"
#include "engine/session/message.h"
#include "engine/session/pressed_samples.h"
#include "nav/registration/pressed_places.h"

namespace orthonav::engine {

/// The place, or why it does not count.
using TouchedPlace = std::variant<nav::PressedPlace, TouchRefusal>;

/// One place where the pointer's tip rests, from a press to the click that follows. Both belong to
/// one step: the owner of the touch drops it when the step begins. Time at rest before the press
/// counts too.
class Touch {
 public:
  /// A press: the tips from here on are those of one place.
  void begin() { tips_.begin(); }
  /// The button is released; a click that follows still uses the touch.
  void release() { tips_.release(); }
  /// Drops the touch.
  void drop() { tips_.drop(); }
  [[nodiscard]] bool down() const { return tips_.down(); }
  /// A measured tip, once for each pair.
  void add(Point<World> tip) { tips_.add(tip); }
  /// The tip was not measured, so earlier tips do not show where it rests.
  void lose() { tips_.lose(); }

  /// Where the tip rested; ends the touch in every case. `last_tip` is used for a click shorter
  /// than a frame: the tip of the pair just before it, if fresh. Refused if the press fell into
  /// another step, nothing was seen, or the tips scatter more than `max_spread_m` (root mean square
  /// about their mean).
  [[nodiscard]] TouchedPlace take_place(const std::optional<Point<World>>& last_tip,
                                        double max_spread_m);

 private:
  [[nodiscard]] TouchedPlace mean_tip(double max_spread_m) const;

  PressedSamples<Point<World>> tips_;
};

}  // namespace orthonav::engine
