#include "nav/calibration/stereo_jackknife.h"

#include <algorithm>
#include <cmath>

#include "nav/statistics/blocked_jackknife.h"

namespace orthonav::nav {
namespace {

constexpr std::size_t kFewestViews = 4;

/// SD of the overall value from the values without each group.
double jackknife(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double v : values) {
    mean += v / count;
  }
  double squared = 0.0;
  for (const double v : values) {
    squared += (v - mean) * (v - mean);
  }
  return std::sqrt((count - 1.0) / count * squared);
}

/// The same for vectors: the length of the vector of SDs.
double jackknife(const std::vector<Vec3>& values) {
  double squared = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> component;
    for (const Vec3& v : values) {
      component.push_back(v[axis]);
    }
    squared += std::pow(jackknife(component), 2);
  }
  return std::sqrt(squared);
}

template <class Number>
double jackknife_of(const std::vector<StereoFit>& fits, Number number) {
  std::vector<double> values;
  for (const StereoFit& fit : fits) {
    values.push_back(number(fit));
  }
  return jackknife(values);
}

double principal_point_px(const std::vector<StereoFit>& fits, BrownConrady StereoFit::*camera) {
  return std::hypot(jackknife_of(fits, [&](const StereoFit& f) { return (f.*camera).cx_px; }),
                    jackknife_of(fits, [&](const StereoFit& f) { return (f.*camera).cy_px; }));
}

double focal_fraction(const std::vector<StereoFit>& fits, BrownConrady StereoFit::*camera) {
  const double fx_px = jackknife_of(fits, [&](const StereoFit& f) { return (f.*camera).fx_px; });
  return fx_px / (fits.front().*camera).fx_px;
}

}  // namespace

std::optional<StereoSigma> stereo_sigma(const Chessboard& board, ImageSize size,
                                        const BoardViews& views, const StereoFit& fit,
                                        LensTerms terms) {
  const std::size_t count = views.left.size();
  if (count < kFewestViews) {
    return std::nullopt;
  }
  const std::size_t groups = std::min(kJackknifeBlocks, count);
  std::vector<StereoFit> fits;
  std::vector<Vec3> rotations;
  for (std::size_t group = 0; group < groups; ++group) {
    BoardViews rest;
    for (std::size_t i = 0; i < count; ++i) {
      if (i % groups != group) {
        rest.left.push_back(views.left[i]);
        rest.right.push_back(views.right[i]);
      }
    }
    const auto again = fit_stereo(board, size, rest.left, rest.right, fit.left, fit.right, terms);
    if (!again) {
      return std::nullopt;
    }
    rotations.push_back(vector_from_rotation(again->right_from_left.rotation() *
                                             fit.right_from_left.rotation().transposed()));
    fits.push_back(*again);
  }
  StereoSigma sigma;
  sigma.baseline_m =
      jackknife_of(fits, [](const StereoFit& f) { return f.right_from_left.translation().norm(); });
  sigma.rotation_rad = jackknife(rotations);
  sigma.focal_fraction =
      std::max(focal_fraction(fits, &StereoFit::left), focal_fraction(fits, &StereoFit::right));
  sigma.principal_point_px = std::max(principal_point_px(fits, &StereoFit::left),
                                      principal_point_px(fits, &StereoFit::right));
  return sigma;
}

}  // namespace orthonav::nav
