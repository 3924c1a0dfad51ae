#include "engine/study/study_text.h"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "engine/report/paper_table.h"
#include "engine/report/report_values.h"
#include "engine/study/clearance_statistics.h"
#include "engine/study/guided_statistics.h"
#include "engine/study/study_statistics.h"
#include "nav/evaluation/errors.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

/// The five rows of the table, each over every run that has a value for it.
Json table_of(const Json& runs) {
  const nlohmann::json reports(runs);
  Json table = Json::array();
  for (const PaperRow& row : kPaperTable) {
    std::vector<double> values;
    for (const nlohmann::json& report : reports) {
      const auto measured = values_of(report, row.key, row.per_screw);
      values.insert(values.end(), measured.begin(), measured.end());
    }
    const nav::Summary summary = nav::summarize(values);
    table.push_back(Json{{"name", row.name},
                         {"unit", row.unit},
                         {"count", summary.count},
                         {"mean", summary.mean},
                         {"sd", summary.sd},
                         {"min", summary.min},
                         {"max", summary.max},
                         {"paper_mean", row.mean},
                         {"paper_sd", row.sd}});
  }
  return table;
}

/// How the errors of accepted registrations lie in what was predicted of them.
Json registrations_of(const Json& runs) {
  const RegistrationQuality quality = registration_quality(runs);
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

std::string study_text(const std::string& method, const Json& runs, const Json& failed,
                       std::size_t planned) {
  int completed = 0;
  for (const Json& run : runs) {
    completed += run.value("completed", false) ? 1 : 0;
  }
  Json study{{"method", method},
             {"operations", runs.size()},
             {"completed", completed},
             {"table", table_of(runs)},
             {"registrations", registrations_of(runs)},
             {"clearance", clearance_quality_json(runs)}};
  if (nlohmann::ordered_json guided = guided_quality_json(runs); !guided.is_null()) {
    study["guided"] = std::move(guided);
  }
  study["runs"] = runs;
  if (!failed.empty()) {
    study["failed"] = failed;
  }
  if (runs.size() + failed.size() < planned) {
    study["incomplete"] = true;
    study["planned"] = planned;
  }
  return study.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace orthonav::engine
