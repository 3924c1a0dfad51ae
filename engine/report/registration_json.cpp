#include <cmath>
#include <nlohmann/json.hpp>

#include "base/angle.h"
#include "engine/case/operation.h"
#include "engine/report/registration_figures.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: null stands for "not known to be bounded".
Json mm_or_null(double m) { return std::isfinite(m) ? Json(m * 1e3) : Json(); }

Json matrix_json(const Transform<World, Vertebra>& pose, const FigureFrame& frame) {
  auto a = model_to_points(pose, frame);
  for (double& number : a) {
    number += 0.0;  // never "-0.0"
  }
  Json rows = Json::array();
  for (std::size_t row = 0; row < 16; row += 4) {
    rows.push_back({a[row], a[row + 1], a[row + 2], a[row + 3]});
  }
  return rows;
}

/// In the axes of the model's file: in RAS, x and y change sign.
Json covariance_json(const PlaceError& error, const FigureFrame& frame) {
  if (!error.covariance_m2) {
    return {};
  }
  const auto sign = [&](std::size_t axis) {
    return frame.model_axes == Axes::kRas && axis < 2 ? -1.0 : 1.0;
  };
  Json rows = Json::array();
  for (std::size_t r = 0; r < 3; ++r) {
    Json row = Json::array();
    for (std::size_t c = 0; c < 3; ++c) {
      row.push_back((*error.covariance_m2)[3 * r + c] * sign(r) * sign(c) * 1e6 + 0.0);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Json screw_json(const ScrewErrors& screw, const FigureFrame& frame) {
  return {{"side", name_of(screw.side)},
          {"predicted_entry_tre_mm", mm_or_null(screw.entry.rms_m)},
          {"predicted_target_tre_mm", mm_or_null(screw.target.rms_m)},
          {"predicted_entry_tre_95_mm", mm_or_null(screw.entry.within_95_m)},
          {"predicted_target_tre_95_mm", mm_or_null(screw.target.within_95_m)},
          {"entry_covariance_mm2", covariance_json(screw.entry, frame)},
          {"target_covariance_mm2", covariance_json(screw.target, frame)}};
}

void put_runner_up(Json& out, const RegisteredLevel& level, const FigureFrame& frame) {
  const nav::Registration& r = level.registration;
  const auto distance = runner_up_distance(level);
  if (distance) {
    out["runner_up_rmse_mm"] = mm_or_null(r.runner_up_rmse_m);
    if (is_judged(r)) {
      out["runner_up_margin"] = r.log_likelihood_ratio;
    }
    out["runner_up_distance_mm"] = mm_or_null(distance->apart_m);
    out["runner_up_angle_deg"] = degrees(distance->rotation_rad);
    out["runner_up_model_to_points"] = matrix_json(r.runner_up, frame);
  }
  out["ambiguity"] = ambiguity_of(level);
}

void put_fit(Json& out, const nav::Registration& r) {
  out["points"] = r.points;
  out["iterations"] = r.iterations;
  out["rmse_mm"] = mm_or_null(r.rmse_m);
  if (!is_judged(r)) {
    return;  // `paper` has no more figures
  }
  out["noise_mm"] = mm_or_null(r.noise_m);
  out["lift_mm"] = mm_or_null(r.standoff_m);
  out["inlier_share"] = r.inlier_fraction;
  out["effective_points"] = r.effective_points;
  out["coverage_share"] = r.coverage_fraction;
  out["swept_share"] = r.shaft_collision_fraction;
}

/// Expected errors, and what they include.
void put_expected(Json& out, const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  out["predicted_tre_mm"] = mm_or_null(worst_rms_m(level));
  if (const auto within = worst_within_95_m(level)) {
    out["predicted_tre_95_mm"] = mm_or_null(*within);
  }
  if (is_judged(r)) {
    out["predicted_tre_99_mm"] = mm_or_null(r.tre_99_m);
    out["tissue_sd_mm"] = r.field_sd_m * 1e3;
    out["correlation_across_strokes"] = r.correlation_across_strokes;
    out["size"] = r.size;
    out["size_sd"] = r.size_sd;
    out["common_sd_mm"] = {{"tip", r.common.tip_m * 1e3},
                           {"cameras", r.common.cameras_m * 1e3},
                           {"map", r.common.map_m * 1e3}};
    out["registration_only"] = !(r.common.sd_m() > 0.0);
    out["levels_compared"] = r.levels_compared;
    out["mirror_margin"] =
        std::isfinite(r.mirror_log_likelihood) ? Json(-r.mirror_log_likelihood) : Json(nullptr);
  }
}

}  // namespace

nlohmann::ordered_json registration_json(const RegisteredLevel& level, const FigureFrame& frame) {
  const nav::Registration& r = level.registration;
  Json out{{"accepted", r.accepted}, {"reasons", Json::array()}};
  for (const nav::RefusalReason& reason : r.reasons) {
    out["reasons"].push_back(text_of(reason));
  }
  if (r.stroke_next) {
    out["advice"] = text_of(*r.stroke_next);
  }
  if (r.weakest) {
    out["weakest"] = text_of(*r.weakest);
  }
  if (!r.fits_better.empty()) {
    out["fits_better"] = r.fits_better;
  }
  if (!level.method.empty()) {
    out["method"] = level.method;
  }
  if (!level.label.empty()) {
    out["level"] = level.label;
  }
  out["points_unit"] = frame.points_unit_m == 1.0 ? "m" : "mm";
  out["model_frame"] = frame.model_axes == Axes::kRas ? "RAS" : "LPS";
  out["model_to_points"] = matrix_json(r.world_from_vertebra, frame);
  put_fit(out, r);
  put_runner_up(out, level, frame);
  put_expected(out, level);
  out["covariance_frame"] = out["model_frame"];
  for (const ScrewErrors& screw : errors_at_screws(level)) {
    out["screws"].push_back(screw_json(screw, frame));
  }
  return out;
}

}  // namespace orthonav::engine
