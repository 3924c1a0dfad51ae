#include <cmath>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/report/clearance_figures.h"
#include "engine/report/figures_json.h"
#include "engine/report/operation_result.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

void put_mm(Json& object, const char* key, const std::optional<double>& metres) {
  if (metres) {
    object[key] = *metres * 1e3;
  }
}

void put_quantile(Json& object, const char* key, const Histogram& values, double fraction) {
  if (const auto value = values.quantile(fraction)) {
    object[key] = *value;
  }
}

/// Nothing if no measurement was asked for.
void put_wire(Json& out, const ScrewOutcome& screw) {
  if (!screw.wire.asked) {
    return;
  }
  if (const auto& wire = screw.wire.measured) {
    out["wire"] = Json{{"angle_deg", degrees(wire->axis.angle_rad.value)},
                       {"angle_sd_deg", degrees(wire->axis.angle_rad.sd)},
                       {"entry_mm", wire->axis.entry_m.value * 1e3},
                       {"entry_sd_mm", wire->axis.entry_m.sd * 1e3},
                       {"within", wire->within()},
                       {"kept", wire->kept}};
  } else {
    out["wire"] = "not measured";
  }
  out["redone"] = screw.redone;
}

/// The guide's errors, known only where there is a ground truth.
void put_guided(Json& out, const ScrewOutcome& screw) {
  if (screw.preoperative_angle_error_rad) {
    out["preoperative_angle_error_deg"] = degrees(*screw.preoperative_angle_error_rad);
  }
  put_mm(out, "preoperative_entry_error_mm", screw.preoperative_entry_error_m);
  if (screw.guided) {
    Json& guided = out["guided"];
    guided = Json{{"tip_mm", screw.guided->tip_m * 1e3},
                  {"across_mm", screw.guided->across_m * 1e3},
                  {"angle_deg", degrees(screw.guided->angle_rad)},
                  {"sure", screw.guided->sure}};
    if (screw.guided->across_sds) {
      guided["across_sds"] = *screw.guided->across_sds;
    }
  }
  if (screw.guided || screw.executed) {
    out["warned"] = screw.warned();
  }
}

Json screw_json(const ScrewOutcome& screw) {
  Json out{{"side", name_of(screw.side)}, {"done", screw.done}};
  if (screw.angle_error_rad) {
    out["angle_error_deg"] = degrees(*screw.angle_error_rad);
  }
  put_mm(out, "entry_error_mm", screw.entry_error_m);
  put_guided(out, screw);
  put_planned_in_surgery(out, screw.planned_in_surgery);
  put_clearance(out, screw);
  if (screw.done) {
    put_executed(out, screw.trajectory, screw.tracked);
  }
  put_wire(out, screw);
  return out;
}

Json level_json(const LevelOutcome& level) {
  Json out{{"label", level.label}, {"accepted", level.accepted}, {"attempts", level.attempts}};
  put_mm(out, "rmse_mm", level.rmse_m);
  put_mm(out, "tre_mm", level.tre_m);
  for (const Vec3& error : level.errors_m) {
    out["errors_mm"].push_back({error.x * 1e3, error.y * 1e3, error.z * 1e3});
  }
  put_mm(out, "predicted_tre_mm", level.predicted_tre_m);
  if (level.predicted_tre_m) {
    out["registration_only"] = level.registration_only;
  }
  if (level.points) {
    out["points"] = *level.points;
  }
  if (level.digitization_s) {
    out["digitization_s"] = *level.digitization_s;
  }
  for (const double distance : level.check_points_m) {
    out["check_points_mm"].push_back(distance * 1e3);
  }
  if (level.registered) {
    out["registration"] = registration_json(*level.registered, {});
  }
  out["screws"] = Json::array();
  for (const ScrewOutcome& screw : level.screws) {
    out["screws"].push_back(screw_json(screw));
  }
  return out;
}

