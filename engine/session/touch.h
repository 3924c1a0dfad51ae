#pragma once

#include <optional>
#include <variant>

#include "base/transform.h"
#include "engine/session/message.h"
#include "engine/session/pressed_samples.h"
#include "nav/registration/pressed_places.h"

namespace orthonav::engine {

/// Or why it does not count.
using TouchedPlace = std::variant<nav::PressedPlace, TouchRefusal>;

/// One place that the pointer's tip rests on, from a press to the click that follows. Both belong
/// to one step: whoever owns the touch lets go of it where the step begins. Where the tip rested
/// already before the press, that counts too.
class Touch {
 public:
  /// A press: the tips from here on are those of one place.
  void begin() { tips_.begin(); }
  /// The button is up; the click that may follow still uses what was touched.
  void release() { tips_.release(); }
  /// There is none any more.
  void drop() { tips_.drop(); }
  [[nodiscard]] bool down() const { return tips_.down(); }
  /// A measured tip, once for each pair.
  void add(Point<World> tip) { tips_.add(tip); }
  /// The tip was not measured: where it was before says nothing of where it rests.
  void lose() { tips_.lose(); }

  /// Where the tip rested; ends the touch, whatever the answer. `last_tip` answers a click shorter
  /// than a frame: the tip of the pair just before it, if that is fresh. Refused when the press
  /// fell into another step, nothing was seen, or the tips scatter more than `max_spread_m` (root
  /// mean square about their mean).
  [[nodiscard]] TouchedPlace take_place(const std::optional<Point<World>>& last_tip,
                                        double max_spread_m);

 private:
  [[nodiscard]] TouchedPlace mean_tip(double max_spread_m) const;

  PressedSamples<Point<World>> tips_;
};

}  // namespace orthonav::engine
