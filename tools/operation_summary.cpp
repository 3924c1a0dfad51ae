#include "tools/operation_summary.h"

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
  for (const engine::LevelOutcome& level : result.levels) {
    if (level.attempts == 0) {
      out += level.label + ": not registered\n";
      continue;
    }
    out += level.label + ": " + (level.accepted ? "accepted" : "not accepted") + " after " +
           how_many(level.attempts, "attempt") + part("RMSE", level.rmse_m, 1e3, " mm") +
           part("TRE", level.tre_m, 1e3, " mm") +
           (level.points ? ", " + how_many(*level.points, "point") : "") +
           part("digitized in", level.digitization_s, 1.0, " s") + "\n";
    for (const engine::ScrewOutcome& screw : level.screws) {
      if (screw.done) {
        out += "  " + std::string(name_of(screw.side)) + ": done" +
               part("angle error", screw.angle_error_rad, kDegreesPerRadian, "°") +
               part("entry error", screw.entry_error_m, 1e3, " mm") + "\n";
      }
    }
  }
  for (const engine::RodOutcome& rod : result.rods) {
    if (rod.length_m) {
      out += "rod " + std::string(name_of(rod.side)) + ": " + how_many(rod.heads, "head") +
             part("length", rod.length_m, 1e3, " mm") +
             part("length error", rod.length_error_m, 1e3, " mm") +
             part("head error", rod.head_error_m, 1e3, " mm") + "\n";
    }
  }
  out += how_many(result.loop.displayed, "frame") + " displayed\n";
  return out;
}

}  // namespace orthonav::tools
