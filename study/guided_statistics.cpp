#include "study/guided_statistics.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/report/operation_result.h"
#include "nav/evaluation/errors.h"
#include "study/study_statistics.h"

namespace orthonav::engine {
namespace {

using StudyPart = nlohmann::ordered_json;

StudyPart guided_series(const std::vector<double>& values) {
  const nav::Summary summary = nav::summarize(values);
  return {{"count", summary.count},
          {"mean", summary.mean},
          {"sd", summary.sd},
          {"p95", quantile(values, 0.95).value_or(0.0)}};
}

// Quantiles of a distance in two directions, in SDs: sqrt(-2 ln(1 - p)).
constexpr double k68 = 1.5096;
constexpr double k95 = 2.4477;

std::ptrdiff_t within(const std::vector<double>& sds, double limit) {
  return std::count_if(sds.begin(), sds.end(), [limit](double each) { return each <= limit; });
}

StudyPart guided_count(int hits, int of) {
  return {{"n", hits}, {"of", of}, {"upper_95", upper_limit_95(hits, of)}};
}

void add_screw(const StudyPart& screw, GuidedQuality& sum) {
  const bool warned = screw.value("warned", false);
  if (screw.contains("guided")) {
    const StudyPart& guided = screw["guided"];
    sum.across_mm.push_back(guided["across_mm"]);
    sum.tip_mm.push_back(guided["tip_mm"]);
    sum.angle_deg.push_back(guided["angle_deg"]);
    const bool sure = guided.value("sure", true);
    const bool unwarned = sum.across_mm.back() > GuidedQuality::kSilent_mm && !warned;
    sum.unwarned += unwarned ? 1 : 0;
    sum.silent += unwarned && sure ? 1 : 0;
    sum.unsure += sure ? 0 : 1;
    if (guided.contains("across_sds")) {
      sum.across_sds.push_back(guided["across_sds"]);
    }
  }
  if (screw.contains("clearance_mm")) {
    ++sum.executed;
    const bool breach = screw["clearance_mm"].get<double>() < 0.0;
    sum.breaches += breach ? 1 : 0;
    sum.unwarned_breaches += breach && !warned ? 1 : 0;
  }
}

}  // namespace

void add_run(const nlohmann::ordered_json& run, GuidedQuality& sum) {
  for (const auto& level : run["levels"]) {
    for (const auto& screw : level.value("screws", StudyPart::array())) {
      add_screw(screw, sum);
    }
  }
}

nlohmann::ordered_json guided_json(const GuidedQuality& quality) {
  if (quality.across_mm.empty()) {
    return nullptr;
  }
  const int guides = static_cast<int>(quality.across_mm.size());
  StudyPart silent = guided_count(quality.silent, guides);
  silent["over_mm"] = GuidedQuality::kSilent_mm;
  StudyPart breaches = guided_count(quality.unwarned_breaches, quality.executed);
  breaches["breaches"] = quality.breaches;
  return {{"across_mm", guided_series(quality.across_mm)},
          {"tip_mm", guided_series(quality.tip_mm)},
          {"angle_deg", guided_series(quality.angle_deg)},
          {"silent_failures", silent},
          {"far_off_without_warning", guided_count(quality.unwarned, guides)},
          {"shown_unsure", guided_count(quality.unsure, guides)},
          {"within_shown_sds",
           {{"of", quality.across_sds.size()},
            {"in_68", within(quality.across_sds, k68)},
            {"in_95", within(quality.across_sds, k95)}}},
          {"unwarned_breaches", breaches}};
}

}  // namespace orthonav::engine
