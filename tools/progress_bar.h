#pragma once

#include <optional>
#include <string>

#include "base/stopwatch.h"

namespace orthonav::tools {

/// One line on standard error, redrawn in place, with an estimate of the time left. It draws on a
/// terminal only; elsewhere its owner writes plain lines.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  [[nodiscard]] bool on_terminal() const { return terminal_; }
  /// Draws, unless it did so a moment ago; `now` draws regardless. `fraction` is in [0, 1].
  void draw(double fraction, const std::string& what, bool now = false);
  /// Clears the line for other output.
  void clear();
  [[nodiscard]] double elapsed_s() const;

 private:
  bool terminal_;
  Stopwatch since_start_;
  std::optional<Stopwatch> since_drawn_;  ///< absent until the first time
};

/// The drawn text: a bar, per cent and text, within the columns; on a narrow terminal only the
/// text, cut off.
[[nodiscard]] std::string bar_text(double fraction, const std::string& what, std::size_t columns);

}  // namespace orthonav::tools
