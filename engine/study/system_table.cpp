#include "engine/study/system_table.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/report/report_values.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

/// Where a publication gives no SD, half of the mean; where it gives no number of screws, twenty.
constexpr double kAssumedSd = 0.5;
constexpr int kAssumedScrews = 20;
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

}  // namespace

std::optional<ClusteredMean> mean_over(const nlohmann::json& study, std::string_view key,
                                       bool per_screw) {
  if (!study.is_object() || !study.contains("runs")) {
    return std::nullopt;
  }
  std::vector<double> all;
  std::vector<double> of_operations;
  for (const nlohmann::json& run : study["runs"]) {
    const std::vector<double> values = values_of(run, key, per_screw);
    if (!values.empty()) {
      of_operations.push_back(nav::summarize(values).mean);
      all.insert(all.end(), values.begin(), values.end());
    }
  }
  if (all.empty()) {
    return std::nullopt;
  }
  const nav::Summary over_all = nav::summarize(all);
  const nav::Summary over_operations = nav::summarize(of_operations);
  return ClusteredMean{over_all.count, over_operations.count, over_all.mean, over_all.sd,
                       over_operations.sd / std::sqrt(static_cast<double>(over_operations.count))};
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
  const std::array<Quantity, 3> quantities = {
      {{"entry", "mm", "entry_error_mm", true, system.entry_mm},
       {"angle", "°", "angle_error_deg", true, system.angle_deg},
       {"RMSE", "mm", "rmse_mm", false, system.rmse_mm}}};
  std::vector<Prediction> out;
  for (const Quantity& quantity : quantities) {
    const auto predicted = mean_over(study, quantity.key, quantity.per_screw);
    if (!quantity.published || !predicted) {
      continue;
    }
    Prediction p{quantity.name, quantity.unit, *quantity.published, 0.0, false, *predicted, 0.0};
    p.assumed_error = !p.published.sd || !system.screws;
    p.published_error = p.published.sd.value_or(kAssumedSd * p.published.mean) /
                        std::sqrt(static_cast<double>(system.screws.value_or(kAssumedScrews)));
    p.z = (p.predicted.mean - p.published.mean) /
          std::hypot(p.published_error, p.predicted.standard_error);
    out.push_back(p);
  }
  return out;
}

std::string system_table_heading() {
  return "| system | | published | predicted | screws | standard error | z | verdict |\n"
         "|---|---|---|---|---|---|---|---|\n";
}

std::string system_table_rows(const SystemProfile& system,
                              const std::vector<Prediction>& predictions) {
  std::string rows;
  for (const Prediction& p : predictions) {
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "%zu | %.2f%s | %+.1f", p.predicted.values,
                  std::hypot(p.published_error, p.predicted.standard_error),
                  p.assumed_error ? " (assumed)" : "", p.z);
    const auto spread = p.spread_agrees();
    std::string verdict = system.fitted ? "fitted" : p.agrees() ? "mean predicted" : "mean missed";
    if (spread) {
      verdict += *spread ? ", SD too" : ", SD not";
    }
    rows += "| " + system.title + " | " + p.quantity + ", " + p.unit + " | " +
            mean_and_sd(p.published.mean, p.published.sd) + " | " +
            mean_and_sd(p.predicted.mean, p.predicted.sd) + " | " + numbers + " | " + verdict +
            " |\n";
  }
  return rows;
}

}  // namespace orthonav::engine
