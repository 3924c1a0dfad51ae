#include "tools/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace orthonav::tools {
namespace {

constexpr auto kRedrawEvery = std::chrono::milliseconds(200);
constexpr int kColumns = 30;
/// Before this much is done, an estimate of the rest means nothing.
constexpr double kLeastFractionForEstimate = 0.05;

}  // namespace

ProgressBar::ProgressBar() : terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  if (since_drawn_) {
    std::fputs("\r\033[K", stderr);
  }
}

double ProgressBar::elapsed_s() const { return since_start_.elapsed_ms() / 1e3; }

void ProgressBar::draw(double fraction, const std::string& what, bool now) {
  if (!terminal_) {
    return;
  }
  if (!now && since_drawn_ && since_drawn_->elapsed() < kRedrawEvery) {
    return;
  }
  since_drawn_.emplace();
  fraction = std::clamp(fraction, 0.0, 1.0);
  std::string cells(static_cast<std::size_t>(std::lround(fraction * kColumns)), '#');
  cells.resize(kColumns, '.');
  std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %s", cells.c_str(), 100.0 * fraction, what.c_str());
  if (fraction > kLeastFractionForEstimate) {
    std::fprintf(stderr, ", about %.0f s left", elapsed_s() * (1.0 - fraction) / fraction);
  }
  std::fflush(stderr);
}

}  // namespace orthonav::tools
