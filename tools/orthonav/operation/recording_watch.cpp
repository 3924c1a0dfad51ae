#include "tools/orthonav/operation/recording_watch.h"

#include <cstdio>
#include "engine/session/text/wording.h"

#include "base/how_many.h"

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

void RecordingWatch::stepped(const FrameHeader& /*frame*/, const engine::Inputs& /*inputs*/,
                             const engine::Guidance& /*guidance*/) {
  if (const replay::RecordedCounts counts = recorder_->counts();
      !told_losses_ && counts.lost_pairs + counts.lost_others > 0) {
    told_losses_ = true;
    warn("the disk is too slow for the recording: pairs are being lost from it");
  }
  if (told_ || !recorder_->recording_failed()) {
    return;
  }
  told_ = true;
  warn(std::string(engine::not_kept_text(engine::Saved::kNotRecorded)) +
       " from here on: " + recorder_->recording_status().error().message);
}

void RecordingWatch::ended() {
  const replay::RecordedCounts counts = recorder_->counts();
  if (counts.lost_pairs + counts.lost_others > 0) {
    warn("the disk was too slow for the recording: it lacks " + std::to_string(counts.lost_pairs) +
         " of " + how_many(counts.pairs, "pair") + " that came, and " +
         std::to_string(counts.lost_others) + " depth pictures, poses and events");
  }
}

void RecordingWatch::warn(const std::string& line) {
  log_.warn(line);
  std::fprintf(stderr, "orthonav: %s\n", line.c_str());
}

}  // namespace orthonav::tools
