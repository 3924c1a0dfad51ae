#pragma once

#include <cstddef>
#include <span>
#include <vector>

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

}  // namespace orthonav::engine
