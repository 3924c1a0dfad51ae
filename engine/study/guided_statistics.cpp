#include "engine/study/guided_statistics.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "engine/report/operation_result.h"
#include "engine/study/study_statistics.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

using StudyPart = nlohmann::ordered_json;

StudyPart series(const std::vector<double>& values) {
  const nav::Summary summary = nav::summarize(values);
  return {{"count", summary.count},
          {"mean", summary.mean},
          {"sd", summary.sd},
          {"p95", quantile(values, 0.95).value_or(0.0)}};
}

StudyPart counted(int hits, int of) {
  return {{"n", hits}, {"of", of}, {"upper_95", upper_limit_95(hits, of)}};
}

/// What is counted over the screws.
struct Tally {
  std::vector<double> across_mm;
  std::vector<double> tip_mm;
  std::vector<double> angle_deg;
  int silent = 0;
  int executed = 0;
  int breaches = 0;
  int unwarned_breaches = 0;

  void add(const StudyPart& screw) {
    const bool warned = screw.value("warned", false);
    if (screw.contains("guided")) {
      const StudyPart& guided = screw["guided"];
      across_mm.push_back(guided["across_mm"]);
      tip_mm.push_back(guided["tip_mm"]);
      angle_deg.push_back(guided["angle_deg"]);
      silent += across_mm.back() > kSilent_mm && !warned ? 1 : 0;
    }
    if (screw.contains("clearance_mm")) {
      ++executed;
      const bool breach = screw["clearance_mm"].get<double>() < 0.0;
      breaches += breach ? 1 : 0;
      unwarned_breaches += breach && !warned ? 1 : 0;
    }
  }
};

}  // namespace

nlohmann::ordered_json guided_quality_json(const nlohmann::ordered_json& runs) {
  Tally tally;
  for (const auto& run : runs) {
    for (const auto& level : run["levels"]) {
      for (const auto& screw : level.value("screws", StudyPart::array())) {
        tally.add(screw);
      }
    }
  }
  if (tally.across_mm.empty()) {
    return nullptr;
  }
  StudyPart silent = counted(tally.silent, static_cast<int>(tally.across_mm.size()));
  silent["over_mm"] = kSilent_mm;
  StudyPart breaches = counted(tally.unwarned_breaches, tally.executed);
  breaches["breaches"] = tally.breaches;
  return {{"across_mm", series(tally.across_mm)},
          {"tip_mm", series(tally.tip_mm)},
          {"angle_deg", series(tally.angle_deg)},
          {"silent_failures", silent},
          {"unwarned_breaches", breaches}};
}

}  // namespace orthonav::engine
