#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace orthonav {

/// The distribution of positive values, say times in milliseconds, in a fixed space: adding a value
/// never allocates, however long it goes on. Count, mean, smallest and largest value are exact.
/// Values are sorted into bins 1 % wide, from 0.001 to 10⁶ of their unit.
class Histogram {
 public:
  void add(double value);
  [[nodiscard]] std::int64_t count() const { return count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  /// The value that `fraction` of the values lie at or below (nearest rank), within 0.5 %; the
  /// smallest and the largest value exactly. Absent without values.
  [[nodiscard]] std::optional<double> quantile(double fraction) const;
  /// Absent without values.
  [[nodiscard]] std::optional<double> mean() const;

 private:
  static constexpr double kWidth = 1.01;
  static constexpr double kLeast = 1e-3;
  static constexpr std::size_t kBins = 2083;  ///< up to kLeast · kWidth^kBins, which is 10⁶

  std::array<std::uint32_t, kBins> bins_{};
  std::int64_t count_ = 0;
  double sum_ = 0.0;
  double least_ = 0.0;
  double most_ = 0.0;
};

}  // namespace orthonav
