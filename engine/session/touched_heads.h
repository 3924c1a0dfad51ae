#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/transform.h"
#include "engine/session/text/messages.h"
#include "nav/registration/presses.h"

namespace orthonav::engine {

/// A touch nearer to a head than this belongs to it. Neighbouring heads are 15 mm apart or more
/// (nav/guidance/rod.cpp); no touch errs by half of that.
inline constexpr double kSameHead_m = 0.0075;
/// SD along an axis of the pointer's ball in the drive socket of a screw (docs/rods.md). Estimate
/// (0.2 to 0.5 mm).
inline constexpr double kSeatingSd_m = 0.0003;
/// SD along an axis of what tracking adds to one head and not to its neighbours; touching again
/// does not take it away. Measured on the headset's map (0.37 mm) and with a patient reference
/// (0.11 mm, 0.14 with a tip that is off by 0.5 mm and held 10° differently).
inline constexpr double kHeadTrackingSd_m = 0.00037;
inline constexpr double kHeadTrackingSdAnchored_m = 0.00015;
/// The limit in SDs along an axis of the distance of a touch from the others of its head: one
/// touch in 200 exceeds it (chi-squared with three degrees of freedom).
inline constexpr double kHeadSds = 3.583;

/// One touch of a head, and what is known of the head with it.
struct HeadTouch {
  std::size_t head = 0;     ///< which one, in order of first touch, from 0
  Point<World> place;       ///< of this touch
  double sd_m = 0.0;        ///< of its tips' mean, along an axis
  std::size_t touches = 0;  ///< of the head
  double head_sd_m = 0.0;   ///< standard error of the head's place, along an axis
};

/// The screw heads of one rod: each is the mean of its touches.
class TouchedHeads {
 public:
  TouchedHeads() = default;
  explicit TouchedHeads(bool anchored) : anchored_(anchored) {}

  /// Records a touch: of a new head, or once more of one nearby. `shaft`: the pointer's, from the
  /// tip back, unit. Refused if it is farther from the other touches of its head than they scatter.
  [[nodiscard]] std::variant<HeadTouch, TouchRefusal> add(const nav::PressedPlace& touched,
                                                          Vec3 shaft = {});
  /// Takes the last touch back, and its head with it if it was the only one. Returns it as it was
  /// recorded; nothing if there is none.
  std::optional<HeadTouch> drop_last();

  [[nodiscard]] bool empty() const { return touches_.empty(); }
  [[nodiscard]] std::size_t heads() const { return heads_; }
  /// The places of the heads, in order of first touch.
  [[nodiscard]] std::vector<Point<World>> places() const;
  /// How often a head was touched.
  [[nodiscard]] std::size_t touches_of(std::size_t head) const;
  /// Standard error of a head's place along an axis: from the scatter of its touches, in which the
  /// SD stated for one touch counts as much as three of them, and from tracking.
  [[nodiscard]] double sd_m(std::size_t head) const;
  /// Where the pointer pointed at the heads, on average: towards the bone, as it came from outside.
  /// Of any length; zero without a touch.
  [[nodiscard]] Vec3 pointed() const;
  /// The newest touch; requires one.
  [[nodiscard]] HeadTouch last() const;

 private:
  struct OneTouch {
    std::size_t head = 0;
    nav::PressedPlace at;
    Vec3 shaft;
  };
  [[nodiscard]] Point<World> place_of(std::size_t head) const;
  /// The stated SD of one touch of that head.
  [[nodiscard]] double stated_sd_m(std::size_t head) const;
  [[nodiscard]] std::optional<std::size_t> head_near(Point<World> place) const;
  [[nodiscard]] double tracking_sd_m() const {
    return anchored_ ? kHeadTrackingSdAnchored_m : kHeadTrackingSd_m;
  }

  bool anchored_ = false;
  std::vector<OneTouch> touches_;  ///< in order
  std::size_t heads_ = 0;
};

}  // namespace orthonav::engine
