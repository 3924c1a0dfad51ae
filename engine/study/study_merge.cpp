#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "engine/study/study.h"
#include "engine/study/study_text.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

Status check_run(const Json& run, const std::string& name) {
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
  for (const Json& level : run["levels"]) {
    if (!level.is_object()) {
      return Error{name + ": a level of a run is no object"};
    }
  }
  return {};
}

Status append_runs(const std::string& text, const std::string& name, std::string& method,
                   std::set<std::pair<std::string, std::uint64_t>>& seen, Json& runs, Json& failed,
                   std::size_t& planned) {
  const Json study = Json::parse(text, nullptr, false);
  if (study.is_discarded() || !study.is_object() || !study.contains("runs") ||
      !study["runs"].is_array() || !study.contains("method") || !study["method"].is_string()) {
    return Error{name + ": is no study (an object with method and runs)"};
  }
  const std::string here = study["method"];
  if (!method.empty() && method != here) {
    return Error{name + ": method '" + here + "', the others have '" + method + "'"};
  }
  method = here;
  for (const Json& run : study["runs"]) {
    if (const Status good = check_run(run, name); !good) {
      return good;
    }
    const std::pair key(run["case"].get<std::string>(), run["seed"].get<std::uint64_t>());
    if (!seen.insert(key).second) {
      return Error{name + ": case '" + key.first + "' with seed " + std::to_string(key.second) +
                   " occurs twice"};
    }
    runs.push_back(run);
  }
  if (study.contains("failed") && study["failed"].is_array()) {
    for (const Json& run : study["failed"]) {
      failed.push_back(run);
    }
  }
  const std::size_t here_planned =
      study.contains("planned") && study["planned"].is_number_unsigned()
          ? study["planned"].get<std::size_t>()
          : 0;
  planned +=
      std::max(here_planned, study["runs"].size() + study.value("failed", Json::array()).size());
  return {};
}

}  // namespace

Result<std::string> merge_studies(std::span<const std::string> texts,
                                  std::span<const std::string> names) {
  std::string method;
  std::set<std::pair<std::string, std::uint64_t>> seen;
  Json runs = Json::array();
  Json failed = Json::array();
  std::size_t planned = 0;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (const Status read = append_runs(texts[i], names[i], method, seen, runs, failed, planned);
        !read) {
      return read.error();
    }
  }
  std::stable_sort(runs.begin(), runs.end(), [](const Json& a, const Json& b) {
    const auto key = [](const Json& run) {
      return std::pair(run["case"].get<std::string>(), run["seed"].get<std::uint64_t>());
    };
    return key(a) < key(b);
  });
  return study_text(method, runs, failed, planned);
}

}  // namespace orthonav::engine
