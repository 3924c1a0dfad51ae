#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tools/progress_bar.h"

namespace orthonav::tools {

/// How many of a known number are done, on standard error: a bar on a terminal, otherwise a plain
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

/// For what tells how many are done, of how many: counts its calls, and begins with the first. Its
/// bar ends with the last copy of it.
[[nodiscard]] std::function<void(int done, int all)> counted(const std::string& what);

}  // namespace orthonav::tools
