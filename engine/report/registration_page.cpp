#include "engine/report/registration_page.h"

#include <cmath>

#include "embedded/report_css.h"
#include "engine/case/operation.h"
#include "engine/report/html_text.h"
#include "engine/report/registration_drawing.h"
#include "engine/session/findings_wording.h"

namespace orthonav::engine {
namespace {

std::string mm(double metres, int decimals = 2) { return html_number(metres * 1e3, decimals); }

std::string whole(double value) { return html_number(value, 0); }

std::string title_of(const RegisteredLevel& level) {
  return "Registration" + (level.label.empty() ? "" : " of " + html_escaped(level.label));
}

std::string sentence(std::string words) {
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') {
    words[0] -= 'a' - 'A';
  }
  return html_escaped(words);
}

std::string in_words(const RegisteredLevel& level) {
  std::string out;
  const nav::Registration& r = level.registration;
  if (!r.reasons.empty()) {
    out += "<ul class=reasons>";
  }
  for (const nav::RefusalReason& reason : r.reasons) {
    out += "<li>" + sentence(text_of(reason)) + "</li>";
  }
  if (!r.reasons.empty()) {
    out += "</ul>";
  }
  return out + "<p class=sure>" + sentence(certainty_of(level)) + " " +
         sentence(ambiguity_of(level)) + ".</p>";
}

/// A figure, whether it keeps its limit, the limit (empty: none) and its meaning.
struct Figure {
  const char* name;
  std::string value;
  bool good;
  std::string limit;
  const char* meaning;
};

std::string row(const Figure& f) {
  return std::string("<tr><th scope=row>") + f.name +
         "</th><td class=" + (f.good ? "ours>" : "bad>") + f.value + "</td><td>" + f.limit +
         "</td><td class=why>" + f.meaning + "</td></tr>";
}

std::string at_least(const std::string& limit) { return "\u2265 " + limit; }
std::string at_most(const std::string& limit) { return "\u2264 " + limit; }

std::string rows_of_best(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  const nav::PoseSearchRegistrationOptions limits;
  return row({"RMSE <small>mm</small>", mm(r.rmse_m), true, "",
              "of all points to the surface; hardly tells the error at the screws"}) +
         row({"Points on the bone", whole(r.inlier_fraction * 1e2) + " %",
              r.inlier_fraction >= limits.min_inlier_fraction,
              at_least(whole(limits.min_inlier_fraction * 1e2)),
              "the rest lies farther off than the scatter explains and has no say"}) +
         row({"Scatter <small>mm</small>", mm(r.noise_m), r.noise_m <= limits.max_noise_m,
              at_most(mm(limits.max_noise_m, 1)),
              "standard deviation of the points on the bone about its surface"}) +
         row({"Height of the tip above the bone <small>mm</small>", mm(r.standoff_m), true, "",
              "its mean over the strokes, as far as they tell it; taken into account"}) +
         row({"Independent points", whole(r.effective_points), true, "",
              "what the points are worth: neighbours share the tracker\u2019s error"}) +
         row({"Surface stroked", whole(r.coverage_fraction * 1e2) + " %",
              r.coverage_fraction >= limits.min_coverage_fraction,
              at_least(whole(limits.min_coverage_fraction * 1e2)),
              "of what a pointer reaches from behind"}) +
         row({"Margin of the next best pose",
              std::isfinite(r.log_likelihood_ratio) ? html_number(r.log_likelihood_ratio, 1)
                                                    : "none near",
              r.log_likelihood_ratio >= limits.min_log_likelihood_ratio,
              at_least(whole(limits.min_log_likelihood_ratio)),
              "how much worse it explains the points (log-likelihood ratio)"});
}

/// `paper` judges by the residuals and by the error to expect at the model's centre.
std::string rows_of_paper(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  const nav::RegistrationOptions limits;
  const double next_m = limits.min_runner_up_ratio * r.rmse_m;
  return row({"RMSE <small>mm</small>", mm(r.rmse_m), r.rmse_m <= limits.max_rmse_m,
              at_most(mm(limits.max_rmse_m, 1)),
              "of all points to the surface; hardly tells the error at the screws"}) +
         row({"RMSE of the next best pose <small>mm</small>", mm(r.runner_up_rmse_m),
              r.runner_up_rmse_m >= next_m, at_least(mm(next_m)),
              "so much worse that it can\u2019t be meant"}) +
         row({"Error at the model\u2019s centre <small>mm</small>", mm(r.predicted_tre_m),
              r.predicted_tre_m <= limits.max_predicted_tre_m,
              at_most(mm(limits.max_predicted_tre_m, 1)), "root mean square to expect"});
}

std::string rows_of_error(const RegisteredLevel& level, bool best) {
  const nav::PoseSearchRegistrationOptions limits;
  const double rms = worst_rms_m(level);
  std::string out =
      row({level.screws.empty() ? "Error where screws usually go <small>mm</small>"
                                : "Error at the worst screw <small>mm</small>",
           mm(rms), !best || rms <= limits.max_predicted_tre_m,
           best ? at_most(mm(limits.max_predicted_tre_m, 1)) : "", "root mean square to expect"});
  if (const auto within = worst_within_95_m(level)) {
    out += row({"95 of 100 errors below <small>mm</small>", mm(*within),
                !best || *within <= limits.max_tre_95_m,
                best ? at_most(mm(limits.max_tre_95_m, 1)) : "", "at the same place"});
  }
  return out;
}

std::string row_of_checks(const RegisteredLevel& level) {
  if (level.check_points.empty()) {
    return "";
  }
  std::string distances;
  bool all_within = true;
  for (const nav::CheckPoint& check : level.check_points) {
    distances += (distances.empty() ? "" : ", ") + mm(check.distance_m, 1);
    all_within = all_within && check.within;
  }
  return row({"Check points <small>mm</small>", distances, all_within,
              at_most(mm(nav::CheckPointRules{}.within_m, 1)),
              "distances of places touched afterwards, which had no part in the fit"});
}

std::string figures(const RegisteredLevel& level) {
  const nav::Registration& r = level.registration;
  const bool best = r.noise_m > 0.0;
  std::string out =
      "<table><thead><tr><th></th><th></th><th>limit</th><th class=why>meaning</th></tr></thead>"
      "<tbody>" +
      row({"Points", whole(static_cast<double>(r.points)), true, "", "digitized and registered"}) +
      (best ? rows_of_best(level) : rows_of_paper(level));
  if (best || !level.screws.empty()) {
    out += rows_of_error(level, best);
  }
  out += row_of_checks(level);
  return out + "</tbody></table>";
}

std::string place_row(const std::string& name, const PlaceError& e) {
  std::string out = "<tr><th scope=row>" + name + "</th><td>" + mm(e.rms_m) +
                    "</td><td class=ours>" + mm(e.within_95_m) + "</td>";
  for (const std::size_t axis : {0U, 1U, 2U}) {
    out +=
        "<td>" +
        (e.covariance_m2 ? mm(std::sqrt(std::max(0.0, (*e.covariance_m2)[4 * axis]))) : "\u2013") +
        "</td>";
  }
  return out + "</tr>";
}

std::string screws(const RegisteredLevel& level) {
  if (level.screws.empty()) {
    return "";
  }
  std::string out =
      "<table><thead><tr><th>errors to expect <small>mm</small></th><th>RMS</th><th>95 of 100 "
      "below</th><th>SD sideways</th><th>SD front to back</th><th>SD along the spine</th></tr>"
      "</thead><tbody>";
  for (const ScrewErrors& e : errors_at_screws(level)) {
    const std::string side = name_of(e.side);
    out += place_row(side + " entry", e.entry) + place_row(side + " target", e.target);
  }
  return out + "</tbody></table>";
}

std::string caption(const RegisteredLevel& level, const RegistrationScene& scene) {
  std::string out = "<p class=notes>";
  if (scene.points.size() < level.points.size()) {
    out += "Drawn: " + std::to_string(scene.points.size()) + " of " +
           std::to_string(level.points.size()) + " points. ";
  }
  return out +
         "Points behind the bone shine through it. The errors are those of this registration "
         "alone: "
         "how tools are tracked and how steady a hand is comes on top. A wrong tip shifts all "
         "points alike and shows in none of these figures.</p>";
}

/// As in a technical drawing: from behind; beside it from the left; below it from above; all to one
/// scale. The legend and the screws take the remaining corner.
Result<std::string> views(const RegisteredLevel& level, const RegistrationScene& scene) {
  std::string figures;
  std::string columns;
  for (const RegistrationView& view : registration_views()) {
    const auto drawing = registration_drawing(level, scene, view);
    if (!drawing) {
      return drawing.error();
    }
    columns += html_number(drawing->size_mm.x, 2) + "fr ";
    figures += "<figure>" + drawing->svg + "<figcaption>" + view.name + "</figcaption></figure>";
  }
  // The third view is as wide as the first: both run from left to right.
  columns.erase(columns.find(' ', columns.find(' ') + 1));
  return "<div class=views style=\"grid-template-columns:" + columns + "\">" + figures + "<div>" +
         registration_legend(level, scene) + screws(level) + caption(level, scene) + "</div></div>";
}

}  // namespace

