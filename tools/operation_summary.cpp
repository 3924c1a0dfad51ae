#include "tools/operation_summary.h"

#include "base/angle.h"
#include "base/how_many.h"
#include "base/printed.h"

namespace orthonav::tools {
namespace {

std::string number(const std::optional<double>& value, double scale, const char* unit) {
  if (!value) {
    return "-";
  }
  return printed("%.2f%s", *value * scale, unit);
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
           how_many(level.attempts, "attempt") + ", RMSE " + number(level.rmse_m, 1e3, " mm") +
           ", TRE " + number(level.tre_m, 1e3, " mm") + ", " +
           (level.points ? std::to_string(*level.points) : "-") + " points in " +
           number(level.digitization_s, 1.0, " s") + "\n";
    for (const engine::ScrewOutcome& screw : level.screws) {
      out += "  " + std::string(name_of(screw.side)) + ": angle error " +
             number(screw.angle_error_rad, kDegreesPerRadian, "°") + ", entry error " +
             number(screw.entry_error_m, 1e3, " mm") + "\n";
    }
  }
  for (const engine::RodOutcome& rod : result.rods) {
    out += "rod " + std::string(name_of(rod.side)) + ": length " +
           number(rod.length_m, 1e3, " mm") + ", length error " +
           number(rod.length_error_m, 1e3, " mm") + ", head error " +
           number(rod.head_error_m, 1e3, " mm") + "\n";
  }
  out += how_many(result.loop.displayed, "frame") + " displayed\n";
  return out;
}

}  // namespace orthonav::tools
