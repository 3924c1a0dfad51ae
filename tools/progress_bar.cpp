#include "tools/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "base/printed.h"
#include "tools/terminal_width.h"

namespace orthonav::tools {
namespace {

constexpr auto kRedrawEvery = std::chrono::milliseconds(200);
constexpr std::size_t kLeastCells = 10;
constexpr std::size_t kMostCells = 40;
/// Before this much is done, an estimate of the remaining time is meaningless.
constexpr double kLeastFractionForEstimate = 0.05;

/// "40 s", "3 min".
std::string left_text(double left_s) {
  return left_s < 90.0 ? printed("%.0f s", left_s) : printed("%.0f min", left_s / 60.0);
}

}  // namespace

ProgressBar::ProgressBar() : terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::clear() {
  if (since_drawn_) {
    std::fputs("\r\033[K", stderr);
    since_drawn_.reset();
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
  std::string text = what;
  if (fraction > kLeastFractionForEstimate && fraction < 1.0) {
    text += ", about " + left_text(elapsed_s() * (1.0 - fraction) / fraction) + " left";
  }
  const std::size_t columns = terminal_columns(STDERR_FILENO).value_or(80);
  std::fprintf(stderr, "\r\033[K%s", bar_text(fraction, text, columns).c_str());
  std::fflush(stderr);
}

std::string bar_text(double fraction, const std::string& what, std::size_t columns) {
  // The last column stays free: a terminal may begin a new line there.
  const std::size_t most = std::max<std::size_t>(columns, 10) - 1;
  std::string text = printed("%3.0f %%  ", 100.0 * fraction) + what;
  if (text.size() + kLeastCells + 3 > most) {
    text.resize(std::min(text.size(), most));
    return text;
  }
  const std::size_t cells = std::min(most - text.size() - 3, kMostCells);
  std::string bar(static_cast<std::size_t>(std::lround(fraction * static_cast<double>(cells))),
                  '#');
  bar.resize(cells, '.');
  return "[" + bar + "] " + text;
}

}  // namespace orthonav::tools
