#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "base/transform.h"
#include "engine/session/message.h"

namespace orthonav::engine {

/// The place, or why it does not count.
using TouchedPlace = std::variant<Point<World>, TouchRefusal>;

/// One place that the pointer's tip rests on, from a press to the click that follows. Both belong
/// to one step: whoever owns the touch lets go of it where the step begins.
class Touch {
 public:
  Touch();
  /// A press: the tips from here on are those of one place.
  void begin();
  /// The button is up; the click that may follow still uses what was touched.
  void release() { down_ = false; }
  /// There is none any more. Keeps its room: pressing allocates nothing in the frame loop.
  void drop();
  [[nodiscard]] bool down() const { return down_; }
  /// A measured tip while the button is down.
  void add(Point<World> tip) { tips_.push_back(tip); }

  /// Where the tip rested; ends the touch, whatever the answer. `last_tip` answers a click shorter
  /// than a frame: the tip of the pair just before it, if that is fresh. Refused when the press
  /// fell into another step, nothing was seen, or the tips scatter more than `max_spread_m` (root
  /// mean square about their mean).
  [[nodiscard]] TouchedPlace take_place(const std::optional<Point<World>>& last_tip,
                                        double max_spread_m);

 private:
  [[nodiscard]] TouchedPlace mean_tip(double max_spread_m) const;

  std::vector<Point<World>> tips_;
  bool begun_ = false;  ///< by a press that no click has used yet
  bool down_ = false;
};

}  // namespace orthonav::engine
