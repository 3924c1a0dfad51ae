#include "hal/openxr/shared_clicker.h"

#include <algorithm>

namespace orthonav::openxr {

void SharedClicker::offer(Hand hand, const ClickerEvent& event, std::vector<ClickerEvent>& events) {
  if (event.action == ClickerAction::kPress ? state_.pressed : hand != hand_) return;
  ButtonState next = state_;
  // A double click of whom nobody saw the first click is none.
  if (event.action == ClickerAction::kPress && hand != hand_) next = {};
  if (!next.take(event.action)) return;
  state_ = next;
  hand_ = hand;
  events.push_back(event);
}

Status SharedClicker::do_poll(Timestamp until, std::vector<ClickerEvent>& events) {
  clicked_.clear();
  if (const Status status = inner_.poll(until, clicked_); !status) return status;
  changes_.clear();
  selected_.clear();
  display_.take_button(until, changes_);
  for (const ButtonChange& change : changes_) {
    // The runtime tells of a press a frame later: it may belong before what was told already.
    const Timestamp time = std::max(change.time, told_);
    timer_.advance(time, selected_);
    timer_.button(change.down, time, selected_);
  }
  timer_.advance(until, selected_);
  auto select = selected_.begin();
  for (const ClickerEvent& click : clicked_) {
    for (; select != selected_.end() && select->time <= click.time; ++select)
      offer(Hand::kDisplay, *select, events);
    offer(Hand::kInner, click, events);
  }
  for (; select != selected_.end(); ++select) offer(Hand::kDisplay, *select, events);
  told_ = until;
  return {};
}

}  // namespace orthonav::openxr
