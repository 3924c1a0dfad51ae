#include "nav/geometry/spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/printed.h"

namespace orthonav::nav {
namespace {

constexpr double kClosest_m = 1e-4;
constexpr double kLengthTolerance_m = 1e-6;
constexpr int kDeepest = 24;

struct Node {
  double x;
  double weight;
};
// Gauss-Legendre with 5 nodes on [-1, 1] (Abramowitz & Stegun, table 25.4).
constexpr std::array<Node, 5> kGauss = {{{-0.9061798459386640, 0.2369268850561891},
                                         {-0.5384693101056831, 0.4786286704993665},
                                         {0.0, 0.5688888888888889},
                                         {0.5384693101056831, 0.4786286704993665},
                                         {0.9061798459386640, 0.2369268850561891}}};

/// The length from a to b of a segment by one Gauss rule.
double gauss_m(const CatmullRom& curve, std::size_t segment, double a, double b) {
  double sum = 0.0;
  for (const Node& node : kGauss) {
    sum += node.weight * curve.derivative(segment, 0.5 * (a + b) + 0.5 * (b - a) * node.x).norm();
  }
  return 0.5 * (b - a) * sum;
}

/// Halves the interval until both halves agree with the whole.
double adaptive_m(const CatmullRom& curve, std::size_t segment, double a, double b, double whole_m,
                  double tolerance_m, int depth) {
  const double middle = 0.5 * (a + b);
  const double left_m = gauss_m(curve, segment, a, middle);
  const double right_m = gauss_m(curve, segment, middle, b);
  if (depth >= kDeepest || std::abs(left_m + right_m - whole_m) <= tolerance_m) {
    return left_m + right_m;
  }
  return adaptive_m(curve, segment, a, middle, left_m, 0.5 * tolerance_m, depth + 1) +
         adaptive_m(curve, segment, middle, b, right_m, 0.5 * tolerance_m, depth + 1);
}

double arc_m(const CatmullRom& curve, std::size_t segment, double to) {
  const double tolerance_m = kLengthTolerance_m / static_cast<double>(curve.segments());
  return adaptive_m(curve, segment, 0.0, to, gauss_m(curve, segment, 0.0, to), tolerance_m, 0);
}

/// The parameter at which a segment is `target_m` long: Newton, kept inside a shrinking bracket.
double parameter_at(const CatmullRom& curve, std::size_t segment, double target_m,
                    double length_m) {
  double low = 0.0;
  double high = 1.0;
  double t = std::clamp(target_m / length_m, 0.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    const double excess_m = arc_m(curve, segment, t) - target_m;
    if (std::abs(excess_m) < 1e-9) {
      break;
    }
    (excess_m > 0.0 ? high : low) = t;
    const double next = t - excess_m / curve.derivative(segment, t).norm();
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  return t;
}

/// The spline's knots around a segment: |difference|^0.5 apart (Barry & Goldman 1988).
struct Knots {
  std::array<double, 4> u;
};
Knots knots_of(const Vec3* p) {
  Knots k{};
  for (std::size_t i = 1; i < 4; ++i) {
    k.u[i] = k.u[i - 1] + std::sqrt((p[i] - p[i - 1]).norm());
  }
  return k;
}

/// Tangents at the middle two points by the segment's parameter t: the derivative of the
/// non-uniform Catmull-Rom spline, scaled to the knot span.
struct Tangents {
  Vec3 at_start;
  Vec3 at_end;
};
Tangents tangents_of(const Vec3* p) {
  const Knots k = knots_of(p);
  const double d01 = k.u[1] - k.u[0];
  const double d12 = k.u[2] - k.u[1];
  const double d23 = k.u[3] - k.u[2];
  const Vec3 m1 = (p[1] - p[0]) / d01 - (p[2] - p[0]) / (d01 + d12) + (p[2] - p[1]) / d12;
  const Vec3 m2 = (p[2] - p[1]) / d12 - (p[3] - p[1]) / (d12 + d23) + (p[3] - p[2]) / d23;
  return {d12 * m1, d12 * m2};
}

}  // namespace

Result<CatmullRom> CatmullRom::through(std::span<const Vec3> points_m) {
  if (points_m.size() < 2) {
    return Error{"spline needs at least 2 points, got " + std::to_string(points_m.size())};
  }
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    if (!points_m[i].is_finite()) {
      return Error{"spline point " + std::to_string(i) + " is not finite"};
    }
    if (i == 0) {
      continue;
    }
    const double gap_m = (points_m[i] - points_m[i - 1]).norm();
    if (!(gap_m >= kClosest_m)) {
      return Error{printed("spline points %zu and %zu are %s mm apart, limit 0.1 mm", i - 1, i,
                           value_beside(gap_m * 1e3, kClosest_m * 1e3, 4).c_str())};
    }
  }
  CatmullRom curve;
  curve.points_m_.reserve(points_m.size() + 2);
  curve.points_m_.push_back(2.0 * points_m[0] - points_m[1]);
  curve.points_m_.insert(curve.points_m_.end(), points_m.begin(), points_m.end());
  curve.points_m_.push_back(2.0 * points_m.back() - points_m[points_m.size() - 2]);
  return curve;
}

Vec3 CatmullRom::position(std::size_t segment, double t) const {
  const Vec3* p = &points_m_[segment];
  const Tangents m = tangents_of(p);
  const double t2 = t * t;
  const double t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * p[1] + (t3 - 2.0 * t2 + t) * m.at_start +
         (3.0 * t2 - 2.0 * t3) * p[2] + (t3 - t2) * m.at_end;
}

Vec3 CatmullRom::derivative(std::size_t segment, double t) const {
  const Vec3* p = &points_m_[segment];
  const Tangents m = tangents_of(p);
  const double t2 = t * t;
  return (6.0 * t2 - 6.0 * t) * p[1] + (3.0 * t2 - 4.0 * t + 1.0) * m.at_start +
         (6.0 * t - 6.0 * t2) * p[2] + (3.0 * t2 - 2.0 * t) * m.at_end;
}

double CatmullRom::segment_length_m(std::size_t segment) const {
  return arc_m(*this, segment, 1.0);
}

double CatmullRom::length_m() const {
  double sum_m = 0.0;
  for (std::size_t i = 0; i < segments(); ++i) {
    sum_m += segment_length_m(i);
  }
  return sum_m;
}

std::vector<Vec3> CatmullRom::sampled(double spacing_m) const {
  std::vector<double> lengths_m(segments());
  double total_m = 0.0;
  for (std::size_t i = 0; i < segments(); ++i) {
    total_m += lengths_m[i] = segment_length_m(i);
  }
  constexpr double kMaxIntervals = 1e5;
  const double wanted = spacing_m > 0.0 ? std::round(total_m / spacing_m) : kMaxIntervals;
  const auto intervals = static_cast<std::size_t>(std::clamp(wanted, 1.0, kMaxIntervals));
  std::vector<Vec3> path_m;
  path_m.reserve(intervals + 1);
  path_m.push_back(points_m_[1]);
  std::size_t segment = 0;
  double before_m = 0.0;
  for (std::size_t k = 1; k < intervals; ++k) {
    const double s_m = total_m * static_cast<double>(k) / static_cast<double>(intervals);
    while (segment + 1 < segments() && s_m > before_m + lengths_m[segment]) {
      before_m += lengths_m[segment++];
    }
    const double t = parameter_at(*this, segment, s_m - before_m, lengths_m[segment]);
    path_m.push_back(position(segment, t));
  }
  path_m.push_back(points_m_[points_m_.size() - 2]);
  return path_m;
}

}  // namespace orthonav::nav
