#include "engine/report/registration_tables.h"

#include <algorithm>
#include <cmath>

#include "engine/case/operation.h"
#include "engine/report/figure_row.h"
#include "engine/report/html_text.h"

namespace orthonav::engine {
namespace {

/// A figure without a limit.
JudgedFigure plain(double value, int decimals) { return {value, decimals, Bound::kNone, 0.0, 0}; }
JudgedFigure at_most(double value, int decimals, double limit, int limit_decimals) {
  return {value, decimals, Bound::kAtMost, limit, limit_decimals};
}
JudgedFigure at_least(double value, int decimals, double limit, int limit_decimals) {
  return {value, decimals, Bound::kAtLeast, limit, limit_decimals};
}

std::string log_likelihood_ratio_row(const nav::Registration& r, double least) {
  const std::string name = "Margin of the next best pose";
  const std::string meaning = "how much worse it explains the points (log-likelihood ratio)";
  const JudgedFigure margin = at_least(r.log_likelihood_ratio, 1, least, 1);
  return std::isfinite(r.log_likelihood_ratio)
             ? figure_row(name, margin, meaning)
             : figure_row(name, judged_cell("none near", margin.bound, margin.keeps_limit()),
                          limit_text(margin), meaning);
}

std::string rows_of_hypotheses(const nav::Registration& r, const nav::RegistrationLimits& limits) {
  const std::string levels =
      !r.fits_better.empty()   ? "the points fit " + html_escaped(r.fits_better) + " as well"
      : r.levels_compared == 0 ? "none is known: the level could not be checked"
                               : "each explains the points clearly worse";
  const double mirror = std::max(-999.0, r.mirror_log_likelihood);
  return figure_row("Size of the bone", plain(r.size, 3),
                    "as the points say, the model’s is 1; SD " + html_number(r.size_sd, 3)) +
         figure_row(
             "Margin of the mirror image", at_most(mirror, 1, limits.mirror_log_likelihood, 1),
             sides_told_apart(r) ? "how much better it explains the points (log-likelihood ratio)"
                                 : "about as good: whether left and right are swapped could not be "
                                   "checked") +
         figure_row("Other levels compared", plain(static_cast<double>(r.levels_compared), 0),
                    levels);
}

std::string rows_of_best(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  const nav::RegistrationLimits limits = nav::registration_limits();
  return figure_row("RMSE <small>mm</small>", plain(r.rmse_m * 1e3, 2),
                    "of all points to the surface; a poor indicator of the error at the screws") +
         figure_row("Points on the bone <small>%</small>",
                    at_least(r.inlier_fraction * 1e2, 0, limits.inlier_fraction * 1e2, 0),
                    "the rest lie farther off than the scatter explains and are ignored") +
         figure_row("Scatter <small>mm</small>",
                    at_most(r.noise_m * 1e3, 2, limits.noise_m * 1e3, 1),
                    "standard deviation of the points on the bone about its surface") +
         figure_row("Estimated offset of the tip above the bone <small>mm</small>",
                    plain(r.standoff_m * 1e3, 2), "mean over the strokes; corrected") +
         figure_row("Effective sample size", plain(r.effective_points, 0),
                    "effective points: neighbours share the tracker’s error") +
         figure_row("Surface stroked <small>%</small>", plain(r.coverage_fraction * 1e2, 0),
                    "of what a pointer reaches from behind") +
         figure_row(
             "Pointer through bone <small>% of the points</small>",
             at_most(r.shaft_collision_fraction * 1e2, 0, limits.shaft_collision_fraction * 1e2, 0),
             "where its shaft would have been, were this pose right") +
         log_likelihood_ratio_row(r, limits.log_likelihood_ratio) + rows_of_hypotheses(r, limits);
}

/// `paper` tells the two RMSEs, and judges neither.
std::string rows_of_paper(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  return figure_row("RMSE <small>mm</small>", plain(r.rmse_m * 1e3, 2),
                    "of all points to the surface; a poor indicator of the error at the screws") +
         figure_row("RMSE of the other pose <small>mm</small>", plain(r.runner_up_rmse_m * 1e3, 2),
                    "of the two configurations the one with the smaller RMSE is shown");
}

JudgedFigure within_99_figure(double within_m) {
  return at_most(within_m * 1e3, 2, nav::PoseSearchRegistrationOptions{}.max_tre_99_m * 1e3, 1);
}

/// Whether expected errors include more than the registration's own, to which the limits apply.
bool holds_common(const RegisteredLevel& level) { return level.registration.common.sd_m() > 0.0; }

std::string rows_of_error(const RegisteredLevel& level) {
  const double own_m =
      holds_common(level) ? level.registration.predicted_tre_m : worst_rms_m(level);
  std::string out =
      figure_row(level.screws.empty() ? "Error where screws usually go <small>mm</small>"
                                      : "Error at the worst screw <small>mm</small>",
                 plain(own_m * 1e3, 2), "root mean square to expect of the registration alone");
  out += figure_row("99 % of errors below <small>mm</small>",
                    within_99_figure(level.registration.tre_99_m), "likewise");
  if (holds_common(level)) {
    out += figure_row("With what all strokes share <small>mm</small>",
                      plain(worst_rms_m(level) * 1e3, 2), "likewise, of all together");
  }
  if (const auto within = worst_within_95_m(level)) {
    out += figure_row("95 % of errors below <small>mm</small>", plain(*within * 1e3, 2),
                      "at the same place");
  }
  return out;
}

std::string row_of_checks(const RegisteredLevel& level) {
  if (level.check_points.empty()) {
    return "";
  }
  const double limit_mm = nav::CheckPointRules{}.within_m * 1e3;
  double worst_m = 0.0;
  bool all_within = true;
  for (const nav::CheckPoint& check : level.check_points) {
    worst_m = std::max(worst_m, std::abs(check.distance_m));
    all_within = all_within && check.within;
  }
  return figure_row("Check points <small>mm</small>",
                    judged_cell(std::to_string(level.check_points.size()) + ", worst " +
                                    html_number(worst_m * 1e3, 1),
                                Bound::kAtMost, all_within),
                    limit_text(at_most(0.0, 1, limit_mm, 1)),
                    "places touched afterwards, which \"accept\" takes into the registration");
}

std::string place_row(const std::string& name, const PlaceError& e) {
  std::string out = "<tr><th scope=row>" + name + "</th>" + judged_cell(plain(e.rms_m * 1e3, 2)) +
                    judged_cell(plain(e.within_95_m * 1e3, 2));
  for (const std::size_t axis : {0U, 1U, 2U}) {
    out += "<td>" +
           (e.covariance_m2
                ? html_number(1e3 * std::sqrt(std::max(0.0, (*e.covariance_m2)[4 * axis])), 2)
                : "–") +
           "</td>";
  }
  return out + "</tr>";
}

}  // namespace

std::string figures_table(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  std::string out =
      "<table class=figures><thead><tr><th></th><th></th><th>limit</th><th "
      "class=why>meaning</th></tr></thead>"
      "<tbody>" +
      figure_row("Points", plain(static_cast<double>(r.points), 0), "digitized and registered") +
      (is_judged(level.registration) ? rows_of_best(level) : rows_of_paper(level));
  if (is_judged(level.registration)) {
    out += rows_of_error(level);
  }
  out += row_of_checks(level);
  return out + "</tbody></table>";
}

std::string screws_table(const RegisteredLevel& level) {
  if (level.screws.empty()) {
    return "";
  }
  std::string out = "<table class=compact><thead><tr><th>" +
                    std::string(level.registration.accepted ? "errors to expect"
                                                            : "errors, were this pose right") +
                    " <small>mm</small></th><th>RMS</th><th>95 % below</th><th>SD "
                    "sideways</th><th>SD front to back</th><th>SD along the spine</th></tr>"
                    "</thead><tbody>";
  for (const ScrewErrors& e : errors_at_screws(level)) {
    const std::string side = name_of(e.side);
    out += place_row(side + " entry", e.entry) + place_row(side + " target", e.target);
  }
  return out + "</tbody></table>";
}

}  // namespace orthonav::engine
