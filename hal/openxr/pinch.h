#pragma once

#include <algorithm>
#include <optional>

namespace orthonav::openxr {

/// Thumb and index finger of one hand as a button, from how far they are closed, 0 to 1. The hand
/// must have been seen open first: one that comes into view closed, for example around an
/// instrument, does not press. The button is pressed when the hand is seen closed twice in a row,
/// and released when it is clearly open again or out of sight.
class Pinch {
 public:
  static constexpr float kCloses = 0.85f;
  static constexpr float kOpens = 0.5f;

  /// Takes the newest value, absent if the hand is not tracked. Returns whether the button is down.
  bool take(std::optional<float> closed) {
    if (!closed) {
      *this = {};
      return false;
    }
    if (*closed <= kOpens) {
      open_ = true;
      down_ = false;
    }
    const bool closes = open_ && *closed >= kCloses;
    down_ = down_ || (closes && closed_before_);
    closed_before_ = closes;
    return down_;
  }
  [[nodiscard]] bool down() const { return down_; }

 private:
  bool open_ = false;  ///< was seen open since it came into view
  bool closed_before_ = false;
  bool down_ = false;
};

/// How far thumb and index finger are closed if their tips are this far apart.
[[nodiscard]] inline float closed_at(float apart_m) {
  constexpr float kTouching_m = 0.012f;  // about a finger's thickness from joint to joint
  constexpr float kApart_m = 0.045f;
  return std::clamp((kApart_m - apart_m) / (kApart_m - kTouching_m), 0.0f, 1.0f);
}

}  // namespace orthonav::openxr
