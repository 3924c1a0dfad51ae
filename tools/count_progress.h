#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace orthonav::tools {

/// How many of a known number are done, on standard error: a bar with an estimate of the time left
/// on a terminal, otherwise a plain line at each quarter.
class CountProgress {
 public:
  CountProgress(std::string what, std::int64_t total);
  ~CountProgress();
  CountProgress(const CountProgress&) = delete;
  CountProgress& operator=(const CountProgress&) = delete;

  void add_one();

 private:
  void draw_bar();

  std::string what_;
  std::int64_t total_;
  std::int64_t done_ = 0;
  bool terminal_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point drawn_{};
};

}  // namespace orthonav::tools
