#include "engine/report/tissue_drawing.h"

#include <algorithm>
#include <cmath>

#include "engine/report/html_text.h"

namespace orthonav::engine {
namespace {

/// ColorBrewer's YlOrBr: light where the tip was on the bone.
constexpr std::array<Rgb, 7> kThickness = {{{255, 255, 212},
                                            {254, 227, 145},
                                            {254, 196, 79},
                                            {254, 153, 41},
                                            {236, 112, 20},
                                            {204, 76, 2},
                                            {140, 45, 4}}};
constexpr Rgb kNotStroked{214, 208, 197};

/// A round number that hardly any place exceeds.
double full_scale_m(const RegistrationScene& scene) {
  constexpr double kStep_m = 0.0005;
  constexpr double kLeast_m = 0.003;  // a millimetre must not look like thick tissue
  double most_m = kLeast_m;
  for (const double tissue_m : scene.tissue_m) {
    most_m = std::isnan(tissue_m) ? most_m : std::max(most_m, tissue_m);
  }
  return std::min(0.005, std::ceil(most_m / kStep_m) * kStep_m);
}

std::string scrape_svg(Vec2 at) {
  return formatted("<circle class=\"scrape\" r=\"2.5\" cx=\"%.2f\" cy=\"%.2f\"/>", at.x, at.y) +
         formatted("<text class=\"scrape\" text-anchor=\"middle\" x=\"%.2f\" y=\"%.2f\">", at.x,
                   at.y - 4.0) +
         "press here</text>";
}

Result<RegistrationDrawing> tissue_drawing(const RegisteredLevel& level,
                                           const RegistrationScene& scene) {
  const RegistrationView view = registration_views().front();
  auto picture =
      bone_drawing(level, scene, view,
                   {scene.tissue_m, full_scale_m(scene), kNotStroked, kNotStroked, kThickness});
  if (!picture) {
    return picture;
  }
  std::string over;
  for (const PlacedPoint& check : scene.checks) {
    const Vec2 at = view.from.on_page_mm(check.place_m);
    over += formatted("<path class=\"check\" fill=\"#ffffff\" d=\"M%.2f %.2f", at.x, at.y) +
            "m0-1.5l1.5 1.5-1.5 1.5-1.5-1.5z\"/>";
  }
  if (scene.scrape_m) {
    over += scrape_svg(view.from.on_page_mm(*scene.scrape_m));
  }
  picture->svg += over + "</svg>";
  return picture;
}

std::string tissue_legend(const RegistrationScene& scene) {
  std::string out = "<div class=legend><span class=ramp>0 mm <b>";
  for (const Rgb& c : kThickness) {
    out += "<i style=\"background:" + hex(c) + "\"></i>";
  }
  return out + "</b> " + html_number(full_scale_m(scene) * 1e3, 1) +
         " mm<em>height of the tip above the bone, from strokes within 8 mm, without their noise: "
         "soft tissue, or a model that is not quite the bone</em></span></div>";
}

}  // namespace

Result<std::string> tissue_figure(const RegisteredLevel& level, const RegistrationScene& scene) {
  if (scene.tissue_m.empty()) {
    return std::string();
  }
  const auto drawing = tissue_drawing(level, scene);
  if (!drawing) {
    return drawing.error();
  }
  return "<div class=\"views tissue\"><figure>" + drawing->svg +
         "<figcaption>soft tissue, from behind</figcaption></figure>" + tissue_legend(scene) +
         "</div>";
}

}  // namespace orthonav::engine
