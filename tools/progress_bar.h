#pragma once

#include <chrono>
#include <string>

namespace orthonav::tools {

/// One line on standard error that is drawn over and over, with an estimate of the time left; only
/// on a terminal. Elsewhere it draws nothing, and its owner writes plain lines.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  [[nodiscard]] bool on_terminal() const { return terminal_; }
  /// Draws, unless it did a moment ago; `now` draws all the same. `share` in [0, 1].
  void draw(double fraction, const std::string& what, bool now = false);
  [[nodiscard]] double elapsed_s() const;

 private:
  bool terminal_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point drawn_{};
  bool drawn_once_ = false;
};

}  // namespace orthonav::tools
