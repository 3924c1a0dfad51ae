#include "engine/report/registration_page.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "engine/report/html_text.h"
#include "engine/report/page_style.h"
#include "engine/report/registration_drawing.h"
#include "engine/report/registration_tables.h"
#include "engine/report/tissue_drawing.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine {
namespace {

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

std::string caption(const RegisteredLevel& level, const RegistrationScene& scene) {
  std::string out = "<p class=notes>";
  if (scene.points.size() < level.points.size()) {
    out += "Drawn: " + std::to_string(scene.points.size()) + " of " +
           std::to_string(level.points.size()) + " points. ";
  }
  return out +
         "Points behind the bone shine through it. How the guide is tracked and how steady a hand "
         "is comes on top of these errors.</p>";
}

/// A level with all its drawings.
struct DrawnLevel {
  const RegisteredLevel& level;
  RegistrationScene scene;
  std::vector<RegistrationDrawing> drawings;  ///< in the order of the views
  /// The width of the two views side by side, from behind and from the left.
  [[nodiscard]] double width_mm() const { return drawings[0].size_mm.x + drawings[1].size_mm.x; }
};

Result<DrawnLevel> drawn(const RegisteredLevel& level, std::optional<double> magnified) {
  DrawnLevel out{level, registration_scene(level), {}};
  if (magnified) {
    out.scene.magnified = *magnified;
    out.scene.one_scale = true;
  }
  for (const RegistrationView& view : registration_views()) {
    auto drawing = registration_drawing(level, out.scene, view);
    if (!drawing) {
      return drawing.error();
    }
    out.drawings.push_back(std::move(*drawing));
  }
  return out;
}

/// As in a technical drawing: from behind; beside it from the left; below it from above; all to one
/// scale. The legend and the screws take the remaining corner. `widest_mm` of all levels fills the
/// page, so that all levels have the same scale.
std::string views(const DrawnLevel& drawn, double widest_mm) {
  std::string figures;
  for (std::size_t i = 0; i < drawn.drawings.size(); ++i) {
    const RegistrationView view = registration_views()[i];
    figures += "<figure>" + drawn.drawings[i].svg + "<figcaption>" + view.name + view.remark +
               "</figcaption></figure>";
  }
  // The third view is as wide as the first: both run from left to right.
  return "<div class=views style=\"grid-template-columns:" +
         html_number(drawn.drawings[0].size_mm.x, 2) + "fr " +
         html_number(drawn.drawings[1].size_mm.x, 2) +
         "fr;width:" + html_number(100.0 * drawn.width_mm() / widest_mm, 1) + "%\">" + figures +
         "<div>" + registration_legend(drawn.level, drawn.scene) + screws_table(drawn.level) +
         caption(drawn.level, drawn.scene) + "</div></div>";
}

Result<std::string> section_of(const DrawnLevel& drawn, double widest_mm) {
  const auto tissue = tissue_figure(drawn.level, drawn.scene);
  if (!tissue) {
    return tissue;
  }
  const nav::Registration& r = drawn.level.registration;
  return "<section class=registration><h2>" + title_of(drawn.level) + ": " +
         (!r.accepted    ? "<span class=bad>refused</span>"
          : is_judged(r) ? "<span class=good>passed the numeric checks</span>"
                         : "shown, not judged") +
         "</h2>" + in_words(drawn.level) + views(drawn, widest_mm) + *tissue +
         figures_table(drawn.level) + "</section>";
}

}  // namespace

Result<std::string> registration_sections(std::span<const RegisteredLevel> levels) {
  const auto magnified =
      levels.size() > 1 ? std::optional(common_magnification(levels)) : std::nullopt;
  std::vector<DrawnLevel> all;
  double widest_mm = 0.0;
  for (const RegisteredLevel& level : levels) {
    auto one = drawn(level, magnified);
    if (!one) {
      return one.error();
    }
    widest_mm = std::max(widest_mm, one->width_mm());
    all.push_back(std::move(*one));
  }
  std::string html;
  for (const DrawnLevel& one : all) {
    const auto section = section_of(one, widest_mm);
    if (!section) {
      return section;
    }
    html += *section;
  }
  return html;
}

Result<std::string> registration_section(const RegisteredLevel& level) {
  return registration_sections({&level, 1});
}

Result<std::string> registration_page(const RegisteredLevel& level, const std::string& source) {
  auto section = registration_section(level);
  if (!section) {
    return section;
  }
  std::string html =
      "<!doctype html><html lang=en><head><meta charset=utf-8><title>orthonav: registration"
      "</title><meta name=viewport content=\"width=device-width, initial-scale=1\"><style>";
  html += page_style();
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
