#include "study/study_totals.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "engine/report/report_values.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

Json row_json(const PaperRow& row, const std::vector<double>& values) {
  const nav::Summary summary = nav::summarize(values);
  return {{"name", row.name},     {"unit", row.unit},       {"count", summary.count},
          {"mean", summary.mean}, {"sd", summary.sd},       {"min", summary.min},
          {"max", summary.max},   {"paper_mean", row.mean}, {"paper_sd", row.sd}};
}

/// How the errors of accepted registrations compare with their predictions.
Json registrations_json(const RegistrationQuality& quality) {
  return {{"levels", quality.levels},
          {"coverage",
           {{"68", quality.within_68}, {"95", quality.within_95}, {"places", quality.places}}},
          {"silent_failures",
           {{"n", quality.silent},
            {"of", quality.levels},
            {"over_mm", RegistrationQuality::kSilent_m * 1e3},
            {"upper_95", quality.silent_upper_95}}}};
}

}  // namespace

void StudyTotals::add(const Json& run) {
  ++runs_;
  completed_ += run.value("completed", false) ? 1 : 0;
  const nlohmann::json report(run);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const auto measured = values_of(report, kPaperTable[row].key, kPaperTable[row].per_screw);
    rows_[row].insert(rows_[row].end(), measured.begin(), measured.end());
  }
  add_run(run, registrations_);
  add_run(run, clearance_);
  add_run(run, guided_);
}

Json StudyTotals::study(const std::string& method, const Json& runs, const Json& failed,
                        std::size_t planned) const {
  Json table = Json::array();
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    table.push_back(row_json(kPaperTable[row], rows_[row]));
  }
  Json study{{"method", method},
             {"operations", runs_},
             {"completed", completed_},
             {"table", table},
             {"registrations", registrations_json(registrations_.quality())},
             {"clearance", clearance_json(clearance_)}};
  if (Json guided = guided_json(guided_); !guided.is_null()) {
    study["guided"] = std::move(guided);
  }
  study["runs"] = runs;
  if (!failed.empty()) {
    study["failed"] = failed;
  }
  if (runs_ + failed.size() < planned) {
    study["incomplete"] = true;
    study["planned"] = planned;
  }
  return study;
}

}  // namespace orthonav::engine
