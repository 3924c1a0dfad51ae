#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tools/orthonav/shared/progress_bar.h"

namespace orthonav::tools {

/// Progress of a known number of items (ProgressBar); each quarter is shown at once.
class CountProgress {
 public:
  CountProgress(std::string what, std::int64_t total);
  void add_one() { set(done_ + 1, total_); }
  void set(std::int64_t done, std::int64_t total);

 private:
  std::string what_;
  std::int64_t total_;
  std::int64_t done_ = 0;
  std::int64_t earlier_ = 0;  ///< done before the first call
  ProgressBar bar_;
};

/// A callback that takes the number done and the total; the bar ends with the last copy of the
/// callback.
[[nodiscard]] std::function<void(int done, int all)> counted(const std::string& what);

}  // namespace orthonav::tools
