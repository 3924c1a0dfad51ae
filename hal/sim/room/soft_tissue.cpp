#include <algorithm>

#include "hal/sim/room/surface_field.h"
#include "hal/sim/surgeon/stroke_plan.h"

namespace orthonav::sim {
namespace {

/// How deep a spot lies in a valley is measured relative to bone within this distance.
constexpr double kAround_m = 0.012;
/// Tissue fills a valley of this depth to twice the mean.
constexpr double kDeep_m = 0.006;
/// Its thickness varies over this length, by this fraction.
constexpr double kUnevenOver_m = 0.020;
constexpr double kUneven = 0.4;

/// A spot that is stroked, and the tissue to be laid over it.
struct CoveredSpot {
  Vec3 place;
  double* tissue_m;
};

/// The spots of all strokes, in order, without tissue yet. They point into the regions.
std::vector<CoveredSpot> covered_spots(std::vector<StrokeRegion>& regions) {
  std::vector<CoveredSpot> spots;
  for (StrokeRegion& region : regions) {
    for (Stroke& stroke : region.strokes) {
      stroke.tissue_m.assign(stroke.spots.size(), 0.0);
      for (std::size_t i = 0; i < stroke.spots.size(); ++i) {
        spots.push_back({stroke.spots[i].point, &stroke.tissue_m[i]});
      }
    }
  }
  return spots;
}

/// How much higher (posterior) the highest spot nearby lies.
double depth_at(Vec3 place, const std::vector<CoveredSpot>& spots) {
  double highest = place.y;
  for (const CoveredSpot& spot : spots) {
    if ((spot.place - place).squared_norm() < kAround_m * kAround_m) {
      highest = std::max(highest, spot.place.y);
    }
  }
  return highest - place.y;
}

}  // namespace

void cover_with_tissue(std::vector<StrokeRegion>& regions, double mean_m, const Random& random) {
  if (mean_m == 0.0) {
    return;
  }
  const SurfaceField uneven(random, kUneven, kUnevenOver_m);
  const std::vector<CoveredSpot> spots = covered_spots(regions);
  double sum_m = 0.0;
  for (const auto& [place, tissue_m] : spots) {
    const double valley = std::min(2.0, depth_at(place, spots) / kDeep_m);
    *tissue_m = (0.25 + valley) * std::max(0.0, 1.0 + uneven.at(place));
    sum_m += *tissue_m;
  }
  const double scale = mean_m * static_cast<double>(spots.size()) / std::max(sum_m, 1e-12);
  for (const CoveredSpot& spot : spots) {
    *spot.tissue_m *= scale;
  }
}

double Stroke::tissue_at(double along_m) const {
  if (tissue_m.empty()) {
    return 0.0;
  }
  const auto after = std::lower_bound(arc_m.begin(), arc_m.end(), along_m);
  const auto i = static_cast<std::size_t>(std::distance(arc_m.begin(), after));
  return tissue_m[std::min(i, tissue_m.size() - 1)];
}

BoneSpot Stroke::on_tissue(double along_m, double left) const {
  const BoneSpot bone = at(along_m);
  return {bone.point + left * tissue_at(along_m) * bone.normal, bone.normal};
}

}  // namespace orthonav::sim
