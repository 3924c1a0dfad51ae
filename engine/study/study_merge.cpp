#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "engine/study/study.h"
#include "engine/study/study_reading.h"
#include "engine/study/study_text.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

Status append_runs(const std::string& text, const std::string& name, std::string& method,
                   std::set<std::pair<std::string, std::uint64_t>>& seen, Json& runs, Json& failed,
                   std::size_t& planned) {
  const auto parsed = parse_study(text, name);
  if (!parsed) {
    return parsed.error();
  }
  const Json& study = *parsed;
  const std::string here = study["method"];
  if (!method.empty() && method != here) {
    return Error{name + ": method '" + here + "', the others have '" + method + "'"};
  }
  method = here;
  for (const Json& run : study["runs"]) {
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
