#pragma once

#include <vector>

#include "hal/api/devices.h"

namespace orthonav {

/// Two buttons as one: the hand that presses first owns the button until its release, and the other
/// hand's events are dropped meanwhile. Everything from a press up to the next press by either hand
/// belongs to the hand that pressed.
class SharedButton {
 public:
  enum class Hand { kNobody, kFirst, kSecond };
  /// Appends the event if it counts.
  void offer(Hand hand, const ClickerEvent& event, std::vector<ClickerEvent>& events);

 private:
  ButtonState state_;
  Hand hand_ = Hand::kNobody;
};

}  // namespace orthonav
