#include "engine/report/registration_drawing.h"

#include <cmath>
#include <limits>

#include "base/angle.h"
#include "base/printed.h"
#include "engine/case/operation.h"
#include "engine/io/image_file.h"
#include "engine/report/base64.h"
#include "engine/report/html_text.h"
#include "engine/report/residual_colours.h"

namespace orthonav::engine {
namespace {

constexpr double kPixelsPerMm = 8.0;
constexpr double kMargin_mm = 5.0;
constexpr double kShaftOutside_mm = 14.0;
/// Points farther off the bone are left outside the picture.
constexpr double kShownOff_m = 0.012;
/// Points no farther than this behind the surface are shown through it.
constexpr double kHidden_m = 0.002;
constexpr Rgb kUntouchable{214, 208, 197};
constexpr Rgb kStrokedBone{170, 205, 178};
constexpr Rgb kOpenBone{240, 200, 132};

/// The place outside the bone on the screw's axis to which its shaft is drawn.
Vec3 shaft_end_m(const nav::ScrewPlan& screw) {
  const Vec3 out = screw.entry - screw.target;
  return screw.entry.v + out * (kShaftOutside_mm * 1e-3 / out.norm());
}

PageArea area_of(const RegisteredLevel& level, const RegistrationScene& scene,
                 const Viewpoint& view) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  PageArea area{{kFar, kFar}, {-kFar, -kFar}};
  const auto include = [&](Vec3 place_m) {
    const Vec2 at = view.on_page_mm(place_m);
    area.low_mm = {std::min(area.low_mm.x, at.x), std::min(area.low_mm.y, at.y)};
    area.high_mm = {std::max(area.high_mm.x, at.x), std::max(area.high_mm.y, at.y)};
  };
  for (const Vec3& vertex : level.model->mesh().vertices_m) {
    include(vertex);
  }
  for (const nav::ScrewPlan& screw : level.screws) {
    include(shaft_end_m(screw));
  }
  for (const PlacedPoint& point : scene.points) {
    if (std::abs(point.residual_m) < kShownOff_m) {
      include(point.place_m);
    }
  }
  const Vec2 log_likelihood_ratio{kMargin_mm, kMargin_mm};
  return {area.low_mm - log_likelihood_ratio, area.high_mm + log_likelihood_ratio};
}

/// Points of one kind as paths, one per colour: a dot is a line of zero length with round caps.
class PointPaths {
 public:
  PointPaths(const RegistrationScene& scene, const Viewpoint& view) : scene_(scene), view_(view) {}

  void add(const PlacedPoint& point) {
    const Vec2 at = view_.on_page_mm(point.place_m);
    const char* shape =
        point.off_bone ? "M%.2f %.2fm-.55-.55l1.1 1.1m0-1.1l-1.1 1.1" : "M%.2f %.2fh0";
    paths_[residual_colour(point.residual_m, scene_.full_colour_m)] += formatted(shape, at.x, at.y);
  }
  /// With a dark outline, so that white points show on the bone.
  [[nodiscard]] std::string svg(const char* kind, double width_mm) const {
    std::string all;
    for (const std::string& path : paths_) {
      all += path;
    }
    if (all.empty()) {
      return "";
    }
    std::string out = "<g class=\"" + std::string(kind) + "\"><path stroke=\"#26323d\"" +
                      formatted(" stroke-width=\"%.2f\" d=\"", width_mm + 0.35) + all + "\"/>";
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (!paths_[i].empty()) {
        out += "<path stroke=\"" + std::string(kResidualColours[i]) +
               formatted("\" stroke-width=\"%.2f\" d=\"", width_mm) + paths_[i] + "\"/>";
      }
    }
    return out + "</g>";
  }

 private:
  const RegistrationScene& scene_;
  const Viewpoint& view_;
  std::array<std::string, kResidualColours.size()> paths_;
};

std::string points_svg(const RegistrationScene& scene, const Viewpoint& view,
                       const DepthPicture& bone) {
  PointPaths behind(scene, view);
  PointPaths seen(scene, view);
  PointPaths off(scene, view);
  for (const PlacedPoint& point : scene.points) {
    (point.off_bone ? off : bone.hides(point.place_m, kHidden_m) ? behind : seen).add(point);
  }
  return behind.svg("behind", 0.7) + seen.svg("points", 0.8) + off.svg("off", 0.35);
}

