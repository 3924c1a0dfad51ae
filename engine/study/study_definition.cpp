#include "engine/study/study_definition.h"

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/angle.h"
#include "engine/case/prepared_parts_file.h"
#include "engine/case/tool_file.h"
#include "engine/study/left_out.h"
#include "engine/study/study_store.h"
#include "engine/study/study_text.h"
#include "hal/sim/magnitudes.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

Json case_json(const Case& source) {
  Json levels = Json::array();
  for (const CaseLevel& level : source.levels) {
    const MeshKey key = MeshKey::of(level.mesh);
    levels.push_back({{"label", level.label}, {"mesh", key.text()}});
  }
  return {{"name", source.name}, {"levels", levels}};
}

/// The operations of all files by their numbers.
Result<std::map<int, StoredOperation>> joined_operations(std::span<const std::string> paths,
                                                         std::string& definition) {
  std::map<int, StoredOperation> all;
  for (const std::string& path : paths) {
    const auto store = StudyStore::read(path);
    if (!store) {
      return store.error();
    }
    if (!definition.empty() && definition != store->definition()) {
      return Error{path + ": holds study " + study_hash(store->definition()) +
                   ", the others hold " + study_hash(definition)};
    }
    definition = store->definition();
    auto operations = store->operations();
    if (!operations) {
      return operations.error();
    }
    for (StoredOperation& operation : *operations) {
      const auto [there, added] = all.try_emplace(operation.index, operation);
      if (!added && there->second.report != operation.report) {
        return Error{path + ": operation " + std::to_string(operation.index) +
                     " has another result than in the other files"};
      }
    }
  }
  return all;
}

std::size_t planned_in(const Json& definition) {
  const bool whole = definition.is_object() && definition.contains("runs") &&
                     definition["runs"].is_number_unsigned() && definition.contains("cases") &&
                     definition["cases"].is_array() && definition.contains("method");
  return whole ? definition["runs"].get<std::size_t>() * definition["cases"].size() : 0;
}

}  // namespace

std::string method_label(const OperationOptions& operation) {
  if (operation.navigation) {
    return "stated";
  }
  const std::string without = left_out_of(operation);
  return operation.method + (operation.use_reference ? " with reference" : "") +
         (without.empty() ? "" : " without " + without);
}

std::string definition_of(std::span<const Case> cases, const StudyOptions& options) {
  const OperationOptions& operation = options.operation;
  Json magnitudes = Json::object();
  for (const sim::Magnitude& magnitude : sim::magnitudes()) {
    magnitudes[std::string(magnitude.name)] = operation.sim.error_model.*magnitude.value;
  }
  Json out{{"version", options.version},
           {"method", method_label(operation)},
           {"measurement", operation.measurement == Measurement::kPixels ? "pixels" : "model"},
           {"guidance", static_cast<int>(operation.sim.guidance)},
           {"reference", operation.use_reference},
           {"levels", operation.levels},
           {"runs", static_cast<std::size_t>(options.runs)},
           {"first_seed", options.first_seed},
           {"magnitudes", magnitudes}};
  if (operation.exposure != sim::Exposure::kLaminae) {
    out["exposure"] = static_cast<int>(operation.exposure);
  }
  if (!operation.left_out.empty()) {
    out["left_out"] = operation.left_out;
  }
  if (const std::string tools = tools_text(operation.tools);
      tools != tools_text(built_in_tools())) {
    out["tools"] = tools;
  }
  if (operation.navigation) {
    out["navigation"] = {{"target_mm", operation.navigation->target_m * 1e3},
                         {"angle_deg", operation.navigation->angle_rad / kRadiansPerDegree}};
  }
  out["cases"] = Json::array();
  for (const Case& source : cases) {
    out["cases"].push_back(case_json(source));
  }
  return out.dump();
}

Result<std::string> merge_stores(std::span<const std::string> paths) {
  std::string definition;
  const auto operations = joined_operations(paths, definition);
  if (!operations) {
    return operations.error();
  }
  const Json defined = Json::parse(definition, nullptr, false);
  const std::size_t planned = planned_in(defined);
  if (planned == 0) {
    return Error{paths.front() + ": its definition is not one of a study"};
  }
  Json runs = Json::array();
  Json failed = Json::array();
  for (const auto& [number, operation] : *operations) {
    if (!operation.report.empty()) {
      runs.push_back(Json::parse(operation.report));
    } else {
      failed.push_back(
          {{"case", operation.case_name}, {"seed", operation.seed}, {"why", operation.why}});
    }
  }
  return study_text(defined["method"], runs, failed, planned);
}

Result<std::vector<int>> missing_operations(const std::string& definition,
                                            std::span<const std::string> paths) {
  std::string found = definition;
  const auto operations = joined_operations(paths, found);
  if (!operations) {
    return operations.error();
  }
  std::vector<int> missing;
  const auto planned = static_cast<int>(planned_in(Json::parse(definition, nullptr, false)));
  for (int number = 0; number < planned; ++number) {
    if (!operations->contains(number)) {
      missing.push_back(number);
    }
  }
  return missing;
}

}  // namespace orthonav::engine
