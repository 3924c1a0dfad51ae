#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/report/report_values.h"
#include "study/mean_interval.h"

namespace orthonav::engine {

/// The quantities by which two studies are compared.
inline constexpr std::array<ReportQuantity, 5> kCompared = {{
    {"Trajectory error", "°", "angle_error_deg", true},
    {"Entry point error", "mm", "entry_error_mm", true},
    {"Error at the screws (TRE)", "mm", "tre_mm", false},
    {"Registration RMSE", "mm", "rmse_mm", false},
    {"Digitization time", "s", "digitization_s", false},
}};

/// The mean of an operation over the screws, or levels, that have a value in both studies.
struct PairedOperation {
  std::string case_name;
  std::uint64_t seed = 0;
  double first = 0.0;
  double second = 0.0;
};

/// One quantity in two studies. The screws of one operation share errors, so operations count, each
/// with the mean of its pairs.
struct ComparedQuantity {
  ReportQuantity quantity;
  std::size_t pairs = 0;  ///< screws, or levels
  std::vector<PairedOperation> operations;
  double first_mean = 0.0;
  double second_mean = 0.0;
  MeanInterval difference;  ///< first minus second, over the operations
  /// From two one-sided tests of the hypothesis that the true difference is at least the margin
  /// (`margin_of`).
  double equivalent_p = 1.0;
};

/// Two studies over the same cases and seeds.
struct StudyComparison {
  std::string first;  ///< the methods; the names if both have the same
  std::string second;
  std::size_t operations = 0;  ///< in both: same case, same seed
  std::size_t only_first = 0;
  std::size_t only_second = 0;
  std::size_t completed_first = 0;  ///< of those in both
  std::size_t completed_second = 0;
  std::vector<ComparedQuantity> quantities;  ///< those with a pair
};

/// Pairs by case, seed, level and side. `texts`: the JSON of two studies; `names` stand for them in
/// messages. Refuses in one line texts that are not studies, and studies without a common
/// operation.
Result<StudyComparison> compare_studies(const std::array<std::string, 2>& texts,
                                        const std::array<std::string, 2>& names);

/// The margin within which two studies count as equivalent: half a degree, half a millimetre; 5 s.
[[nodiscard]] double margin_of(const ReportQuantity& quantity);

/// A table in Markdown.
[[nodiscard]] std::string comparison_table(const StudyComparison& comparison);
/// In the form described in docs/file-formats.md.
[[nodiscard]] nlohmann::ordered_json comparison_json(const StudyComparison& comparison);

}  // namespace orthonav::engine