/// The shadow of the 95 % ellipsoid: an ellipse of the covariance seen from there.
std::string ellipse_svg(Point<Vertebra> place, const PlaceError& error, double magnified,
                        const Viewpoint& view) {
  if (!error.covariance_m2) {
    return "";
  }
  const auto& m = *error.covariance_m2;
  const Mat3 c{{{{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}}}};
  const Vec3 down = -view.up;
  const double xx = view.right.dot(c * view.right);
  const double xy = view.right.dot(c * down);
  const double yy = down.dot(c * down);
  const double mean = 0.5 * (xx + yy);
  const double spread = std::hypot(0.5 * (xx - yy), xy);
  const double scale_mm = magnified * ellipsoid_scale() * 1e3;
  const double angle_deg = 0.5 * degrees(std::atan2(2.0 * xy, xx - yy));
  const Vec2 at = view.on_page_mm(place.v);
  return formatted("<ellipse rx=\"%.2f\" ry=\"%.2f\"", scale_mm * std::sqrt(mean + spread),
                   scale_mm * std::sqrt(std::max(0.0, mean - spread))) +
         formatted(" transform=\"translate(%.2f %.2f) rotate(%.1f)\"/>", at.x, at.y, angle_deg);
}

std::string screws_svg(const RegisteredLevel& level, const RegistrationScene& scene,
                       const Viewpoint& view) {
  std::string out;
  const std::vector<ScrewErrors> errors = errors_at_screws(level);
  for (std::size_t i = 0; i < level.screws.size(); ++i) {
    const nav::ScrewPlan& screw = level.screws[i];
    const Vec2 end = view.on_page_mm(shaft_end_m(screw));
    const Vec2 entry = view.on_page_mm(screw.entry.v);
    const Vec2 target = view.on_page_mm(screw.target.v);
    const std::string line = formatted("M%.2f %.2fL%.2f %.2f", end.x, end.y, target.x, target.y);
    out += "<g class=\"screw\">";
    if (screw.radius_m > 0.0) {
      out += formatted("<path class=\"body\" stroke-width=\"%.2f\" d=\"", 2e3 * screw.radius_m) +
             formatted("M%.2f %.2fL%.2f %.2f\"/>", entry.x, entry.y, target.x, target.y);
    }
    out += "<path class=\"axis\" d=\"" + line + "\"/>";
    out += ellipse_svg(screw.entry, errors[i].entry, scene.magnified, view) +
           ellipse_svg(screw.target, errors[i].target, scene.magnified, view);
    out += formatted("<circle r=\".7\" cx=\"%.2f\" cy=\"%.2f\"/>", entry.x, entry.y) +
           formatted("<path class=\"target\" d=\"M%.2f %.2fm-1 0h2m-1-1v2\"/>", target.x, target.y);
    out += "</g>";
  }
  return out;
}

/// Places touched to verify the registration.
std::string checks_svg(const RegistrationScene& scene, const Viewpoint& view) {
  std::string out;
  for (const PlacedPoint& point : scene.checks) {
    const Vec2 at = view.on_page_mm(point.place_m);
    out +=
        formatted("<path class=\"check\" d=\"M%.2f %.2fm0-1.5l1.5 1.5-1.5 1.5-1.5-1.5z\" fill=\"",
                  at.x, at.y) +
        kResidualColours[residual_colour(point.residual_m, scene.full_colour_m)] + "\"/>";
  }
  return out;
}

std::string margins_svg(const RegistrationView& view, const PageArea& area) {
  const double middle_x = 0.5 * (area.low_mm.x + area.high_mm.x);
  const double middle_y = 0.5 * (area.low_mm.y + area.high_mm.y);
  const auto word = [](const char* anchor, double x, double y, const char* name) {
    return std::string("<text text-anchor=\"") + anchor +
           formatted("\" x=\"%.2f\" y=\"%.2f\">", x, y) + name + "</text>";
  };
  const double x = area.high_mm.x - 13.0;
  const double y = area.high_mm.y - 2.0;
  return word("start", area.low_mm.x + 1.0, middle_y, view.left) +
         word("end", area.high_mm.x - 1.0, middle_y, view.right) +
         word("middle", middle_x, area.low_mm.y + 4.0, view.top) +
         word("middle", middle_x, area.high_mm.y - 1.2, view.bottom) +
         formatted("<path class=\"scale\" d=\"M%.2f %.2fv-1.5m0 .75h10m0-.75v1.5\"/>", x,
                   y + 0.75) +
         word("middle", x + 5.0, y - 1.5, "10 mm");
}

}  // namespace

