#include "tools/recording_watch.h"

#include <cstdio>

#include "engine/session/saved_wording.h"

namespace orthonav::tools {

void RecordingWatch::watch(engine::AssembledOperation& operation,
                           const replay::RecordingHeadset& recorder,
                           const engine::SaveWatch* saving) {
  recorder_ = &recorder;
  saving_ = saving;
  operation.observe(static_cast<engine::LoopObserver*>(this));
  operation.show_saving(this);
}

engine::Saved RecordingWatch::saved(Timestamp now, Duration lately) const {
  const engine::Saved saved =
      saving_ != nullptr ? saving_->saved(now, lately) : engine::Saved::kNothingNew;
  const bool stopped = recorder_ != nullptr && recorder_->recording_failed();
  return stopped && saved == engine::Saved::kNothingNew ? engine::Saved::kNotRecorded : saved;
}

void RecordingWatch::stepped(const StereoFrame& /*frame*/, const engine::Inputs& /*inputs*/,
                             const engine::Guidance& /*guidance*/) {
  if (told_ || !recorder_->recording_failed()) {
    return;
  }
  told_ = true;
  const std::string line = std::string(engine::text_of(engine::Saved::kNotRecorded)) +
                           " from here on: " + recorder_->recording_status().error().message;
  log_.warn(line);
  std::fprintf(stderr, "orthonav: %s\n", line.c_str());
}

}  // namespace orthonav::tools
