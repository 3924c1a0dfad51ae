#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

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
};
/// The mean of `key` over every screw, or every level, in a study; nothing if there is no value.
[[nodiscard]] std::optional<ClusteredMean> mean_over(const nlohmann::json& study,
                                                     std::string_view key, bool per_screw);

/// Statistics of a study's accepted registrations.
struct RegistrationQuality {
  int levels = 0;
  int places = 0;          ///< entries and targets with an error and a covariance
  double within_68 = 0.0;  ///< fraction of the places whose error lies in its ellipsoid
  double within_95 = 0.0;
  int silent = 0;                ///< levels accepted with more than `kSilent_m` at a screw
  double silent_upper_95 = 1.0;  ///< upper limit of their fraction (Clopper and Pearson 1934)
  static constexpr double kSilent_m = 0.002;
};
/// The same in counts, run by run.
struct RegistrationCounts {
  int levels = 0;
  int places = 0;
  int in_68 = 0;
  int in_95 = 0;
  int silent = 0;
  [[nodiscard]] RegistrationQuality quality() const;
};
/// Adds a run's report.
void add_run(const nlohmann::ordered_json& run, RegistrationCounts& counts);

/// The exact one-sided 95 % upper limit of a fraction, given `hits` out of `of`.
[[nodiscard]] double upper_limit_95(int hits, int of);

}  // namespace orthonav::engine
