#include "tools/orthonav/dashboard/status_changes.h"

#include <utility>

#include "engine/session/text/wording.h"

namespace orthonav::tools {

void StatusChanges::look(Timestamp time, const engine::StatusLine& status) {
  first_ = first_.value_or(time);
  time_s_ = seconds(time - *first_);
  new_step_.clear();
  const bool stepped = step_ != status.at;
  if (stepped) {
    step_ = status.at;
    engine::append_step(new_step_, *step_);
    told_ = shown_;
  }
  new_message_.clear();
  if (status.message != nullptr) {
    engine::append(new_message_, *status.message);
  }
  if (new_message_ == shown_) {
    new_message_.clear();
  } else {
    shown_ = new_message_;
    if (shown_ == told_ && !shown_.empty()) {
      ++back_;
      new_message_.clear();
    } else if (!shown_.empty()) {
      told_ = shown_;
    }
  }
  untold_ = stepped || !new_message_.empty() ? std::exchange(back_, 0) : 0;
}

}  // namespace orthonav::tools
