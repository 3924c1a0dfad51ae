#include "study/clearance_statistics.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace orthonav::engine {
namespace {

using ReportPart = nlohmann::ordered_json;

std::optional<double> bound_of(const ReportPart& screw, const char* which) {
  if (!screw.contains(which) || !screw[which].contains("clearance_95_mm")) {
    return std::nullopt;
  }
  return screw[which]["clearance_95_mm"].get<double>();
}

void count(const ReportPart& screw, const char* which, ClearanceQuality::Bound& bound) {
  if (const auto bound_mm = bound_of(screw, which)) {
    ++bound.screws;
    bound.held += screw["clearance_mm"].get<double>() > *bound_mm ? 1 : 0;
  }
}

/// The likeliest grade, A to E; of two equally likely ones the better.
std::size_t likeliest_of(const ReportPart& probabilities) {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t g = 0; g < nav::kPedicleGrades; ++g) {
    const double p = probabilities.value(nav::name_of(static_cast<nav::PedicleGrade>(g)), 0.0);
    if (p > most) {
      most = p, best = g;
    }
  }
  return best;
}

ReportPart bound_json(const ClearanceQuality::Bound& bound) {
  return {{"screws", bound.screws}, {"held", bound.held}, {"share", bound.fraction()}};
}

}  // namespace

void add_run(const nlohmann::ordered_json& run, ClearanceQuality& sum) {
  for (const auto& level : run["levels"]) {
    if (!level.contains("screws")) {
      continue;
    }
    for (const auto& screw : level["screws"]) {
      if (!screw.contains("clearance_mm")) {
        continue;
      }
      count(screw, "planned", sum.planned);
      count(screw, "tracked", sum.tracked);
      if (bound_of(screw, "tracked")) {
        const auto truth =
            static_cast<std::size_t>(nav::grade_of(screw["clearance_mm"].get<double>() * 1e-3));
        ++sum.grades[likeliest_of(screw["tracked"]["grade_probability"])][truth];
      }
    }
  }
}

nlohmann::ordered_json clearance_json(const ClearanceQuality& quality) {
  ReportPart table = ReportPart::object();
  for (std::size_t g = 0; g < nav::kPedicleGrades; ++g) {
    table[nav::name_of(static_cast<nav::PedicleGrade>(g))] = quality.grades[g];
  }
  return {{"scale", nav::kPedicleScale},
          {"planned_bound", bound_json(quality.planned)},
          {"tracked_bound", bound_json(quality.tracked)},
          {"true_grades_by_likeliest", table}};
}

}  // namespace orthonav::engine
