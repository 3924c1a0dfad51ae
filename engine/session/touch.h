#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "base/transform.h"
#include "engine/session/text/messages.h"
#include "nav/guidance/screw.h"
#include "nav/registration/presses.h"

namespace orthonav::engine {

/// What is measured while the button is down, from a press to the click that follows, and in the
/// half second before it. Keeps its capacity, so presses don't allocate in the frame loop.
template <typename Sample>
class PressedSamples {
 public:
  PressedSamples() {
    samples_.reserve(64 + kBefore);
    before_.reserve(kBefore);
  }
  /// A press: the samples from here on belong together.
  void begin() {
    samples_.clear();
    begun_ = true;
    down_ = true;
    lost_ = false;
  }
  /// The button is released; a click that follows still uses the samples.
  void release() { down_ = false; }
  /// Drops all samples.
  void drop() {
    samples_.clear();
    before_.clear();
    begun_ = false;
    down_ = false;
    lost_ = false;
  }
  /// Adds a measured sample, once for each pair.
  void add(const Sample& sample) {
    if (down_) {
      samples_.push_back(sample);
      return;
    }
    if (before_.size() == kBefore) {
      before_.erase(before_.begin());
    }
    before_.push_back(sample);
  }
  /// Not measured in this pair, so earlier samples do not show where the tool rests.
  void lose() {
    before_.clear();
    lost_ = lost_ || begun_;
  }

  [[nodiscard]] bool down() const { return down_; }
  /// There was a press that no click has used yet.
  [[nodiscard]] bool begun() const { return begun_; }
  /// A sample was lost since the press.
  [[nodiscard]] bool lost() const { return lost_; }
  /// The samples while the button was down.
  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }

  /// Also counts the half second before the press if the tool rested already, that is if the means
  /// of its quarters and of the press are alike. Requires at least one sample of the press.
  template <typename Mean, typename Alike>
  void take_rest_before(const Mean& mean, const Alike& alike) {
    if (before_.size() < kBefore) {
      return;
    }
    const std::span<const Sample> all(before_);
    const auto late = mean(all.last(kBefore / 2));
    if (alike(mean(all.first(kBefore / 2)), late) && alike(late, mean(samples_))) {
      samples_.insert(samples_.end(), before_.begin(), before_.end());
    }
  }

 private:
  /// Half a second.
  static constexpr std::size_t kBefore = 15;

  std::vector<Sample> samples_;
  std::vector<Sample> before_;  ///< the oldest first
  bool begun_ = false;
  bool down_ = false;
  bool lost_ = false;
};

/// SD of a mean of `count` samples along (about) one of `axes` axes, from the squares of the
/// deviations. Because few samples can't show it, `sample_sd` counts as much as three of them.
[[nodiscard]] double sd_of_mean(double sample_sd, double squares, double axes, double count);

/// SD along an axis of a tip at rest in one pair: jitter of the head's pose, and tremor.
inline constexpr double kRestingTipSd_m = 0.0006;
/// A tip that moves by more than this from one quarter of a second to the next is not at rest:
/// twice the effect of jitter and tremor.
inline constexpr double kTipAtRest_m = 0.001;

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

/// What the tools touch with one press of the button.
struct Touches {
  Touch pointer;
  Touch guide;
  AxisTouch sleeve;  ///< of the guide

  void begin() {
    pointer.begin();
    guide.begin();
    sleeve.begin();
  }
  void release() {
    pointer.release();
    guide.release();
    sleeve.release();
  }
  void drop() {
    pointer.drop();
    guide.drop();
    sleeve.drop();
  }
};

}  // namespace orthonav::engine
