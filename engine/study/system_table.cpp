#include "engine/study/system_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "engine/report/report_values.h"
#include "engine/study/two_samples.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

/// Where a publication gives no SD, half of the mean; where it gives no number of screws, twenty.
constexpr double kAssumedSd = 0.5;
constexpr int kAssumedScrews = 20;
constexpr int kScrewsPerRegistration = 2;  ///< one left and one right at a level
constexpr double kSdFactor = 1.5;

std::string mean_and_sd(double mean, const std::optional<double>& sd) {
  char text[64];
  if (sd) {
    std::snprintf(text, sizeof text, "%.2f ± %.2f", mean, *sd);
  } else {
    std::snprintf(text, sizeof text, "%.2f", mean);
  }
  return text;
}

void test(Prediction& p) {
  p.mean_p = welch_p({p.published.mean, p.published_error, std::max(1.0, p.screws - 1.0)},
                     {p.predicted.mean, p.predicted.standard_error,
                      std::max(1.0, static_cast<double>(p.predicted.operations) - 1.0)});
  if (p.published.sd) {
    p.sd_p = resampled_sd_p(p.predicted.by_operation, static_cast<std::size_t>(p.screws),
                            *p.published.sd);
  }
}

}  // namespace

std::optional<ClusteredMean> mean_over(const nlohmann::json& study, std::string_view key,
                                       bool per_screw) {
  if (!study.is_object() || !study.contains("runs")) {
    return std::nullopt;
  }
  std::vector<double> all;
  std::vector<double> of_operations;
  std::vector<std::vector<double>> by_operation;
  for (const nlohmann::json& run : study["runs"]) {
    const std::vector<double> values = values_of(run, key, per_screw);
    if (!values.empty()) {
      of_operations.push_back(nav::summarize(values).mean);
      all.insert(all.end(), values.begin(), values.end());
      by_operation.push_back(values);
    }
  }
  if (all.empty()) {
    return std::nullopt;
  }
  const nav::Summary over_all = nav::summarize(all);
  const nav::Summary over_operations = nav::summarize(of_operations);
  return ClusteredMean{over_all.count,
                       over_operations.count,
                       over_all.mean,
                       over_all.sd,
                       over_operations.sd / std::sqrt(static_cast<double>(over_operations.count)),
                       std::move(by_operation)};
}

std::optional<bool> Prediction::spread_agrees() const {
  if (!published.sd) {
    return std::nullopt;
  }
  return predicted.sd <= kSdFactor * *published.sd && *published.sd <= kSdFactor * predicted.sd;
}

std::vector<Prediction> predictions_of(const SystemProfile& system, const nlohmann::json& study) {
  struct Quantity {
    const char* name;
    const char* unit;
    const char* key;
    bool per_screw;
    std::optional<PublishedFigure> published;
  };
  const std::array<Quantity, 4> quantities = {
      {{"entry", "mm", "entry_error_mm", true, system.entry_mm},
       {"angle", "°", "angle_error_deg", true, system.angle_deg},
       {"RMSE", "mm", "rmse_mm", false, system.rmse_mm},
       {"TRE", "mm", "tre_mm", false, system.tre_mm}}};
  std::vector<Prediction> out;
  for (const Quantity& quantity : quantities) {
    const auto predicted = mean_over(study, quantity.key, quantity.per_screw);
    if (!quantity.published || !predicted) {
      continue;
    }
    Prediction p;
    p.quantity = quantity.name;
    p.unit = quantity.unit;
    p.published = *quantity.published;
    p.predicted = *predicted;
    p.assumed_error = !p.published.sd || !system.screws;
    p.screws = system.screws.value_or(quantity.per_screw ? kAssumedScrews
                                                         : kAssumedScrews / kScrewsPerRegistration);
    p.published_error = p.published.sd.value_or(kAssumedSd * p.published.mean) /
                        std::sqrt(static_cast<double>(p.screws));
    p.z = (p.predicted.mean - p.published.mean) /
          std::hypot(p.published_error, p.predicted.standard_error);
    test(p);
    out.push_back(std::move(p));
  }
  return out;
}

std::string system_table_heading() {
  return "| system | | published | n | predicted | screws | standard error | z | p, mean | p, SD | "
         "verdict |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string system_table_rows(const SystemProfile& system,
                              const std::vector<Prediction>& predictions) {
  std::string rows;
  for (const Prediction& p : predictions) {
    char numbers[128];
    std::snprintf(numbers, sizeof numbers, "%zu | %.2f%s | %+.1f | %.3f | ", p.predicted.values,
                  std::hypot(p.published_error, p.predicted.standard_error),
                  p.assumed_error ? " (assumed)" : "", p.z, p.mean_p);
    char of_sd[16] = "";
    if (p.sd_p) {
      std::snprintf(of_sd, sizeof of_sd, "%.3f", *p.sd_p);
    }
    const auto spread = p.spread_agrees();
    std::string verdict = system.fitted ? "fitted" : p.agrees() ? "mean predicted" : "mean missed";
    if (spread) {
      verdict += *spread ? ", SD too" : ", SD not";
    }
    rows += "| " + system.title + " | " + p.quantity + ", " + p.unit + " | " +
            mean_and_sd(p.published.mean, p.published.sd) + " | " + std::to_string(p.screws) +
            (system.screws ? "" : " (assumed)") + " | " +
            mean_and_sd(p.predicted.mean, p.predicted.sd) + " | " + numbers + of_sd + " | " +
            verdict + " |\n";
  }
  return rows;
}

}  // namespace orthonav::engine
