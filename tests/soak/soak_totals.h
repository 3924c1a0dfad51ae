#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/soak/soak_operation.h"

namespace orthonav::soak {

/// Operations until caches and the heap have their final size.
inline constexpr std::size_t kWarmUp = 8;

/// The totals of all operations.
class SoakTotals {
 public:
  /// `resident_kib`: memory of the process after it.
  void add(const SoakRow& row, std::int64_t resident_kib);
  [[nodiscard]] std::size_t operations() const { return resident_kib_.size(); }
  [[nodiscard]] double simulated_s() const { return simulated_s_; }
  /// The memory curve as a drawing.
  [[nodiscard]] std::string picture() const;
  /// Prints the totals; returns whether everything is as it must be.
  [[nodiscard]] bool verdict() const;

 private:
  [[nodiscard]] double growth() const;
  [[nodiscard]] bool nothing_lost() const;
  void print_counts() const;

  std::vector<double> resident_kib_;
  double simulated_s_ = 0.0;
  std::int64_t completed_ = 0;
  std::int64_t with_reference_ = 0;
  std::int64_t troubles_ = 0;
  std::int64_t full_disks_ = 0;
  std::int64_t resumed_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t stale_ = 0;
  Counts kept_{};
  Counts lost_{};
  std::int64_t samples_ = 0;
  std::int64_t lost_samples_ = 0;
  std::int64_t unsaved_ = 0;
  std::int64_t doubled_ = 0;
  std::int64_t twice_ = 0;
  std::vector<std::string> problems_;
};

/// One row per operation.
void write_head(std::FILE* csv);
void write_row(std::FILE* csv, std::size_t number, const SoakRow& row, double wall_s,
               std::int64_t resident_kib);

}  // namespace orthonav::soak
