#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/report/figures_json.h"
#include "engine/report/operation_result.h"
#include "nav/guidance/changed_screw.h"
#include "nav/guidance/screw_clearance.h"

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

void put_least_clearance(Json& out, const nav::Clearance& least, nav::Side side) {
  out["clearance_mm"] = least.clearance_m * 1e3;
  out["grade"] = nav::name_of(nav::grade_of(least.clearance_m));
  out["arc_mm"] = least.arc_length_m * 1e3;
  out["towards"] = nav::direction_of(least, side);
}

Json clearance_json(const nav::ScrewClearance& clearance, nav::Side side) {
  Json out;
  put_least_clearance(out, clearance.least, side);
  if (clearance.spread) {
    out["clearance_95_mm"] = clearance.spread->lower_95_m * 1e3;
    out["grade_probability"] = grades_json(clearance.spread->grade_probability);
  }
  return out;
}

/// The screw as planned, with the spread that the registration leaves for an exactly guided one,
/// and its least depth about every 2 mm from 6 mm past the entry to the tip.
void put_planned(Json& screw_json, const LevelState& level, const nav::ScrewPlan& plan) {
  const auto cylinder = nav::cylinder_of(plan);
  if (cylinder && level.plan.model) {
    const nav::SurfaceIndex& surface = level.plan.model->surface();
    const bool known = level.registration && level.registration->uncertainty;
    if (const auto planned = nav::screw_clearance(
            surface, *cylinder, known ? &*level.registration->uncertainty : nullptr)) {
      screw_json["planned"] = clearance_json(*planned, plan.side);
      constexpr double kStep_m = 0.002;
      const double side_m = cylinder->length_m - nav::CylinderSurface::kFrom_m;
      std::vector<double> profile_m(1 + static_cast<std::size_t>(std::max(1.0, side_m / kStep_m)));
      if (nav::clearance_profile(surface, *cylinder, profile_m)) {
        for (const double least_m : profile_m) {
          screw_json["planned"]["profile_mm"].push_back(least_m * 1e3);
        }
      }
    }
  }
  if (cylinder) {
    screw_json["planned"]["diameter_mm"] = 2e3 * cylinder->radius_m;
    screw_json["planned"]["length_mm"] = cylinder->length_m * 1e3;
  }
  if (!plan.accepted_breach.empty()) {
    screw_json["planned"]["accepted_breach"] = plan.accepted_breach;
  }
}

/// Nothing if no measurement was asked for.
void put_wire(Json& out, const ScrewState& screw) {
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

/// Whether the surgeon was warned of this screw: its wire was measured beyond a limit, its
/// clearance's 95 % bound is below 0, or its planned breach was accepted.
bool warned(const ScrewState& screw, const nav::ScrewPlan& plan) {
  const auto& tracked = screw.clearance_at_depth;
  const bool breach_bound = tracked && tracked->spread && tracked->spread->lower_95_m < 0.0;
  const auto& wire = screw.wire.measured;
  return breach_bound || !plan.accepted_breach.empty() || (wire && !wire->within());
}

Json screw_json(const LevelState& level, std::size_t index, const ScrewTruth& truth) {
  const nav::ScrewPlan& plan = level.plan.screws[index];
  const ScrewState& screw = level.screws[index];
  Json out{{"side", name_of(plan.side)}, {"done", screw.done}};
  if (truth.known) {
    out["angle_error_deg"] = degrees(truth.angle_error_rad);
  }
  put_mm(out, "entry_error_mm", truth.entry_error_m);
  if (truth.preoperative_angle_error_rad) {
    out["preoperative_angle_error_deg"] = degrees(*truth.preoperative_angle_error_rad);
  }
  put_mm(out, "preoperative_entry_error_mm", truth.preoperative_entry_error_m);
  if (truth.guided) {
    Json& guided = out["guided"];
    guided = Json{{"tip_mm", truth.guided->tip_m * 1e3},
                  {"across_mm", truth.guided->across_m * 1e3},
                  {"angle_deg", degrees(truth.guided->angle_rad)},
                  {"sure", truth.guided->sure}};
    if (truth.guided->across_sds) {
      guided["across_sds"] = *truth.guided->across_sds;
    }
  }
  if (truth.guided || truth.clearance) {
    out["warned"] = warned(screw, plan);
  }
  if (screw.replanned()) {
    put_planned_in_surgery(out, nav::difference_of(screw.preoperative, plan));
  }
  if (truth.clearance) {
    put_least_clearance(out, *truth.clearance, plan.side);
  }
  put_planned(out, level, plan);
  if (screw.clearance_at_depth) {
    out["tracked"] = clearance_json(*screw.clearance_at_depth, plan.side);
  }
  if (screw.done) {
    put_executed(out, screw.executed, screw.clearance_at_depth);
  }
  put_wire(out, screw);
  return out;
}

Json level_json(const LevelState& level, const LevelTruth& truth) {
  Json out{{"label", level.plan.label}, {"accepted", level.accepted}, {"attempts", level.attempts}};
  if (level.registration) {
    out["rmse_mm"] = level.registration->rmse_m * 1e3;
  }
  put_mm(out, "tre_mm", truth.tre_m);
  for (const Vec3& error : truth.errors_m) {
    out["errors_mm"].push_back({error.x * 1e3, error.y * 1e3, error.z * 1e3});
  }
  if (level.registration) {
    out["predicted_tre_mm"] = nav::worst_m(level.predicted) * 1e3;
    out["registration_only"] = level.registration_only();
    out["points"] = level.registration->points;
    out["digitization_s"] = level.digitization_s;
    for (const nav::CheckPoint& point : level.check_points) {
      out["check_points_mm"].push_back(point.distance_m * 1e3);
    }
  }
  if (const auto registered = registered_level(level)) {
    out["registration"] = registration_json(*registered, {});
  }
  out["screws"] = Json::array();
  for (std::size_t s = 0; s < level.plan.screws.size(); ++s) {
    out["screws"].push_back(screw_json(level, s, truth.screws[s]));
  }
  return out;
}

Json one_rod_json(const RodState& rod, const RodTruth& truth) {
  Json out{{"side", name_of(rod.side)}, {"heads", rod.heads.size()}};
  if (rod.rod) {
    out["length_mm"] = rod.rod->length_m * 1e3;
  }
  put_mm(out, "length_error_mm", truth.length_error_m);
  put_mm(out, "head_error_mm", truth.head_error_m);
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
Json rods_json(const OperationResult& result) {
  Json out = Json::object();
  Json sides = Json::array();
  for (std::size_t i = 0; i < result.state.rods.size(); ++i) {
    const RodState& rod = result.state.rods[i];
    if (!has_rod(result.state, rod)) {
      continue;
    }
    sides.push_back(one_rod_json(rod, result.truth.rods[i]));
    if (out.empty() && rod.rod) {
      out = sides.back();
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
  for (std::size_t i = 0; i < result.state.levels.size(); ++i) {
    out["levels"].push_back(level_json(result.state.levels[i], result.truth.levels[i]));
  }
  out["rod"] = rods_json(result);
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