Json one_rod_json(const RodOutcome& rod) {
  Json out{{"side", name_of(rod.side)}, {"heads", rod.heads}};
  put_mm(out, "length_mm", rod.length_m);
  put_mm(out, "length_error_mm", rod.length_error_m);
  put_mm(out, "head_error_mm", rod.head_error_m);
  if (rod.took_s) {
    out["time_s"] = *rod.took_s;
  }
  if (!rod.no_instructions.empty()) {
    out["no_instructions"] = rod.no_instructions;
  }
  if (rod.instructions) {
    out["cut_length_mm"] = rod.instructions->cut_length_m() * 1e3;
    put_mm(out, "seat_by_pointer_mm", rod.seat_by_pointer_m);
    out["instructions"] = Json::array();
    for (const nav::RodInstruction& bend : rod.instructions->bends) {
      out["instructions"].push_back(Json{{"arc_length_mm", bend.arc.centre_m * 1e3},
                                         {"roll_deg", degrees(bend.arc.roll_rad)},
                                         {"angle_deg", degrees(bend.arc.angle_rad)},
                                         {"set_deg", degrees(bend.set_rad)}});
    }
  }
  return out;
}

/// Each rod in `sides`, and the first one that has a template also by itself. Empty where no rod
/// was planned.
Json rods_json(const std::vector<RodOutcome>& rods) {
  Json out = Json::object();
  Json sides = Json::array();
  for (const RodOutcome& rod : rods) {
    sides.push_back(one_rod_json(rod));
    if (out.empty() && rod.length_m) {
      out = sides.back();
      out.erase("measured");
      out.erase("instructions");
    }
  }
  if (!sides.empty()) {
    out["sides"] = std::move(sides);
  }
  return out;
}

Json series(const Histogram& values) {
  Json out{{"count", values.count()}};
  put_quantile(out, "median_ms", values, 0.5);
  put_quantile(out, "p95_ms", values, 0.95);
  put_quantile(out, "p99_ms", values, 0.99);
  put_quantile(out, "max_ms", values, 1.0);
  return out;
}

std::string dumped(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

Json report_of(const OperationResult& result) {
  Json out{{"method", result.method}};
  if (result.seed) {
    out["seed"] = *result.seed;
  }
  out["case"] = result.case_name;
  if (!result.instrument.empty()) {
    out["instrument"] = result.instrument;
  }
  if (result.patient_reference) {
    out["patient_reference"] = true;
  }
  if (result.errors) {
    out["common_errors"] = errors_json(*result.errors);
  }
  out["completed"] = result.completed;
  if (!result.why_not.empty()) {
    out["why_not"] = result.why_not;
  }
  if (result.calibration) {
    out["calibration"] = calibration_json(*result.calibration);
  }
  out["levels"] = Json::array();
  for (const LevelOutcome& level : result.levels) {
    out["levels"].push_back(level_json(level));
  }
  out["rod"] = rods_json(result.rods);
  if (result.recorded) {
    out["recording"] =
        Json{{"pairs_received", result.recorded->received}, {"pairs_lost", result.recorded->lost}};
  }
  out["frames"] = Json{{"displayed", result.loop.displayed}};
  put_quantile(out["frames"], "median_ms", result.loop.intervals_ms, 0.5);
  put_quantile(out["frames"], "p99_ms", result.loop.intervals_ms, 0.99);
  put_quantile(out["frames"], "capture_to_photon_median_ms", result.loop.photon_ages_ms, 0.5);
  put_quantile(out["frames"], "capture_to_photon_p99_ms", result.loop.photon_ages_ms, 0.99);
  return out;
}

std::string report_json(const OperationResult& result) { return dumped(report_of(result)); }

std::string timing_json(const LoopReport& loop) {
  return dumped(Json{{"step_wall", series(loop.step_wall_ms)},
                     {"draw_wall", series(loop.draw_wall_ms)},
                     {"drawn", loop.drawn},
                     {"dropped_snapshots", loop.dropped_snapshots}});
}

}  // namespace orthonav::engine
