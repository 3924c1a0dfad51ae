#include "nav/registration/estimated_heights.h"

#include <algorithm>
#include <unordered_map>

#include "nav/registration/cells.h"
#include "nav/registration/height_model.h"

namespace orthonav::nav {
namespace {

/// The remaining ones would not change the result visibly.
constexpr std::size_t kMaxHypotheses = 3;
constexpr double kNear_m = 0.004;
constexpr std::size_t kFewestPairs = 100;
/// Number of points whose neighbours are searched; more would add nothing.
constexpr std::size_t kMostPoints = 1500;

std::vector<FieldHypothesis> likeliest(std::vector<FieldHypothesis> all) {
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
  all.resize(std::min(all.size(), kMaxHypotheses));
  return all;
}

struct OnStroke {
  Vec3 at_m;
  double height_m = 0.0;
  int stroke = 0;
};

std::vector<OnStroke> about_their_mean(const SurfaceFit& fit, const ResidualUnits& units) {
  std::vector<OnStroke> out;
  const std::size_t step = std::max<std::size_t>(1, units.order.size() / kMostPoints);
  double mean_m = 0.0;
  for (std::size_t k = 0; k < units.order.size(); k += step) {
    const FittedPoint& p = fit.points[units.order[k]];
    out.push_back({p.lever_arm_m, p.residual_m, units.stroke[k]});
    mean_m += p.residual_m;
  }
  for (OnStroke& p : out) {
    p.height_m -= mean_m / static_cast<double>(out.size());
  }
  return out;
}

}  // namespace

std::vector<EstimatedHeight> estimated_heights(const SurfaceFit& fit, const ResidualUnits& units,
                                               const ResidualField& field) {
  const AlongStrokes seen = along_strokes(fit, units);
  if (seen.covariance_m2.empty()) {
    return {};
  }
  HeightModel model(fit, units);
  std::vector<EstimatedHeight> out;
  for (const ResidualUnit& unit : units.all) {
    out.push_back({{fit.pose.centre_m + 0.5 * (unit.halves_m[0] + unit.halves_m[1])}, 0.0});
  }
  double probability = 0.0;
  for (const FieldHypothesis& hypothesis : likeliest(field.hypotheses)) {
    const auto estimated =
        model.heights_without_noise(hypothesis, noise_beside_field(seen, hypothesis));
    if (estimated.empty()) {
      continue;
    }
    probability += hypothesis.probability;
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].height_m += hypothesis.probability * estimated[i];
    }
  }
  if (!(probability > 0.0)) {
    return {};
  }
  for (EstimatedHeight& height : out) {
    height.height_m /= probability;
  }
  return out;
}

double correlation_across_strokes(const SurfaceFit& fit, const ResidualUnits& units) {
  if (!units.along_strokes) {
    return 0.0;
  }
  std::unordered_map<GridCell, std::vector<OnStroke>, HashOfCell> cells;
  double product_m2 = 0.0;
  double squares_m2 = 0.0;
  std::size_t pairs = 0;
  for (const OnStroke& p : about_their_mean(fit, units)) {
    const GridCell here = cell_of(p.at_m, kNear_m);
    for (int i = 0; i < 27; ++i) {
      const auto there =
          cells.find({here[0] + i % 3 - 1, here[1] + i / 3 % 3 - 1, here[2] + i / 9 - 1});
      if (there == cells.end()) {
        continue;
      }
      for (const OnStroke& q : there->second) {
        if (q.stroke != p.stroke && (q.at_m - p.at_m).squared_norm() < kNear_m * kNear_m) {
          product_m2 += p.height_m * q.height_m;
          squares_m2 += 0.5 * (p.height_m * p.height_m + q.height_m * q.height_m);
          ++pairs;
        }
      }
    }
    cells[here].push_back(p);
  }
  return pairs < kFewestPairs ? 0.0 : product_m2 / squares_m2;
}

}  // namespace orthonav::nav