Result<std::string> registration_section(const RegisteredLevel& level) {
  const RegistrationScene scene = registration_scene(level);
  const auto drawn = views(level, scene);
  if (!drawn) {
    return drawn;
  }
  return "<section class=registration><h2>" + title_of(level) + ": " +
         (level.registration.accepted ? "<span class=good>accepted by its figures</span>"
                                      : "<span class=bad>refused</span>") +
         "</h2>" + in_words(level) + *drawn + figures(level) + "</section>";
}

Result<std::string> registration_page(const RegisteredLevel& level, const std::string& source) {
  auto section = registration_section(level);
  if (!section) {
    return section;
  }
  std::string html =
      "<!doctype html><html lang=en><head><meta charset=utf-8><title>orthonav: registration"
      "</title><meta name=viewport content=\"width=device-width\"><style>";
  html += embedded::report_css();
  html += "</style></head><body><header><h1>orthonav <span>registration report</span></h1><p>";
  if (!level.label.empty()) {
    html += "Level <b>" + html_escaped(level.label) + "</b>, ";
  }
  html += "method <b>" + html_escaped(level.method) + "</b>, points of <b>" + html_escaped(source) +
          "</b></p></header><main>" + *section +
          "<ul class=notes><li>Not a medical device.</li></ul></main></body></html>\n";
  return html;
}

}  // namespace orthonav::engine
