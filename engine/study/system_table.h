#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/study/system_profile.h"

namespace orthonav::engine {

/// A quantity over the operations of a study.
struct ClusteredMean {
  std::size_t values = 0;
  std::size_t operations = 0;
  double mean = 0.0;
  double sd = 0.0;
  /// Of the mean, from the means of operations: the screws of one operation share their errors.
  double standard_error = 0.0;
  std::vector<std::vector<double>> by_operation;
};
/// `key` of every screw, or of every level, in a study; nothing where there is no value.
[[nodiscard]] std::optional<ClusteredMean> mean_over(const nlohmann::json& study,
                                                     std::string_view key, bool per_screw);

/// What the room predicts of a published figure.
struct Prediction {
  std::string quantity;  ///< "entry", "angle", "RMSE"
  std::string unit;
  PublishedFigure published;
  double published_error = 0.0;  ///< standard error of the published mean
  bool assumed_error = false;    ///< the publication gives no SD or no number of screws
  ClusteredMean predicted;
  double z = 0.0;  ///< difference of the means by their standard error
  /// Two-sided, of the means (Welch's t; the operations count, not the screws) and of the SDs
  /// (resampled at the published number); the second absent where no SD was published.
  double mean_p = 1.0;
  std::optional<double> sd_p;
  int screws = 0;  ///< the published number, or the one that is assumed
  /// Within two standard errors.
  [[nodiscard]] bool agrees() const { return z >= -2.0 && z <= 2.0; }
  /// SDs within a factor of 1.5; nothing where none was published.
  [[nodiscard]] std::optional<bool> spread_agrees() const;
};

/// Every figure that the system published and the study holds.
[[nodiscard]] std::vector<Prediction> predictions_of(const SystemProfile& system,
                                                     const nlohmann::json& study);

/// The table of docs/accuracy.md: a line a figure.
[[nodiscard]] std::string system_table_heading();
[[nodiscard]] std::string system_table_rows(const SystemProfile& system,
                                            const std::vector<Prediction>& predictions);

}  // namespace orthonav::engine
