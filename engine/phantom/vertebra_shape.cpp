#include "engine/phantom/vertebra_shape.h"

#include <algorithm>
#include <cmath>

namespace orthonav::engine {
namespace {

constexpr double kBlend_m = 0.0045;  ///< radius over which processes blend into each other
constexpr double kBodyBlend_m = 0.0065;
constexpr double kCanalBlend_m = 0.0020;
constexpr double kRim_m = 0.0030;    ///< rounding of the endplates' rims
constexpr double kWaist_m = 0.0022;  ///< the body is this much narrower at half height
constexpr double kEndplateHollow_m = 0.0016;
constexpr double kMargin_m = 0.004;

/// Minimum of two, rounded over `k` (cubic polynomial of Quilez: twice differentiable).
double smooth_min(double a, double b, double k) {
  const double apart = std::abs(a - b);
  if (apart >= k) {
    return std::min(a, b);
  }
  const double h = (k - apart) / k;
  return std::min(a, b) - h * h * h * k / 6.0;
}

double smooth_max(double a, double b, double k) { return -smooth_min(-a, -b, k); }

/// Maximum of two, the edge rounded off with radius `r`.
double rounded_max(double a, double b, double r) {
  return std::min(std::max(a, b), -r) + std::hypot(std::max(a + r, 0.0), std::max(b + r, 0.0));
}

double mix(double a, double b, double t) { return a + t * (b - a); }

}  // namespace

double VertebraMorphometry::wedge_rad() const {
  return std::atan2(anterior_height_m - posterior_height_m, depth_m());
}

VertebraShape::Bar VertebraShape::bar(Vec3 from, Vec3 to, Vec3 normal, Vec2 widths,
                                      Vec2 thicknesses) {
  Bar made;
  made.from = from;
  made.to = to;
  made.length = (to - from).norm();
  made.along = (to - from) / made.length;
  made.normal = (normal - made.along * normal.dot(made.along)).normalized();
  made.across = made.normal.cross(made.along);
  made.width_from = 0.5 * widths.x;
  made.width_to = 0.5 * widths.y;
  made.thickness_from = 0.5 * thicknesses.x;
  made.thickness_to = 0.5 * thicknesses.y;
  return made;
}

double VertebraShape::Bar::value(Vec3 p) const {
  const Vec3 d = p - from;
  const double s = d.dot(along);
  const double t = std::clamp(s / length, 0.0, 1.0);
  const double width = mix(width_from, width_to, t);
  const double thickness = mix(thickness_from, thickness_to, t);
  const double end = std::sqrt(width * thickness);
  const Vec3 q = {d.dot(across), d.dot(normal), s - t * length};
  // Distance to an ellipsoid, first order (exact on its surface).
  const Vec3 scaled = {q.x / width, q.y / thickness, q.z / end};
  const double k0 = scaled.norm();
  const double k1 = Vec3{scaled.x / width, scaled.y / thickness, scaled.z / end}.norm();
  return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -end;
}

VertebraShape::VertebraShape(const VertebraMorphometry& m) : m_(m) {
  back_of_body_m_ = 0.5 * m.depth_m();
  body_reach_m_ = 0.5 * std::hypot(std::max(m.lower_width_m, m.upper_width_m),
                                   std::max(m.lower_depth_m, m.upper_depth_m));
  // The pedicles leave the upper half of the body, beside the canal.
  pedicle_waist_ = {0.5 * (m.canal_width_m + m.pedicle_width_m), back_of_body_m_ + 0.004,
                    0.5 * m.posterior_height_m - 0.5 * m.pedicle_height_m - 0.0002};
  add_pedicle_and_transverse_process();
  add_articular_processes();
  add_lamina();
  add_spinous_process();
}

nav::Axis<Vertebra> VertebraShape::pedicle_axis(nav::Side side) const {
  const double sign = side == nav::Side::kLeft ? 1.0 : -1.0;
  const double flat = std::cos(m_.pedicle_sagittal_rad);
  return {{{sign * pedicle_waist_.x, pedicle_waist_.y, pedicle_waist_.z}},
          {-sign * std::sin(m_.pedicle_transverse_rad) * flat,
           -std::cos(m_.pedicle_transverse_rad) * flat, std::sin(m_.pedicle_sagittal_rad)}};
}

void VertebraShape::add_pedicle_and_transverse_process() {
  const nav::Axis<Vertebra> axis = pedicle_axis(nav::Side::kLeft);
  const Vec3 waist = axis.point.v;
  const Vec3 sideways{1, 0, 0};
  left_bars_.push_back(bar(waist + axis.direction * 0.009, waist, sideways,
                           {1.05 * m_.pedicle_height_m, m_.pedicle_height_m},
                           {1.10 * m_.pedicle_width_m, m_.pedicle_width_m}));
  left_bars_.push_back(bar(waist, waist - axis.direction * 0.008, sideways,
                           {m_.pedicle_height_m, 0.98 * m_.pedicle_height_m},
                           {m_.pedicle_width_m, 1.12 * m_.pedicle_width_m}));
  const Vec3 root = waist - axis.direction * 0.007 + Vec3{0.25 * m_.pedicle_width_m, 0, -0.001};
  const Vec2 heights{1.25 * m_.transverse_height_m, 0.85 * m_.transverse_height_m};
  const Vec2 thicknesses{1.3 * m_.transverse_thickness_m, 0.65 * m_.transverse_thickness_m};
  const double end = 0.5 * std::sqrt(heights.y * thicknesses.y);
  const Vec3 tip = {0.5 * m_.transverse_span_m - end, root.y + m_.transverse_back_m,
                    root.z + m_.transverse_rise_m};
  left_bars_.push_back(bar(root, tip, {0, 1, 0}, heights, thicknesses));
}

void VertebraShape::add_articular_processes() {
  const double canal_back = back_of_body_m_ + m_.canal_depth_m;
  const Vec3 waist = pedicle_waist_;
  const Vec3 upper_normal = {-std::sin(m_.superior_rotation_rad),
                             std::cos(m_.superior_rotation_rad), 0.1};
  const Vec3 upper_facet = {0.5 * m_.superior_distance_m + 0.0042, canal_back - 0.0035,
                            waist.z + 0.5 * m_.superior_height_m + 0.0015};
  left_bars_.push_back(bar({waist.x, waist.y + 0.009, waist.z - 0.003}, upper_facet, upper_normal,
                           {1.1 * m_.superior_width_m, 1.15 * m_.superior_width_m},
                           {0.0095, 0.0070}));
  // The mammillary process, behind the facet.
  left_bars_.push_back(bar(upper_facet + Vec3{0.0010, 0.0005, -0.0060},
                           upper_facet + Vec3{0.0030, 0.0065, -0.0025}, {1, 0, 0}, {0.0120, 0.0105},
                           {0.0080, 0.0065}));
  const Vec3 lower_normal = {std::sin(m_.inferior_rotation_rad),
                             -std::cos(m_.inferior_rotation_rad), 0};
  const Vec3 lower_tip = {0.5 * m_.inferior_distance_m - 0.001, canal_back + 0.0035,
                          waist.z - m_.inferior_drop_m + 0.5 * m_.inferior_height_m - 0.0025};
  const Vec3 isthmus = {mix(waist.x, lower_tip.x, 0.45), canal_back - 0.0010, waist.z - 0.009};
  left_bars_.push_back(
      bar(isthmus, lower_tip, lower_normal, {0.0185, m_.inferior_width_m}, {0.0085, 0.0080}));
  // The pars between the two.
  left_bars_.push_back(bar({waist.x - 0.0005, waist.y + 0.009, waist.z - 0.001}, isthmus,
                           {0.3, 1, 0.2}, {0.0130, 0.0130}, {0.0090, 0.0085}));
}

void VertebraShape::add_lamina() {
  const double canal_back = back_of_body_m_ + m_.canal_depth_m;
  const Vec3 outer = {0.42 * m_.canal_width_m + 0.001, canal_back - 0.0010,
                      pedicle_waist_.z - 0.0095};
  const Vec3 inner = {0.0030, canal_back + 0.0045, pedicle_waist_.z - 0.0115};
  left_bars_.push_back(bar(outer, inner, {0.45, 1, 0.30}, {0.0195, 0.0185}, {0.0074, 0.0078}));
}

void VertebraShape::add_spinous_process() {
  const double canal_back = back_of_body_m_ + m_.canal_depth_m;
  const double top = pedicle_waist_.z - 0.0120;
  const double thickness = m_.spinous_thickness_m;
  const double end = 0.5 * std::sqrt(m_.spinous_height_m * thickness);
  const Vec3 root = {0, canal_back + 0.004, top};
  const Vec3 tip = {0, canal_back + m_.spinous_length_m - end, top - m_.spinous_drop_m};
  middle_bars_.push_back(bar(root, tip, {1, 0, 0},
                             {0.85 * m_.spinous_height_m, m_.spinous_height_m},
                             {1.05 * thickness, 0.95 * thickness}));
  // The tip is thickest behind and below.
  const Vec3 low = tip + Vec3{0, -0.0015, -0.22 * m_.spinous_height_m};
  const Vec3 high = tip + Vec3{0, 0.0015, 0.15 * m_.spinous_height_m};
  middle_bars_.push_back(
      bar(low, high, {1, 0, 0}, {0.0105, 0.0085}, {1.35 * thickness, 0.95 * thickness}));
}

double VertebraShape::body(Vec3 p) const {
  const double half_height = 0.5 * mix(m_.posterior_height_m, m_.anterior_height_m,
                                       std::clamp(0.5 - p.y / m_.depth_m(), -0.2, 1.2));
  const double t = std::clamp(p.z / half_height, -1.0, 1.0);
  const double waist = kWaist_m * (1.0 - t * t);
  const double a = 0.5 * mix(m_.lower_width_m, m_.upper_width_m, 0.5 * (t + 1.0)) - waist;
  const double b = 0.5 * mix(m_.lower_depth_m, m_.upper_depth_m, 0.5 * (t + 1.0)) - 0.7 * waist;
  // A superellipse, fuller than an ellipse and flatter behind.
  const double exponent = p.y > 0.0 ? 2.5 : 2.2;
  const double r =
      std::pow(std::pow(std::abs(p.x) / a, exponent) + std::pow(std::abs(p.y) / b, exponent),
               1.0 / exponent);
  const double from_axis = std::hypot(p.x, p.y);
  const double around = r > 1e-9 ? from_axis * (1.0 - 1.0 / r) : -b;
  const double hollow = kEndplateHollow_m * std::max(0.0, 1.0 - r * r);
  return rounded_max(around, std::abs(p.z) - half_height + hollow, kRim_m);
}

double VertebraShape::canal(Vec3 p) const {
  const double half_depth = 0.5 * m_.canal_depth_m;
  const double y = p.y - back_of_body_m_ - half_depth;
  // A rounded triangle, narrow at the back.
  const double taper = 1.0 - 0.30 * std::clamp(y / half_depth, -1.0, 1.0);
  const double a = 0.5 * m_.canal_width_m * taper / 1.12;
  const double r = std::sqrt(std::pow(std::abs(p.x) / a, 2.0) + std::pow(y / half_depth, 2.0));
  return r > 1e-9 ? std::hypot(p.x, y) * (1.0 - 1.0 / r) : -half_depth;
}

/// Undoes the bend of the spinous process to one side, so that the rest may be symmetric.
Vec3 VertebraShape::straightened(Vec3 p) const {
  const double start = back_of_body_m_ + m_.canal_depth_m;
  const double along = std::clamp((p.y - start) / m_.spinous_length_m, 0.0, 1.2);
  p.x -= m_.spinous_deviation_m * along * along;
  return p;
}

double VertebraShape::value(Vec3 p) const {
  const Vec3 q = straightened(p);
  const Vec3 left = {std::abs(q.x), q.y, q.z};
  double arch = 1.0;
  for (const Bar& bar : left_bars_) {
    arch = smooth_min(arch, bar.value(left), kBlend_m);
  }
  for (const Bar& bar : middle_bars_) {
    arch = smooth_min(arch, bar.value(q), kBlend_m);
  }
  arch = smooth_max(arch, -canal(p), kCanalBlend_m);
  // Of the body this much is certain; it blends in no farther away.
  const bool far = std::hypot(p.x, p.y) - body_reach_m_ > arch + kBodyBlend_m;
  return far ? arch : smooth_min(arch, body(p), kBodyBlend_m);
}

Vec3 VertebraShape::low_m() const {
  return {-0.5 * m_.transverse_span_m - kMargin_m,
          -0.5 * std::max(m_.upper_depth_m, m_.lower_depth_m) - kMargin_m,
          pedicle_waist_.z - m_.inferior_drop_m - 0.004 - kMargin_m};
}

Vec3 VertebraShape::high_m() const {
  return {0.5 * m_.transverse_span_m + kMargin_m,
          back_of_body_m_ + m_.canal_depth_m + m_.spinous_length_m + kMargin_m,
          pedicle_waist_.z + 0.5 * m_.superior_height_m + 0.014};
}

}  // namespace orthonav::engine
