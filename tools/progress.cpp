#include "tools/progress.h"

#include <cstdio>
#include <utility>

#include "base/how_many.h"
#include "engine/session/wording.h"

namespace orthonav::tools {

void OperationProgress::stepped(const StereoFrame& frame, const engine::Inputs& inputs,
                                const engine::Guidance& guidance) {
  if (next_) {
    next_->stepped(frame, inputs, guidance);
  }
  if (!step_) {
    first_ = frame.time;
  }
  const bool another = step_ != guidance.status.at;
  if (another) {
    step_ = guidance.status.at;
  }
  const double fraction = estimate_.fraction(frame.time, guidance);
  if (bar_.on_terminal()) {
    bar_.draw(fraction, engine::step_text(*step_), another);
  } else if (another) {
    std::fprintf(stderr, "%3.0f %%  %-18s  operation %6.1f s, elapsed %5.1f s\n", 100.0 * fraction,
                 engine::step_text(*step_).c_str(), seconds(frame.time - first_), bar_.elapsed_s());
  }
}

void OperationProgress::tell_untold() {
  if (const int times = std::exchange(untold_, 0); times > 0) {
    std::fprintf(stderr, "orthonav: the warning above came back %s\n",
                 how_many(times, "time").c_str());
  }
}

void OperationProgress::warn(const std::string& why) {
  if (why == warned_) {
    ++untold_;
    return;
  }
  bar_.clear();
  tell_untold();
  warned_ = why;
  std::fprintf(stderr, "orthonav: warning: %s\n", why.c_str());
}

void OperationProgress::withdrawn(const engine::Guidance& guidance) {
  if (!guidance.blank) {
    warn(engine::detail_text(guidance.status));
  }
  if (next_) {
    next_->withdrawn(guidance);
  }
}

void OperationProgress::cameras_failed(const std::string& why) {
  // Pairs may fail thirty times a second, each for a reason with its own time in it.
  constexpr double kQuiet_ms = 5000.0;
  if (!cameras_warned_ || cameras_warned_->elapsed_ms() >= kQuiet_ms) {
    cameras_warned_.emplace();
    warn(why);
  }
  if (next_) {
    next_->cameras_failed(why);
  }
}

void OperationProgress::input_failed(const std::string& why) {
  warn(why);
  if (next_) {
    next_->input_failed(why);
  }
}

void OperationProgress::captured(const engine::Snapshot& snapshot) {
  if (next_) {
    next_->captured(snapshot);
  }
}

}  // namespace orthonav::tools
