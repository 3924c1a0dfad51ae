#include "hal/openxr/shared_clicker.h"

#include <algorithm>

namespace orthonav::openxr {

Status SharedClicker::do_poll(Timestamp until, std::vector<ClickerEvent>& events) {
  clicked_.clear();
  if (const Status status = inner_.poll(until, clicked_); !status) {
    return status;
  }
  changes_.clear();
  selected_.clear();
  display_.take_button(until, changes_);
  for (const ButtonChange& change : changes_) {
    // The runtime reports a press one frame late: its time may precede what was already passed on.
    const Timestamp time = std::max(change.time, told_);
    timer_.advance(time, selected_);
    if (change.lost) {
      // The surgeon did not let go: this is no click, and the next press starts afresh.
      selected_.push_back({ClickerAction::kRelease, time});
      timer_ = {};
    } else {
      timer_.button(change.down, time, selected_);
    }
  }
  timer_.advance(until, selected_);
  auto select = selected_.begin();
  for (const ClickerEvent& click : clicked_) {
    for (; select != selected_.end() && select->time <= click.time; ++select) {
      button_.offer(SharedButton::Hand::kFirst, *select, events);
    }
    button_.offer(SharedButton::Hand::kSecond, click, events);
  }
  for (; select != selected_.end(); ++select) {
    button_.offer(SharedButton::Hand::kFirst, *select, events);
  }
  told_ = until;
  return {};
}

}  // namespace orthonav::openxr
