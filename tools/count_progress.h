#pragma once

#include <cstdint>
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

}  // namespace orthonav::tools
