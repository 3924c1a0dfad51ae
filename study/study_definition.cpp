#include "study/study_definition.h"

#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <sstream>
#include <utility>

#include "base/angle.h"
#include "engine/case/prepared_parts_file.h"
#include "engine/case/tool_file.h"
#include "hal/sim/magnitudes.h"
#include "study/left_out.h"
#include "study/stored_study.h"
#include "study/study_text.h"
#include "study/study_totals.h"

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

std::size_t planned_in(const Json& definition) {
  const bool whole = definition.is_object() && definition.contains("runs") &&
                     definition["runs"].is_number_unsigned() && definition.contains("cases") &&
                     definition["cases"].is_array() && definition.contains("method");
  return whole ? definition["runs"].get<std::size_t>() * definition["cases"].size() : 0;
}

/// `text` of a study without runs, with the runs of the files in their place.
Status write_merged(const std::string& text, std::span<const std::string> paths,
                    std::ostream& out) {
  constexpr std::string_view kRuns = "\n \"runs\": [";
  const std::size_t place = text.find(std::string(kRuns) + "]") + kRuns.size();
  out << text.substr(0, place);
  const char* before = "\n  ";
  const auto written = for_each_operation(paths, [&](const StoredOperation& operation) {
    if (operation.report.empty()) {
      return Status();
    }
    out << before;
    before = ",\n  ";
    for (const char c : text_of(Json::parse(operation.report))) {
      out << c << (c == '\n' ? "  " : "");
    }
    return out ? Status()
               : Status(Error{"study merge: what was joined cannot be written", ErrorCode::kIo});
  });
  if (!written) {
    return written.error();
  }
  out << (*before == ',' ? "\n " : "") << text.substr(place) << "\n" << std::flush;
  return out ? Status()
             : Status(Error{"study merge: what was joined cannot be written", ErrorCode::kIo});
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
  if (operation.sim.told_sd_factor != 1.0) {
    out["told_sd_factor"] = operation.sim.told_sd_factor;
  }
  if (operation.exposure) {
    out["exposure"] = static_cast<int>(*operation.exposure);
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

Status merge_stores(std::span<const std::string> paths, std::ostream& out) {
  StudyTotals totals;
  Json failed = Json::array();
  const auto definition = for_each_operation(paths, [&](const StoredOperation& operation) {
    if (!operation.report.empty()) {
      totals.add(Json::parse(operation.report));
    } else {
      failed.push_back(
          {{"case", operation.case_name}, {"seed", operation.seed}, {"why", operation.why}});
    }
    return Status();
  });
  if (!definition) {
    return definition.error();
  }
  const Json defined = Json::parse(*definition, nullptr, false);
  const std::size_t planned = planned_in(defined);
  if (planned == 0) {
    return Error{paths.front() + ": its definition is not one of a study"};
  }
  return write_merged(text_of(totals.study(defined["method"], Json::array(), failed, planned)),
                      paths, out);
}

Result<std::string> merge_stores(std::span<const std::string> paths) {
  std::ostringstream out;
  const Status merged = merge_stores(paths, out);
  return merged ? Result<std::string>(out.str()) : Result<std::string>(merged.error());
}

Result<std::vector<int>> missing_operations(const std::string& definition,
                                            std::span<const std::string> paths) {
  std::set<int> made;
  for (const std::string& path : paths) {
    const auto store = StudyStore::read(path);
    if (!store) {
      return store.error();
    }
    if (store->definition() != definition) {
      return Error{path + ": holds study " + study_hash(store->definition()) + ", this is " +
                   study_hash(definition)};
    }
    const auto numbers = store->numbers();
    if (!numbers) {
      return numbers.error();
    }
    made.insert(numbers->begin(), numbers->end());
  }
  std::vector<int> missing;
  const auto planned = static_cast<int>(planned_in(Json::parse(definition, nullptr, false)));
  for (int number = 0; number < planned; ++number) {
    if (!made.contains(number)) {
      missing.push_back(number);
    }
  }
  return missing;
}

}  // namespace orthonav::engine