std::array<RegistrationView, 3> registration_views() {
  constexpr const char* kUnlikeAnAxialSlice =
      ", from the head: the patient\u2019s left is on the left. An axial CT slice is seen from the "
      "feet, with the patient\u2019s right on the left: this is its mirror image.";
  const Vec3 left{1, 0, 0};
  const Vec3 back{0, 1, 0};
  const Vec3 head{0, 0, 1};
  return {{{"from behind", {-left, head, back}, "left", "right", "head", "feet"},
           {"from the left", {back, head, left}, "front", "back", "head", "feet"},
           {"from above",
            {-left, -back, head},
            "left",
            "right",
            "front",
            "back",
            kUnlikeAnAxialSlice}}};
}

std::string hex(Rgb c) { return printed("#%02x%02x%02x", c.red, c.green, c.blue); }

namespace {

/// The picture itself, for callers that must know what it hides.
DepthPicture shaded_bone(const RegisteredLevel& level, const PageArea& area, const Viewpoint& from,
                         const SurfacePaint& paint) {
  DepthPicture bone(from, area, kPixelsPerMm);
  bone.draw(level.model->mesh(), {{}, 0.0, kUntouchable, kUntouchable});
  bone.draw(level.model->reachable(), paint);
  return bone;
}

/// The SVG element is still open.
Result<RegistrationDrawing> framed(const DepthPicture& bone, const PageArea& area,
                                   const RegistrationView& view) {
  const auto png = png_bytes(bone.image());
  if (!png) {
    return png.error();
  }
  const Vec2 size = area.size_mm();
  const std::string box = formatted("x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\"",
                                    area.low_mm.x, area.low_mm.y, size.x, size.y);
  std::string svg = formatted("<svg viewBox=\"%.2f %.2f %.2f %.2f\"", area.low_mm.x, area.low_mm.y,
                              size.x, size.y) +
                    " role=img aria-label=\"" + view.name + "\"><image " + box +
                    " preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
                    base64({reinterpret_cast<const std::uint8_t*>(png->data()), png->size()}) +
                    "\"/>";
  return RegistrationDrawing{std::move(svg), size};
}

}  // namespace

Result<RegistrationDrawing> bone_drawing(const RegisteredLevel& level,
                                         const RegistrationScene& scene,
                                         const RegistrationView& view, const SurfacePaint& paint) {
  const PageArea area = area_of(level, scene, view.from);
  auto drawing = framed(shaded_bone(level, area, view.from, paint), area, view);
  if (drawing) {
    drawing->svg += margins_svg(view, area);
  }
  return drawing;
}

Result<RegistrationDrawing> registration_drawing(const RegisteredLevel& level,
                                                 const RegistrationScene& scene,
                                                 const RegistrationView& view) {
  const PageArea area = area_of(level, scene, view.from);
  const DepthPicture bone = shaded_bone(
      level, area, view.from, {scene.from_strokes_m, kStroked_m, kStrokedBone, kOpenBone});
  auto drawing = framed(bone, area, view);
  if (drawing) {
    drawing->svg += points_svg(scene, view.from, bone) + screws_svg(level, scene, view.from) +
                    checks_svg(scene, view.from) + margins_svg(view, area) + "</svg>";
  }
  return drawing;
}

std::string registration_legend(const RegisteredLevel& level, const RegistrationScene& scene) {
  const auto swatch = [](const std::string& colour, const std::string& words) {
    return "<span><i style=\"background:" + colour + "\"></i>" + words + "</span>";
  };
  std::string out = "<div class=legend><span class=ramp>" +
                    html_number(-scene.full_colour_m * 1e3, 1) + " mm <b>";
  for (const char* colour : kResidualColours) {
    out += "<i style=\"background:" + std::string(colour) + "\"></i>";
  }
  out += "</b> +" + html_number(scene.full_colour_m * 1e3, 1) +
         " mm<em>points inside the bone, on it, outside it</em></span>";
  if (scene.off_bone > 0) {
    out += std::string("<span><b class=cross>\u00d7</b>outlier") +
           (is_judged(level.registration) ? ", not used" : "") + "</span>";
  }
  if (!scene.checks.empty()) {
    out += "<span><b class=cross>\u25c7</b>touched to verify it</span>";
  }
  out += swatch(hex(kStrokedBone), "stroked (within 5 mm)") +
         swatch(hex(kOpenBone), "not stroked") +
         swatch(hex(kUntouchable), "out of the pointer\u2019s reach");
  if (!level.screws.empty() && level.registration.uncertainty) {
    out += "<span><i class=oval></i><em>95 % error ellipsoid at entry and target" +
           (scene.magnified > 1.0 ? " (drawn <b>" + html_number(scene.magnified, 0) + "\u00d7</b>)"
                                  : std::string(", true size")) +
           (scene.one_scale ? "; at one scale in this report" : "") + "</em></span>";
  }
  return out + "</div>";
}

}  // namespace orthonav::engine
