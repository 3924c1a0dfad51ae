#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tools/progress_bar.h"

namespace orthonav::tools {

/// Progress of a known number of items, on standard error: a bar on a terminal, otherwise a plain
/// line at each quarter.
class CountProgress {
 public:
  CountProgress(std::string what, std::int64_t total);
  void add_one();

 private:
  std::string what_;
  std::int64_t total_;
  std::int64_t done_ = 0;
  ProgressBar bar_;
};

/// A callback that takes the number done and the total; the bar begins with the first call and ends
/// with the last copy of the callback.
[[nodiscard]] std::function<void(int done, int all)> counted(const std::string& what);

}  // namespace orthonav::tools
