#include "tools/orthonav/shared/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "base/printed.h"
#include "tools/orthonav/shared/terminal_width.h"

namespace orthonav::tools {
namespace {

constexpr std::chrono::milliseconds kRedrawEvery{200};
constexpr std::size_t kLeastCells = 10;
constexpr std::size_t kMaxCells = 40;
/// Before this much is done, an estimate of the remaining time is meaningless.
constexpr double kLeastFractionForEstimate = 0.05;

/// "40 s", "3 min".
std::string time_text(double time_s) {
  return time_s < 90.0 ? printed("%.0f s", time_s) : printed("%.0f min", time_s / 60.0);
}

}  // namespace

ProgressBar::ProgressBar(std::chrono::milliseconds printed_every)
    : terminal_(isatty(STDERR_FILENO) != 0), every_(terminal_ ? kRedrawEvery : printed_every) {}

ProgressBar::~ProgressBar() { end(); }

void ProgressBar::end() {
  {
    const MutexLock lock(mutex_);
    ended_ = true;
    clear();
  }
  changed_.notify_all();
  if (repeats_.joinable()) {
    repeats_.join();
  }
}

void ProgressBar::clear() {
  if (on_screen_) {
    std::fputs("\r\033[K", stderr);
    on_screen_ = false;
  }
}

void ProgressBar::say(const std::string& line) {
  const MutexLock lock(mutex_);
  clear();
  std::fprintf(stderr, "%s\n", line.c_str());
}

void ProgressBar::draw(double fraction, const std::string& what, bool now, double from) {
  {
    const MutexLock lock(mutex_);
    fraction_ = std::clamp(fraction, 0.0, 1.0);
    from_ = from;
    what_ = what;
    if (!ended_ && (now || since_shown_.elapsed() >= every_)) {
      show();
    }
  }
  if (repeats_.joinable()) {
    return;
  }
  // Without memory there are fewer lines; the run ends in order for reasons of its own.
  try {
    repeats_ = std::thread([this] {
      try {
        repeat();
      } catch (const std::exception&) {
        // No line more.
      }
    });
  } catch (const std::exception&) {
    // Only what `draw` itself prints.
  }
}

/// On a terminal it counts the seconds.
void ProgressBar::repeat() {
  const auto again_after = terminal_ ? std::chrono::milliseconds(1000) : every_;
  const MutexLock lock(mutex_);
  while (!ended_) {
    if (since_shown_.elapsed() >= again_after) {
      show();
    }
    changed_.wait_until(mutex_, since_shown_.after(again_after));
  }
}

void ProgressBar::show() {
  since_shown_ = {};
  const std::string text = progress_text(fraction_, from_, what_, since_start_.elapsed_ms() / 1e3);
  if (terminal_) {
    const std::size_t columns = terminal_columns(STDERR_FILENO).value_or(80);
    std::fprintf(stderr, "\r\033[K%s", bar_text(fraction_, text, columns).c_str());
    std::fflush(stderr);
    on_screen_ = true;
  } else {
    std::fprintf(stderr, "%3.0f %%  %s\n", 100.0 * fraction_, text.c_str());
  }
}

std::string progress_text(double fraction, double from, const std::string& what, double elapsed_s) {
  std::string text = what + ", " + time_text(elapsed_s);
  if (fraction - from > kLeastFractionForEstimate && fraction < 1.0) {
    text += ", about " + time_text(elapsed_s * (1.0 - fraction) / (fraction - from)) + " left";
  }
  return text;
}

std::string bar_text(double fraction, const std::string& what, std::size_t columns) {
  // The last column stays free: a terminal may begin a new line there.
  const std::size_t most = std::max<std::size_t>(columns, 10) - 1;
  std::string text = printed("%3.0f %%  ", 100.0 * fraction) + what;
  if (text.size() + kLeastCells + 3 > most) {
    text.resize(std::min(text.size(), most));
    return text;
  }
  const std::size_t cells = std::min(most - text.size() - 3, kMaxCells);
  std::string bar(static_cast<std::size_t>(std::lround(fraction * static_cast<double>(cells))),
                  '#');
  bar.resize(cells, '.');
  return "[" + bar + "] " + text;
}

}  // namespace orthonav::tools
