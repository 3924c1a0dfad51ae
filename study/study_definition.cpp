#include "study/study_definition.h"

#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/case/tool_file.h"
#include "hal/sim/magnitudes.h"
#include "study/left_out.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

Json case_json(const Case& source) {
  Json levels = Json::array();
  for (const CaseLevel& level : source.levels) {
    BitHash mesh;
    add(mesh, level.mesh);
    levels.push_back({{"label", level.label}, {"mesh", mesh.text()}});
  }
  return {{"name", source.name}, {"levels", levels}};
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

}  // namespace orthonav::engine
