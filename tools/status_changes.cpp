#include "tools/status_changes.h"

#include "engine/session/wording.h"

namespace orthonav::tools {

void StatusChanges::look(Timestamp time, const engine::StatusLine& status) {
  first_ = first_.value_or(time);
  time_s_ = seconds(time - *first_);
  new_step_.clear();
  if (step_ != status.at) {
    step_ = status.at;
    engine::append_step(new_step_, *step_);
  }
  new_message_.clear();
  if (status.message != nullptr) {
    engine::append(new_message_, *status.message);
  }
  if (new_message_ == message_) {
    new_message_.clear();
  } else {
    message_ = new_message_;
  }
}

}  // namespace orthonav::tools
