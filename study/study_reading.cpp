#include "study/study_reading.h"

#include <nlohmann/json.hpp>

namespace orthonav::engine {
namespace {

Status check_run(const nlohmann::ordered_json& run, const std::string& name) {
  const bool whole = run.is_object() && run.contains("case") && run["case"].is_string() &&
                     run.contains("seed") && run["seed"].is_number_unsigned() &&
                     run.contains("levels") && run["levels"].is_array();
  if (!whole) {
    return Error{name + ": a run lacks case, seed or levels"};
  }
  if (run.contains("completed") && !run["completed"].is_boolean()) {
    return Error{name + ": completed of a run is " + run["completed"].dump() +
                 ", must be true or false"};
  }
  for (const nlohmann::ordered_json& level : run["levels"]) {
    if (!level.is_object()) {
      return Error{name + ": a level of a run is not an object"};
    }
  }
  return {};
}

}  // namespace

Result<nlohmann::ordered_json> parse_study(const std::string& text, const std::string& name) {
  nlohmann::ordered_json study = nlohmann::ordered_json::parse(text, nullptr, false);
  if (study.is_discarded() || !study.is_object() || !study.contains("runs") ||
      !study["runs"].is_array() || !study.contains("method") || !study["method"].is_string()) {
    return Error{name + ": is not a study (an object with method and runs)"};
  }
  for (const nlohmann::ordered_json& run : study["runs"]) {
    if (const Status good = check_run(run, name); !good) {
      return good.error();
    }
  }
  return study;
}

}  // namespace orthonav::engine
