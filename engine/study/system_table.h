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
  /// Standard error of the mean, from the means of operations, since the screws of one operation
  /// share errors.
  double standard_error = 0.0;
  std::vector<std::vector<double>> by_operation;
};
/// The mean of `key` over every screw, or every level, in a study; nothing if there is no value.
[[nodiscard]] std::optional<ClusteredMean> mean_over(const nlohmann::json& study,
                                                     std::string_view key, bool per_screw);

/// The room's prediction of a published figure.
struct Prediction {
  std::string quantity;  ///< "entry", "angle", "RMSE"
  std::string unit;
  PublishedFigure published;
  double published_error = 0.0;  ///< standard error of the published mean
  bool assumed_error = false;    ///< the publication gives no SD or no number of screws
  ClusteredMean predicted;
  double z = 0.0;  ///< difference of the means divided by its standard error
  /// Two-sided, of the means (Welch's t; the operations count, not the screws) and of the SDs
  /// (resampled at the published number); the second is absent if no SD was published.
  double mean_p = 1.0;
  std::optional<double> sd_p;
  int screws = 0;  ///< or registrations, for RMSE and TRE: the published number, or an assumed one
  /// Within two standard errors.
  [[nodiscard]] bool agrees() const { return z >= -2.0 && z <= 2.0; }
  /// Whether the SDs agree within a factor of 1.5; nothing if none was published.
  [[nodiscard]] std::optional<bool> spread_agrees() const;
};

/// Every figure that is both published for the system and in the study.
[[nodiscard]] std::vector<Prediction> predictions_of(const SystemProfile& system,
                                                     const nlohmann::json& study);

/// The table of docs/accuracy.md: one line per figure.
[[nodiscard]] std::string system_table_heading();
[[nodiscard]] std::string system_table_rows(const SystemProfile& system,
                                            const std::vector<Prediction>& predictions);

}  // namespace orthonav::engine
