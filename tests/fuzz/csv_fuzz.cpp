#include <cmath>

#include "hal/replay/event_files.h"
#include "hal/replay/frame_files.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// The recordings' text files; each reader takes the same bytes.
void fuzz_csv(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  const auto poses = replay::read_poses(file.path());
  if (poses) {
    for (const auto& [ticks, pose] : *poses) {
      insist(ticks >= 0 && pose.translation().is_finite() &&
             orthonormality_error(pose.rotation()) <= 1e-9);
    }
  }
  const auto frames = replay::read_frames(file.path());
  if (frames) {
    for (std::size_t i = 1; i < frames->size(); ++i) {
      insist((*frames)[i].time > (*frames)[i - 1].time);
    }
  }
  const auto events = replay::read_events(file.path());
  if (events) {
    for (const auto& phrase : events->voice) {
      insist(!phrase.event.text.empty() && phrase.event.confidence >= 0.0 &&
             phrase.event.confidence <= 1.0 && phrase.available >= phrase.event.time);
    }
  }
  (void)replay::read_head_answers(file.path());
  (void)replay::read_device(file.path());
}

}  // namespace orthonav::fuzz
