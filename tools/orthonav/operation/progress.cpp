#include "tools/orthonav/operation/progress.h"

#include <utility>

#include "base/how_many.h"
#include "engine/session/text/wording.h"

namespace orthonav::tools {

void OperationProgress::stepped(const FrameHeader& frame, const engine::Inputs& /*inputs*/,
                                const engine::Guidance& guidance) {
  const bool another = step_ != guidance.status.at;
  if (another) {
    step_ = guidance.status.at;
  }
  bar_.draw(estimate_.fraction(frame.time, guidance), engine::step_text(*step_), another);
}

void OperationProgress::tell_untold() {
  if (const int times = std::exchange(untold_, 0); times > 0) {
    bar_.say("orthonav: the warning above came back " + how_many(times, "time"));
  }
}

void OperationProgress::warn(const std::string& why) {
  if (why == warned_) {
    ++untold_;
    return;
  }
  tell_untold();
  warned_ = why;
  bar_.say("orthonav: warning: " + why);
}

void OperationProgress::withdrawn(const engine::Guidance& guidance) {
  if (!guidance.blank) {
    warn(engine::detail_text(guidance.status));
  }
}

void OperationProgress::cameras_failed(const std::string& why) {
  // Pairs may fail thirty times a second, each for a reason with its own time in it.
  constexpr double kQuiet_ms = 5000.0;
  if (!cameras_warned_ || cameras_warned_->elapsed_ms() >= kQuiet_ms) {
    cameras_warned_.emplace();
    warn(why);
  }
}

void OperationProgress::input_failed(const std::string& why) { warn(why); }

}  // namespace orthonav::tools
