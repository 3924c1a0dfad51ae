#pragma once

#include <vector>

#include "hal/api/devices.h"

namespace orthonav {

/// Two buttons as one: whoever presses first has it until the release, and what the other does
/// meanwhile is dropped. A press belongs to whoever pressed, and so does everything up to the next
/// press by either.
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
