#include "tools/progress.h"
#include "engine/session/wording.h"

#include <algorithm>
#include <cstdio>

namespace orthonav::tools {
namespace {

// Approximate simulated time of each part, in units of a screw.
constexpr double kDigitize = 3.0;
constexpr double kScrew = 1.0;
constexpr double kRod = 1.0;

}  // namespace

double fraction_done(const engine::Guidance& g) {
  double all = 2.0 * kRod;
  double done = 0.0;
  for (const engine::LevelState& level : g.levels) {
    all += kDigitize + kScrew * static_cast<double>(level.screw_done.size());
    if (level.registration) {
      done += kDigitize;
    }
    for (const bool screw : level.screw_done) {
      done += screw ? kScrew : 0.0;
    }
  }
  if (g.step == engine::Step::kDone) {
    done += 2.0 * kRod;
  }
  return std::clamp(done / all, 0.0, 1.0);
}

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
  const double fraction = fraction_done(guidance);
  if (bar_.on_terminal()) {
    bar_.draw(fraction, engine::step_text(*step_), another);
  } else if (another) {
    std::fprintf(stderr, "%3.0f %%  %-18s  operation %6.1f s, elapsed %5.1f s\n", 100.0 * fraction,
                 engine::step_text(*step_).c_str(), seconds(frame.time - first_), bar_.elapsed_s());
  }
}

void OperationProgress::captured(const engine::Snapshot& snapshot) {
  if (next_) {
    next_->captured(snapshot);
  }
}

}  // namespace orthonav::tools
