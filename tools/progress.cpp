#include "tools/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace orthonav::tools {
namespace {

// About the simulated time that each takes, in units of a screw.
constexpr double kDigitize = 3.0;
constexpr double kScrew = 1.0;
constexpr double kRod = 1.0;

}  // namespace

double share_done(const engine::Guidance& g) {
  double all = 2.0 * kRod;
  double done = 0.0;
  for (const engine::LevelState& level : g.levels) {
    all += kDigitize + kScrew * static_cast<double>(level.screw_done.size());
    if (level.registration) done += kDigitize;
    for (const bool screw : level.screw_done) done += screw ? kScrew : 0.0;
  }
  if (g.step == engine::Step::kDone) done += 2.0 * kRod;
  return std::clamp(done / all, 0.0, 1.0);
}

OperationProgress::OperationProgress(engine::LoopObserver* next, bool quiet)
    : next_(next), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

OperationProgress::~OperationProgress() {
  if (terminal_ && !quiet_ && !step_.empty()) std::fputs("\r\033[K", stderr);
}

void OperationProgress::stepped(const StereoFrame& frame, const engine::Inputs& inputs,
                                const engine::Guidance& guidance) {
  if (next_) next_->stepped(frame, inputs, guidance);
  if (quiet_) return;
  if (step_.empty()) first_ = frame.time;
  if (terminal_) {
    const auto now = std::chrono::steady_clock::now();
    if (guidance.step_text == step_ && now - last_bar_ < std::chrono::milliseconds(200)) return;
    last_bar_ = now;
    step_ = guidance.step_text;
    bar(share_done(guidance), step_);
  } else if (guidance.step_text != step_) {
    step_ = guidance.step_text;
    const double wall_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    std::fprintf(stderr, "%3.0f %%  %-18s  operation %6.1f s, elapsed %5.1f s\n",
                 100.0 * share_done(guidance), step_.c_str(), seconds(frame.time - first_), wall_s);
  }
}

void OperationProgress::captured(const engine::Snapshot& snapshot) {
  if (next_) next_->captured(snapshot);
}

void OperationProgress::bar(double share, const std::string& step) {
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(std::lround(share * kWidth));
  std::string cells(static_cast<std::size_t>(filled), '#');
  cells.resize(kWidth, '.');
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (share > 0.05)
    std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %s, about %.0f s left", cells.c_str(),
                 100.0 * share, step.c_str(), wall_s * (1.0 - share) / share);
  else
    std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %s", cells.c_str(), 100.0 * share, step.c_str());
}

}  // namespace orthonav::tools
