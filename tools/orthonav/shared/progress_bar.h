#pragma once

#include <chrono>
#include <string>
#include <thread>

#include "base/mutex.h"
#include "base/stopwatch.h"

namespace orthonav::tools {

/// Progress on standard error, with an estimate of the time left. On a terminal one line, redrawn
/// in place; elsewhere plain lines. Never silent for longer than ten seconds between the first
/// `draw` and `end`, however long nobody calls: a thread of its own says the last state again.
class ProgressBar {
 public:
  /// Without a terminal a line comes at least this often.
  explicit ProgressBar(std::chrono::milliseconds printed_every = std::chrono::seconds(9));
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `fraction` is in [0, 1]; the part up to `from` took none of this time. Shown unless something
  /// was a moment ago; `now`: regardless.
  void draw(double fraction, const std::string& what, bool now = false, double from = 0.0)
      ORTHONAV_EXCLUDES(mutex_);
  /// A line of its own, which stays.
  void say(const std::string& line) ORTHONAV_EXCLUDES(mutex_);
  /// Clears the line; nothing more is shown.
  void end() ORTHONAV_EXCLUDES(mutex_);

 private:
  void repeat() ORTHONAV_EXCLUDES(mutex_);
  void show() ORTHONAV_REQUIRES(mutex_);
  void clear() ORTHONAV_REQUIRES(mutex_);

  const bool terminal_;
  const std::chrono::milliseconds every_;
  Stopwatch since_start_;
  Mutex mutex_;
  ConditionVariable changed_;
  bool ended_ ORTHONAV_GUARDED_BY(mutex_) = false;
  double fraction_ ORTHONAV_GUARDED_BY(mutex_) = 0.0;
  double from_ ORTHONAV_GUARDED_BY(mutex_) = 0.0;
  std::string what_ ORTHONAV_GUARDED_BY(mutex_);
  Stopwatch since_shown_ ORTHONAV_GUARDED_BY(mutex_);
  bool on_screen_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::thread repeats_;
};

/// "verify L4, 12 s, about 40 s left"; at the beginning and the end nothing is left to estimate.
[[nodiscard]] std::string progress_text(double fraction, double from, const std::string& what,
                                        double elapsed_s);

/// The drawn text: a bar, per cent and text, within the columns; on a narrow terminal only the
/// text, cut off.
[[nodiscard]] std::string bar_text(double fraction, const std::string& what, std::size_t columns);

}  // namespace orthonav::tools
