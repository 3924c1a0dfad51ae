#include "nav/tracking/corner_refinement.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "nav/statistics/median.h"
#include "nav/tracking/bilinear.h"

namespace orthonav::nav {
namespace {

/// How far across an edge its true position is searched for. Farther out lies the next cell: the
/// cells of a small tag are three pixels wide.
constexpr double kReach_px = 1.25;

// About one ray per pixel of an edge, within these limits.
constexpr int kFewestRays = 8;
constexpr int kMaxRays = 200;
// A shorter edge has no middle part that its corners leave undisturbed.
constexpr double kShortestEdgePx = 6.0;
constexpr double kStepPx = 0.25;
constexpr double kHalfBasePx = 0.5;
// How much of each end of an edge is left out: the neighbouring edge's blur reaches there.
constexpr double kEndPx = 1.0;
constexpr double kEndFraction = 0.08;
// A sum of squared slopes below this is noise, in squared grey levels.
constexpr double kFaintest = 1.0;
// Tukey's constant: 95 % efficient for normal errors.
constexpr double kTukey = 4.685;
constexpr double kMadToSd = 1.4826;
constexpr double kLeastScalePx = 0.05;
constexpr int kReweightings = 5;
// The intersection of nearly parallel edges is meaningless.
constexpr double kLeastSine = 0.05;

struct Line {
  Vec2 point;
  Vec2 direction;  ///< of length 1
};

/// Where a ray crosses an edge, and how clearly.
struct Crossing {
  Vec2 place;
  double steepness = 0.0;
};

double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// +1 when the image gets brighter along the normal, else -1.
double sense_of(const GreyImage& image, Vec2 a, Vec2 b, Vec2 normal) {
  constexpr int kProbes = 9;
  double brighter = 0.0;
  for (int i = 1; i <= kProbes; ++i) {
    const Vec2 p = a + (i / (kProbes + 1.0)) * (b - a);
    brighter += grey_at(image, p + 1.5 * normal) - grey_at(image, p - 1.5 * normal);
  }
  return brighter < 0 ? -1.0 : 1.0;
}

std::optional<Crossing> crossing(const GreyImage& image, Vec2 base, Vec2 rising, double reach_px) {
  double sum = 0.0;
  double total = 0.0;
  const int steps = static_cast<int>(std::lround(reach_px / kStepPx));
  for (int i = -steps; i <= steps; ++i) {
    const double n = i * kStepPx;
    const double slope = grey_at(image, base + (n + kHalfBasePx) * rising) -
                         grey_at(image, base + (n - kHalfBasePx) * rising);
    if (slope <= 0) {
      continue;
    }
    sum += slope * slope * n;
    total += slope * slope;
  }
  if (total < kFaintest) {
    return std::nullopt;
  }
  return Crossing{base + (sum / total) * rising, std::sqrt(total)};
}

/// Total least squares with these weights; nothing when all of them are zero.
std::optional<Line> line_through(const std::vector<Crossing>& seen,
                                 const std::vector<double>& weights) {
  double total = 0.0;
  Vec2 mean;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    total += weights[i];
    mean = mean + weights[i] * seen[i].place;
  }
  if (!(total > 0)) {
    return std::nullopt;
  }
  mean = (1 / total) * mean;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const Vec2 d = seen[i].place - mean;
    xx += weights[i] * d.x * d.x;
    xy += weights[i] * d.x * d.y;
    yy += weights[i] * d.y * d.y;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  return Line{mean, {std::cos(angle), std::sin(angle)}};
}

std::optional<Line> robust_line(const std::vector<Crossing>& seen) {
  std::vector<double> weights;
  for (const Crossing& each : seen) {
    weights.push_back(each.steepness);
  }
  std::vector<double> off_px(seen.size());
  std::optional<Line> line = line_through(seen, weights);
  for (int round = 0; round < kReweightings && line; ++round) {
    for (std::size_t i = 0; i < seen.size(); ++i) {
      off_px[i] = std::abs(cross(seen[i].place - line->point, line->direction));
    }
    const double limit_px = kTukey * std::max(kLeastScalePx, kMadToSd * median(off_px));
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double u = std::min(off_px[i] / limit_px, 1.0);
      weights[i] = seen[i].steepness * (1 - u * u) * (1 - u * u);
    }
    line = line_through(seen, weights);
  }
  return line;
}

/// The edge from a to b as found in the image, or as given.
Line edge(const GreyImage& image, Vec2 a, Vec2 b, double reach_px) {
  const double length_px = (b - a).norm();
  const Vec2 along = (1 / length_px) * (b - a);
  const Vec2 normal{-along.y, along.x};
  const Vec2 rising = sense_of(image, a, b, normal) * normal;
  const double end_px = std::max(kEndPx, kEndFraction * length_px);
  const int rays = std::clamp(static_cast<int>(length_px), kFewestRays, kMaxRays);
  std::vector<Crossing> seen;
  for (int i = 0; i < rays; ++i) {
    const double at_px = end_px + (length_px - 2 * end_px) * (i + 0.5) / rays;
    if (const auto found = crossing(image, a + at_px * along, rising, reach_px)) {
      seen.push_back(*found);
    }
  }
  const Line as_it_was{a, along};
  if (seen.size() < static_cast<std::size_t>(rays) / 2) {
    return as_it_was;
  }
  return robust_line(seen).value_or(as_it_was);
}

}  // namespace

std::array<Vec2, 4> refined_corners(const GreyImage& image, const std::array<Vec2, 4>& corners_px) {
  if (image.width_px < 2 || image.height_px < 2) {
    return corners_px;
  }
  std::array<Line, 4> edges;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 a = corners_px[i];
    const Vec2 b = corners_px[(i + 1) % 4];
    if (!((b - a).norm() >= kShortestEdgePx)) {
      return corners_px;
    }
    edges[i] = edge(image, a, b, kReach_px);
  }
  std::array<Vec2, 4> refined = corners_px;
  for (std::size_t i = 0; i < 4; ++i) {
    const Line& before = edges[(i + 3) % 4];
    const Line& after = edges[i];
    const double sine = cross(before.direction, after.direction);
    if (std::abs(sine) < kLeastSine) {
      continue;
    }
    const double along = cross(after.point - before.point, after.direction) / sine;
    const Vec2 meeting = before.point + along * before.direction;
    // A corner farther off than edges were searched for has slid along a misjudged edge.
    if ((meeting - corners_px[i]).norm() <= 2 * kReach_px) {
      refined[i] = meeting;
    }
  }
  return refined;
}

}  // namespace orthonav::nav
