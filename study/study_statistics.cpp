#include "study/study_statistics.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/vec.h"
#include "engine/report/report_values.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

/// Quantiles of chi squared with three degrees of freedom.
constexpr double kChi68 = 3.5059;
constexpr double kChi95 = 7.8147;

/// The covariances of a level's entries and targets, in the order of its errors.
std::vector<Mat3> covariances_of(const nlohmann::ordered_json& level) {
  std::vector<Mat3> out;
  if (!level.contains("registration") || !level["registration"].contains("screws")) {
    return out;
  }
  for (const auto& screw : level["registration"]["screws"]) {
    for (const char* key : {"entry_covariance_mm2", "target_covariance_mm2"}) {
      if (!screw.contains(key) || !screw[key].is_array() || screw[key].size() != 3) {
        return {};
      }
      Mat3 covariance;
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t c = 0; c < 3; ++c) {
          covariance.m[r][c] = screw[key][r][c];
        }
      }
      out.push_back(covariance);
    }
  }
  return out;
}

/// eᵀ·C⁻¹·e: with the rows of C, the columns of its inverse are their cross products over det C.
double mahalanobis_squared(const Mat3& covariance, Vec3 error) {
  const Vec3 a = covariance.row(0);
  const Vec3 b = covariance.row(1);
  const Vec3 c = covariance.row(2);
  const Vec3 scaled = b.cross(c) * error.x + c.cross(a) * error.y + a.cross(b) * error.z;
  return error.dot(scaled) / a.dot(b.cross(c));
}

std::vector<Vec3> errors_of(const nlohmann::ordered_json& level) {
  std::vector<Vec3> out;
  if (!level.contains("errors_mm")) {
    return out;
  }
  for (const auto& error : level["errors_mm"]) {
    out.push_back({error[0].get<double>(), error[1].get<double>(), error[2].get<double>()});
  }
  return out;
}

double probability_of_at_most(int hits, int of, double p) {
  double term = std::exp(of * std::log1p(-p));
  double sum = term;
  for (int k = 1; k <= hits; ++k) {
    term *= static_cast<double>(of - k + 1) / k * p / (1.0 - p);
    sum += term;
  }
  return sum;
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

double upper_limit_95(int hits, int of) {
  if (hits >= of) {
    return 1.0;
  }
  double low = 0.0;
  double high = 1.0;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (probability_of_at_most(hits, of, middle) > 0.05 ? low : high) = middle;
  }
  return high;
}

void add_run(const nlohmann::ordered_json& run, RegistrationCounts& counts) {
  for (const auto& level : run["levels"]) {
    const auto errors = errors_of(level);
    if (!level.value("accepted", false) || errors.empty()) {
      continue;
    }
    ++counts.levels;
    const auto covariances = covariances_of(level);
    double worst_mm = 0.0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      worst_mm = std::max(worst_mm, errors[i].norm());
      if (covariances.size() != errors.size()) {
        continue;
      }
      const double squared = mahalanobis_squared(covariances[i], errors[i]);
      ++counts.places;
      counts.in_68 += squared <= kChi68 ? 1 : 0;
      counts.in_95 += squared <= kChi95 ? 1 : 0;
    }
    counts.silent += worst_mm * 1e-3 > RegistrationQuality::kSilent_m ? 1 : 0;
  }
}

RegistrationQuality RegistrationCounts::quality() const {
  RegistrationQuality out;
  out.levels = levels;
  out.places = places;
  out.silent = silent;
  if (places > 0) {
    out.within_68 = static_cast<double>(in_68) / places;
    out.within_95 = static_cast<double>(in_95) / places;
  }
  out.silent_upper_95 = upper_limit_95(silent, levels);
  return out;
}

}  // namespace orthonav::engine
