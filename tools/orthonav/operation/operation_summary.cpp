#include "tools/orthonav/operation/operation_summary.h"

#include "base/angle.h"
#include "base/how_many.h"
#include "base/printed.h"

namespace orthonav::tools {
namespace {

/// ", RMSE 1.60 mm"; nothing where there is no value.
std::string part(const char* what, const std::optional<double>& value, double scale,
                 const char* unit) {
  return value ? std::string(", ") + what + printed(" %.2f%s", *value * scale, unit) : "";
}

}  // namespace

std::string operation_summary(const engine::OperationResult& result) {
  std::string out = "case " + result.case_name + ", method " + result.method +
                    (result.seed ? ", seed " + std::to_string(*result.seed) : "") +
                    (result.completed ? ": completed\n" : ": incomplete\n");
  if (!result.why_not.empty()) {
    out += result.why_not + "\n";
  }
  for (std::size_t l = 0; l < result.state.levels.size(); ++l) {
    const engine::LevelState& level = result.state.levels[l];
    const engine::LevelTruth& truth = result.truth.levels[l];
    if (level.attempts == 0) {
      out += level.plan.label + ": not registered\n";
      continue;
    }
    out += level.plan.label + ": " + (level.accepted ? "accepted" : "not accepted") + " after " +
           how_many(level.attempts, "attempt");
    if (level.registration) {
      out += part("RMSE", level.registration->rmse_m, 1e3, " mm") +
             part("TRE", truth.tre_m, 1e3, " mm") + ", " +
             how_many(level.registration->points, "point") +
             part("digitized in", level.digitization_s, 1.0, " s");
    }
    out += "\n";
    for (std::size_t s = 0; s < level.screws.size(); ++s) {
      if (level.screws[s].done) {
        const engine::ScrewTruth& screw = truth.screws[s];
        out += "  " + std::string(name_of(level.plan.screws[s].side)) + ": done" +
               (screw.known ? part("angle error", screw.angle_error_rad, kDegreesPerRadian, "°")
                            : "") +
               part("entry error", screw.entry_error_m, 1e3, " mm") + "\n";
      }
    }
  }
  for (std::size_t i = 0; i < result.state.rods.size(); ++i) {
    const engine::RodState& rod = result.state.rods[i];
    const engine::RodTruth& truth = result.truth.rods[i];
    if (rod.rod) {
      out += "rod " + std::string(name_of(rod.side)) + ": " + how_many(rod.heads.size(), "head") +
             part("length", rod.rod->length_m, 1e3, " mm") +
             part("length error", truth.length_error_m, 1e3, " mm") +
             part("head error", truth.head_error_m, 1e3, " mm") + "\n";
    }
  }
  out += how_many(result.loop.displayed, "frame") + " displayed\n";
  return out;
}

}  // namespace orthonav::tools
