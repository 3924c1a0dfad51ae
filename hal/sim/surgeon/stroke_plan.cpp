#include "hal/sim/surgeon/stroke_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hal/sim/room/surface_map.h"

namespace orthonav::sim {
namespace {

constexpr double kLinePitch_m = 0.0035;
constexpr double kShortestLine_m = 0.005;
constexpr double kShortestStroke_m = 0.010;
constexpr double kLongestStroke_m = 0.110;
constexpr double kLongestRegion_m = 0.120;
constexpr double kLongestBridge_m = 0.008;
constexpr double kSteepest = 0.42;             // cosine of 65° between normal and line of sight
constexpr double kHalfMidline_m = 0.006;       // the crest's lines and the side lines meet here
constexpr double kSpinousHalfWidth_m = 0.014;  // sides of the spinous process lie within

/// How far out the strokes reach: a fraction of half the width and a limit, for vertebrae of any
/// size.
struct Outwards {
  double fraction;
  double most_m;
};
constexpr Outwards outwards(Exposure exposure) {
  return exposure == Exposure::kTransverseProcesses ? Outwards{0.95, 0.060} : Outwards{0.65, 0.030};
}

/// The part of a vertebra that a pointer reaches from behind: its posterior half, as far out as it
/// is exposed. The midline is the middle of the bounding box, since a model's origin is arbitrary.
struct Reach {
  double lowest_y_m = 0.0;
  double midline_x_m = 0.0;
  double half_width_m = 0.0;

  Reach(const RoomLevel& level, Exposure exposure) {
    double front = 1e9;
    double back = -1e9;
    double right = 1e9;
    double left = -1e9;
    for (const Vec3 vertex : level.vertices_m) {
      front = std::min(front, vertex.y);
      back = std::max(back, vertex.y);
      right = std::min(right, vertex.x);
      left = std::max(left, vertex.x);
    }
    lowest_y_m = 0.5 * (front + back);
    midline_x_m = 0.5 * (right + left);
    const Outwards out = outwards(exposure);
    half_width_m = std::min(out.fraction * 0.5 * (left - right), out.most_m);
  }
  [[nodiscard]] bool holds(const BoneSpot& spot) const {
    return spot.point.y > lowest_y_m && std::abs(lateral_m(spot)) < half_width_m &&
           spot.normal.y > -0.1;
  }
  /// Distance to the left of the midline.
  [[nodiscard]] double lateral_m(const BoneSpot& spot) const { return spot.point.x - midline_x_m; }
};

using Run = std::vector<BoneSpot>;

double length_of(const Run& run) {
  double sum = 0.0;
  for (std::size_t i = 1; i < run.size(); ++i) {
    sum += (run[i].point - run[i - 1].point).norm();
  }
  return sum;
}

/// Covers a strip of a map with lines along the spine, back and forth, and joins neighbours that
/// the tip can reach without leaving the bone.
template <class Accept>
class Sweep {
 public:
  Sweep(const SurfaceMap& map, Accept accept) : map_(map), accept_(accept) {}

  std::vector<Run> over(double first_u_m, double last_u_m) {
    std::vector<Run> strokes;
    // A whole number of pitches from zero may be rounded to just below it.
    const double pitches = std::abs(last_u_m - first_u_m) / kLinePitch_m + 1e-6;
    const int lines = static_cast<int>(pitches) + 1;
    const double step = lines > 1 ? (last_u_m - first_u_m) / (lines - 1) : 0.0;
    for (int line = 0; line < lines; ++line) {
      auto runs = runs_along(first_u_m + line * step);
      if (line % 2 == 1) {
        std::reverse(runs.begin(), runs.end());
        for (Run& run : runs) {
          std::reverse(run.begin(), run.end());
        }
      }
      for (Run& run : runs) {
        add(strokes, run);
      }
    }
    return strokes;
  }

