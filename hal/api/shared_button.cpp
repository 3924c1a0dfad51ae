#include "hal/api/shared_button.h"

namespace orthonav {

void SharedButton::offer(Hand hand, const ClickerEvent& event, std::vector<ClickerEvent>& events) {
  if (event.action == ClickerAction::kPress ? state_.pressed : hand != hand_) {
    return;
  }
  ButtonState next = state_;
  // A double click whose first click was dropped does not count as one.
  if (event.action == ClickerAction::kPress && hand != hand_) {
    next = {};
  }
  if (!next.take(event.action)) {
    return;
  }
  state_ = next;
  hand_ = hand;
  events.push_back(event);
}

}  // namespace orthonav
