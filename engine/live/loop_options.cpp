#include "engine/live/frame_loop.h"

namespace orthonav::engine {

std::vector<std::string> LoopOptions::check() const {
  std::vector<std::string> problems;
  if (draw_every < 0) {
    problems.push_back("draw_every must not be negative");
  }
  if (unguided_every < 1) {
    problems.push_back("unguided_every must be positive");
  }
  if (max_frames < 0) {
    problems.push_back("max_frames must not be negative");
  }
  if (max_time < Duration::zero()) {
    problems.push_back("max_time must not be negative");
  }
  if (max_errors_in_a_row < 0) {
    problems.push_back("max_errors_in_a_row must not be negative");
  }
  if (longest_silence <= Duration::zero()) {
    problems.push_back("longest_silence must be positive");
  }
  return problems;
}

}  // namespace orthonav::engine