 private:
  [[nodiscard]] std::optional<BoneSpot> accepted(Vec2 uv) const {
    auto spot = map_.at(uv);
    if (spot && spot->normal.dot(map_.from()) > kSteepest && accept_(*spot)) {
      return spot;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<Run> runs_along(double u_m) const {
    std::vector<Run> runs;
    Run run;
    const auto close = [&runs, &run] {
      if (length_of(run) >= kShortestLine_m) {
        runs.push_back(run);
      }
      run.clear();
    };
    for (double v = map_.low().y; v <= map_.high().y; v += SurfaceMap::kStep_m) {
      if (const auto spot = accepted({u_m, v})) {
        run.push_back(*spot);
      } else {
        close();
      }
    }
    close();
    return runs;
  }

  /// The path over the bone from one place to another; nothing if it would leave the bone.
  [[nodiscard]] std::optional<Run> bridge(Vec3 from, Vec3 to) const {
    const Vec2 start = map_.uv(from);
    const Vec2 way = map_.uv(to) - start;
    if ((to - from).norm() > kLongestBridge_m) {
      return std::nullopt;
    }
    Run run;
    const int steps = static_cast<int>(way.norm() / SurfaceMap::kStep_m);
    for (int i = 1; i < steps; ++i) {
      const auto spot = accepted(start + (static_cast<double>(i) / steps) * way);
      if (!spot) {
        return std::nullopt;
      }
      run.push_back(*spot);
    }
    return run;
  }

  void add(std::vector<Run>& strokes, const Run& run) const {
    if (!strokes.empty() && length_of(strokes.back()) + length_of(run) < kLongestStroke_m) {
      Run& last = strokes.back();
      if (const auto between = bridge(last.back().point, run.front().point)) {
        last.insert(last.end(), between->begin(), between->end());
        last.insert(last.end(), run.begin(), run.end());
        return;
      }
    }
    strokes.push_back(run);
  }

  const SurfaceMap& map_;
  Accept accept_;
};

/// A hand does not follow the facets of a mesh: normals are averaged over ±2 mm of the path.
Stroke finished(const Run& run) {
  constexpr std::size_t kHalfWindow = 4;
  Stroke stroke;
  stroke.spots = run;
  stroke.arc_m.resize(run.size());
  for (std::size_t i = 0; i < run.size(); ++i) {
    Vec3 sum;
    const std::size_t end = std::min(run.size(), i + kHalfWindow + 1);
    for (std::size_t j = i > kHalfWindow ? i - kHalfWindow : 0; j < end; ++j) {
      sum += run[j].normal;
    }
    if (sum.squared_norm() > 0.0) {
      stroke.spots[i].normal = sum.normalized();
    }
    if (i > 0) {
      stroke.arc_m[i] = stroke.arc_m[i - 1] + (run[i].point - run[i - 1].point).norm();
    }
  }
  return stroke;
}

/// A sweep's strokes in regions of about the same length; short remnants at the edges are left out.
void append(std::vector<StrokeRegion>& regions, const std::vector<Run>& runs) {
  StrokeRegion region;
  for (const Run& run : runs) {
    if (length_of(run) < kShortestStroke_m) {
      continue;
    }
    if (!region.strokes.empty() && region.length_m() + length_of(run) > kLongestRegion_m) {
      regions.push_back(region);
      region = {};
    }
    region.strokes.push_back(finished(run));
  }
  if (!region.strokes.empty()) {
    regions.push_back(region);
  }
}

/// A transverse process from its root to its tip, three times: along its middle outwards, along its
/// upper edge back, along its lower edge outwards again. Empty where none is seen from behind.
std::vector<Run> along_transverse_process(const RoomLevel& level, const SurfaceMap& from_behind,
                                          const Reach& reach, double side) {
  constexpr double kMiddle = 0.5;
  constexpr double kUpperEdge = 0.8;
  constexpr double kLowerEdge = 0.2;
  // The process is followed from its tip inwards: what joins it there (facet, mammillary process)
  // begins with a step.
  constexpr double kWidens_m = 0.0005;  // at either edge, from one column of the map to the next

  BoneSpot tip;
  double farthest_m = 0.0;
  for (const Vec3 vertex : level.vertices_m) {
    const double aside_m = side * (vertex.x - reach.midline_x_m);
    if (vertex.y > reach.lowest_y_m && aside_m > farthest_m) {
      farthest_m = aside_m;
      tip = {vertex, Vec3{side, 1.0, 0.0}.normalized()};
    }
  }
  struct Column {
    double u_m, low_m, high_m;
  };
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<Column> columns;  // from the tip inwards
  const auto seen = [&](double u_m, double v_m) {
    const auto spot = from_behind.at({u_m, v_m});
    return spot && spot->point.y > reach.lowest_y_m ? spot : std::nullopt;
  };
  for (double aside_m = farthest_m; aside_m > reach.half_width_m; aside_m -= SurfaceMap::kStep_m) {
    const double u_m = reach.midline_x_m + side * aside_m;
    Column column{u_m, kNone, -kNone};
    const double low_m = columns.empty() ? from_behind.low().y : columns.back().low_m - kWidens_m;
    const double high_m =
        columns.empty() ? from_behind.high().y : columns.back().high_m + kWidens_m;
    for (double v_m = low_m; v_m <= high_m; v_m += SurfaceMap::kStep_m) {
      if (seen(u_m, v_m)) {
        column.low_m = std::min(column.low_m, v_m);
        column.high_m = std::max(column.high_m, v_m);
      }
    }
    if (column.low_m < column.high_m) {
      columns.push_back(column);
    }
  }
  std::vector<Run> runs;
  for (const double at : {kMiddle, kUpperEdge, kLowerEdge}) {
    Run outwards;
    for (auto column = columns.rbegin(); column != columns.rend(); ++column) {
      if (const auto spot =
              seen(column->u_m, column->low_m + at * (column->high_m - column->low_m))) {
        outwards.push_back(*spot);
      }
    }
    outwards.push_back(tip);
    if (at == kUpperEdge) {
      std::reverse(outwards.begin(), outwards.end());
    }
    if (outwards.size() > 1) {
      runs.push_back(outwards);
    }
  }
  return runs;
}

}  // namespace

BoneSpot Stroke::at(double along_m) const {
  const auto after = std::upper_bound(arc_m.begin(), arc_m.end(), along_m);
  if (after == arc_m.begin()) {
    return spots.front();
  }
  if (after == arc_m.end()) {
    return spots.back();
  }
  const auto i = static_cast<std::size_t>(after - arc_m.begin());
  const double fraction = (along_m - arc_m[i - 1]) / (arc_m[i] - arc_m[i - 1]);
  const BoneSpot& a = spots[i - 1];
  const BoneSpot& b = spots[i];
  const Vec3 normal = a.normal + fraction * (b.normal - a.normal);
  return {a.point + fraction * (b.point - a.point),
          normal.squared_norm() > 0.0 ? normal.normalized() : a.normal};
}

double StrokeRegion::length_m() const {
  double sum = 0.0;
  for (const Stroke& stroke : strokes) {
    sum += stroke.length_m();
  }
  return sum;
}

std::vector<StrokeRegion> plan_strokes(const RoomLevel& level, Exposure exposure) {
  const Reach reach(level, exposure);
  std::vector<StrokeRegion> regions;
  const SurfaceMap from_behind(level, {0, 1, 0});
  const auto reachable = [&reach](const BoneSpot& spot) { return reach.holds(spot); };
  const auto sweep_behind = [&](double first_m, double last_m) {
    append(regions, Sweep(from_behind, reachable)
                        .over(reach.midline_x_m + first_m, reach.midline_x_m + last_m));
  };
  sweep_behind(kHalfMidline_m, reach.half_width_m);
  sweep_behind(-kHalfMidline_m, -reach.half_width_m);
  if (exposure == Exposure::kTrainedPattern) {
    for (const double side : {1.0, -1.0}) {
      append(regions, along_transverse_process(level, from_behind, reach, side));
    }
    // The crest to and fro, twice, down to its lower end.
    sweep_behind(-kLinePitch_m / 2, kLinePitch_m / 2);
    sweep_behind(kLinePitch_m / 4, -kLinePitch_m / 4);
    return regions;
  }
  for (const double side : {1.0, -1.0}) {
    const SurfaceMap oblique(level, {side * std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2, 0});
    const auto flank = [&reach, side](const BoneSpot& spot) {
      return reach.holds(spot) && side * reach.lateral_m(spot) < kSpinousHalfWidth_m &&
             side * spot.normal.x > 0.5;
    };
    append(regions, Sweep(oblique, flank).over(oblique.low().x, oblique.high().x));
  }
  sweep_behind(-kLinePitch_m / 2, kLinePitch_m / 2);
  return regions;
}

}  // namespace orthonav::sim
