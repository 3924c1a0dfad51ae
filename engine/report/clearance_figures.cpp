#include "engine/report/clearance_figures.h"

#include <nlohmann/json.hpp>

#include "engine/report/figures_json.h"

namespace orthonav::engine {
namespace {

void put_least(nlohmann::ordered_json& out, const nav::Clearance& least, Side side) {
  out["clearance_mm"] = least.clearance_m * 1e3;
  out["grade"] = nav::name_of(nav::grade_of(least.clearance_m));
  out["arc_mm"] = least.arc_length_m * 1e3;
  out["towards"] = nav::direction_of(least, side);
}

nlohmann::ordered_json with_spread(const nav::ScrewClearance& clearance, Side side) {
  nlohmann::ordered_json out;
  put_least(out, clearance.least, side);
  if (clearance.spread) {
    out["clearance_95_mm"] = clearance.spread->lower_95_m * 1e3;
    out["grade_probability"] = grades_json(clearance.spread->grade_probability);
  }
  return out;
}

}  // namespace

void put_clearance(nlohmann::ordered_json& screw_json, const ScrewOutcome& screw) {
  if (screw.executed) {
    put_least(screw_json, *screw.executed, screw.side);
  }
  if (screw.planned) {
    screw_json["planned"] = with_spread(*screw.planned, screw.side);
    for (const double least_m : screw.planned_profile_m) {
      screw_json["planned"]["profile_mm"].push_back(least_m * 1e3);
    }
  }
  if (screw.size) {
    screw_json["planned"]["diameter_mm"] = 2e3 * screw.size->radius_m;
    screw_json["planned"]["length_mm"] = screw.size->length_m * 1e3;
  }
  if (!screw.accepted_breach.empty()) {
    screw_json["planned"]["accepted_breach"] = screw.accepted_breach;
  }
  if (screw.tracked) {
    screw_json["tracked"] = with_spread(*screw.tracked, screw.side);
  }
}

}  // namespace orthonav::engine
