#include "engine/report/registration_figures.h"
#include "engine/report/html_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/angle.h"
#include "engine/case/operation.h"
#include "engine/session/text/wording.h"
#include "nav/guidance/predicted_error.h"
#include "nav/published/registration.h"

namespace orthonav::engine {
namespace {

PlaceError error_at(const nav::Registration& r, Point<Vertebra> place) {
  constexpr double kOpen = std::numeric_limits<double>::infinity();
  if (!r.uncertainty) {
    return {kOpen, kOpen, {}};
  }
  return {r.uncertainty->predicted_tre_m(place), r.uncertainty->tre_quantile_m(place, 0.95),
          r.uncertainty->covariance_at(place)};
}

/// The points where poses are compared: at the screws, or else at the extremes of the reachable
/// surface.
std::vector<Point<Vertebra>> places_of(const RegisteredLevel& level) {
  std::vector<Point<Vertebra>> places = nav::entries_and_targets(level.screws);
  if (places.empty()) {
    const auto extremes = nav::published::extreme_points(level.model->reachable().vertices_m);
    places = {{extremes.e1}, {extremes.e2}, {extremes.e3}};
  }
  return places;
}

/// By how much the model may be of another size than the bone, with 95 % probability.
double size_may_be_off(const nav::Registration& r) {
  return std::abs(r.size - 1.0) + 1.96 * r.size_sd;
}

/// What the points could not show, in words; empty if nothing.
std::string not_checked(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  if (!is_judged(r)) {
    return "";
  }
  if (level.model->bone() == nav::Bone::kAny) {
    return "; whether it is this bone, of this size and not its mirror image, was not checked";
  }
  std::string out;
  if (r.levels_compared == 0) {
    out += "; no other level is known, so whether it is this level could not be checked";
  }
  if (!sides_told_apart(r)) {
    out +=
        "; the model's mirror image fits about as well, so whether left and right are swapped "
        "could not be checked";
  }
  constexpr double kNotable = 0.03;
  if (size_may_be_off(r) > kNotable) {
    out += formatted("; the model's size could be checked to %.0f %% only",
                     std::ceil(1e2 * size_may_be_off(r)));
  }
  return out;
}

}  // namespace

std::vector<ScrewErrors> errors_at_screws(const RegisteredLevel& level) {
  std::vector<ScrewErrors> errors;
  for (const nav::ScrewPlan& screw : level.screws) {
    errors.push_back({screw.side, error_at(level.registration, screw.entry),
                      error_at(level.registration, screw.target)});
  }
  return errors;
}

double worst_rms_m(const RegisteredLevel& level) {
  if (level.screws.empty()) {
    return level.registration.predicted_tre_m;
  }
  double worst = 0.0;
  for (const ScrewErrors& e : errors_at_screws(level)) {
    worst = std::max({worst, e.entry.rms_m, e.target.rms_m});
  }
  return worst;
}

std::optional<double> worst_within_95_m(const RegisteredLevel& level) {
  if (!is_judged(level.registration) && !level.registration.uncertainty) {
    return std::nullopt;
  }
  if (level.screws.empty()) {
    return level.registration.tre_95_m;
  }
  double worst = 0.0;
  for (const ScrewErrors& e : errors_at_screws(level)) {
    worst = std::max({worst, e.entry.within_95_m, e.target.within_95_m});
  }
  return worst;
}

std::optional<RunnerUpDistance> runner_up_distance(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  if (r.runner_up == r.world_from_vertebra) {
    return std::nullopt;
  }
  RunnerUpDistance out;
  for (const Point<Vertebra>& place : places_of(level)) {
    out.apart_m =
        std::max(out.apart_m, (r.runner_up * place - r.world_from_vertebra * place).norm());
  }
  out.rotation_rad = rotation_angle_rad(r.runner_up.rotation(), r.world_from_vertebra.rotation());
  return out;
}

bool sides_told_apart(const nav::Registration& r) {
  return r.mirror_log_likelihood < -nav::registration_limits().mirror_log_likelihood;
}

std::string ambiguity_of(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  if (!r.fits_better.empty()) {
    return "ambiguous: the points fit level " + r.fits_better + " as well or better";
  }
  const std::string unchecked = not_checked(level);
  const auto other = runner_up_distance(level);
  if (!other) {
    return is_judged(r)
               ? "unambiguous: no other pose comes near to explaining the points" + unchecked
               : "judged by eye: both coarse poses end in this one";
  }
  const std::string where =
      formatted(level.screws.empty()
                    ? "%.0f mm away on the surface and turned"
                      " by %.0f degrees, explains the points "
                    : "%.0f mm away at the screws and turned by %.0f degrees, explains the points ",
                other->apart_m * 1e3, degrees(other->rotation_rad));
  if (!is_judged(r)) {
    return "judged by eye: the other of the two poses, " + where +
           formatted("with an RMSE of %.2f mm (this one %.2f mm)", r.runner_up_rmse_m * 1e3,
                     r.rmse_m * 1e3);
  }
  const double limit = nav::registration_limits().log_likelihood_ratio;
  const std::string by = formatted(" (margin %.1f, at least %.1f)", r.log_likelihood_ratio, limit);
  return r.log_likelihood_ratio >= limit
             ? "unambiguous: the next best pose, " + where + "clearly worse" + by + unchecked
             : "ambiguous: another pose, " + where + "nearly as well" + by + unchecked;
}

std::string sources_of(const nav::CommonErrors& common) {
  if (!(common.sd_m() > 0.0)) {
    return "Of the registration alone: what all strokes share (tip, cameras, drift of the map) is "
           "not in it.";
  }
  const std::string map =
      common.map_m > 0.0 ? formatted(", drift of the map %.2f", common.map_m * 1e3) : "";
  return formatted("With what all strokes share, SD along an axis: tip %.2f, cameras %.2f",
                   common.tip_m * 1e3, common.cameras_m * 1e3) +
         map + " mm.";
}

std::string certainty_of(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  std::string out;
  const auto within = worst_within_95_m(level);
  const char* where = !level.screws.empty()                         ? "at the screws"
                      : level.model->bone() == nav::Bone::kVertebra ? "where screws usually go"
                                                                    : "at the ends of the bone";
  if (!within) {
    out = "The published method predicts no error: it is judged by eye.";
  } else if (std::isfinite(*within)) {
    // The scatter about a pose that may be wrong means nothing.
    out = std::string(r.accepted ? "95 % of errors " : "Were this pose right, 95 % of errors ") +
          where +
          formatted(r.accepted ? " are expected to be below %.2f mm." : " would be below %.2f mm.",
                    *within * 1e3);
  } else {
    out = std::string("The errors ") + where + " are unknown.";
  }
  if (within && std::isfinite(*within)) {
    out += " " + sources_of(r.common);
  }
  if (r.weakest) {
    out += " Least certain: " + text_of(*r.weakest) + ".";
  }
  if (r.stroke_next) {
    out += " To improve: " + text_of(*r.stroke_next) + ".";
  }
  return out;
}

std::array<double, 16> model_to_points(const Transform<World, Vertebra>& pose,
                                       const FigureFrame& frame) {
  Mat3 rotation = pose.rotation();
  if (frame.model_axes == Axes::kRas) {
    rotation = Mat3::from_columns(-rotation.column(0), -rotation.column(1), rotation.column(2));
  }
  return Transform<World, Vertebra>(rotation, pose.translation() / frame.points_unit_m).row_major();
}

}  // namespace orthonav::engine
