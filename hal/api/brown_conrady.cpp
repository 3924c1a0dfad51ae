#include "hal/api/brown_conrady.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/printed.h"

namespace orthonav {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr double kFinalStepPx = 1e-9;
constexpr int kMaxSteps = 30;

/// The radial factor and its derivative by the radius, divided by the radius.
struct Radial {
  double factor = 1.0;
  double slope = 0.0;
};

Radial radial_at(const BrownConrady& p, double r2) {
  const double above = 1.0 + r2 * (p.k1 + r2 * (p.k2 + r2 * p.k3));
  const double below = 1.0 + r2 * (p.k4 + r2 * (p.k5 + r2 * p.k6));
  const double above_slope = 2.0 * (p.k1 + r2 * (2.0 * p.k2 + 3.0 * r2 * p.k3));
  const double below_slope = 2.0 * (p.k4 + r2 * (2.0 * p.k5 + 3.0 * r2 * p.k6));
  const double factor = above / below;
  return {factor, (above_slope - factor * below_slope) / below};
}

/// Derivative of BrownConrady::distort in pixels by the unit-plane point: columns along x and y.
std::array<Vec2, 2> distort_jacobian(const BrownConrady& p, Vec2 u) {
  const auto [radial, slope] = radial_at(p, u.dot(u));
  const double mixed = u.x * u.y * slope + 2.0 * p.p1 * u.x + 2.0 * p.p2 * u.y;
  const double xx = radial + u.x * u.x * slope + 2.0 * p.p1 * u.y + 6.0 * p.p2 * u.x;
  const double yy = radial + u.y * u.y * slope + 6.0 * p.p1 * u.y + 2.0 * p.p2 * u.x;
  return {{{p.fx_px * xx, p.fy_px * mixed}, {p.fx_px * mixed, p.fy_px * yy}}};
}

}  // namespace

Vec2 BrownConrady::distort(Vec2 u) const {
  const double r2 = u.dot(u);
  const double radial = radial_at(*this, r2).factor;
  const double x = u.x * radial + 2.0 * p1 * u.x * u.y + p2 * (r2 + 2.0 * u.x * u.x);
  const double y = u.y * radial + p1 * (r2 + 2.0 * u.y * u.y) + 2.0 * p2 * u.x * u.y;
  return {fx_px * x + cx_px, fy_px * y + cy_px};
}

Vec2 undistorted(const BrownConrady& p, Vec2 pixel_px) {
  Vec2 u{(pixel_px.x - p.cx_px) / p.fx_px, (pixel_px.y - p.cy_px) / p.fy_px};
  for (int i = 0; i < kMaxSteps; ++i) {
    const Vec2 off = pixel_px - p.distort(u);
    const auto [by_x, by_y] = distort_jacobian(p, u);
    const double determinant = by_x.cross(by_y);
    if (!(determinant > 0.0)) {
      return {kUndefined, kUndefined};
    }
    const Vec2 step{off.cross(by_y) / determinant, by_x.cross(off) / determinant};
    u = u + step;
    if (step.norm() * p.fx_px < kFinalStepPx) {
      const auto [last_by_x, last_by_y] = distort_jacobian(p, u);
      return last_by_x.cross(last_by_y) > 0.0 ? u : Vec2{kUndefined, kUndefined};
    }
  }
  return {kUndefined, kUndefined};
}

Status checked_parameters(const BrownConrady& p) {
  for (const double v :
       {p.fx_px, p.fy_px, p.cx_px, p.cy_px, p.k1, p.k2, p.p1, p.p2, p.k3, p.k4, p.k5, p.k6}) {
    if (!std::isfinite(v)) {
      return Error{"camera parameters hold a number that is not finite"};
    }
  }
  if (p.fx_px <= 0.0 || p.fy_px <= 0.0) {
    return Error{"camera focal length is " + printed("%f", std::min(p.fx_px, p.fy_px)) +
                 " px, must be positive"};
  }
  return {};
}

}  // namespace orthonav
