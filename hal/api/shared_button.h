#pragma once

#include <vector>

#include "hal/api/devices.h"

namespace orthonav {

/// Two buttons as one: who presses first has it until the release, and what the other does
/// meanwhile is lost. A press belongs to whoever pressed, and so does all up to the next press of
/// anybody.
class SharedButton {
 public:
  enum class Hand { kNobody, kFirst, kSecond };
  /// Appends the event where it counts.
  void offer(Hand hand, const ClickerEvent& event, std::vector<ClickerEvent>& events);

 private:
  ButtonState state_;
  Hand hand_ = Hand::kNobody;
};

}  // namespace orthonav
