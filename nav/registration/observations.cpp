#include "nav/registration/observations.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <unordered_map>

namespace orthonav::nav::posterior {
namespace {

constexpr double kLeap_m = 0.008;
constexpr double kSamePoint_m = 0.00005;
constexpr double kPeriod_s = 1.0 / 30.0;
/// To lift the pointer and begin another stroke takes longer than this; a moment in which tracking
/// loses it is shorter.
constexpr double kPause_s = 0.3;
constexpr double kShortest_m = 0.004;
constexpr double kSmallestCell_m = 0.005;
constexpr double kLargestCell_m = 0.1;
constexpr double kCellGrows = 1.25;

/// A cell of a cubic grid over space, by its number along each axis.
using GridCell = std::array<std::int64_t, 3>;

/// The cell that holds a place; cells are centred on multiples of their size.
GridCell cell_of(Vec3 p, double size_m) {
  return {std::llround(p.x / size_m), std::llround(p.y / size_m), std::llround(p.z / size_m)};
}

struct HashOfCell {
  std::size_t operator()(const GridCell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t i : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 29U;
    }
    return static_cast<std::size_t>(hash);
  }
};

/// Whether each point lies apart from all earlier ones.
std::vector<bool> different(std::span<const Point<World>> points) {
  // A point in the same or a neighbouring cell of this size can be the same sample.
  std::unordered_map<GridCell, std::vector<Vec3>, HashOfCell> seen;
  std::vector<bool> out;
  for (const Point<World>& p : points) {
    const GridCell here = cell_of(p.v, 4.0 * kSamePoint_m);
    bool same = false;
    for (int i = 0; i < 27 && !same; ++i) {
      const auto near =
          seen.find({here[0] + i % 3 - 1, here[1] + i / 3 % 3 - 1, here[2] + i / 9 - 1});
      same =
          near != seen.end() && std::any_of(near->second.begin(), near->second.end(), [&](Vec3 q) {
            return (q - p.v).squared_norm() <= kSamePoint_m * kSamePoint_m;
          });
    }
    if (!same) {
      seen[here].push_back(p.v);
    }
    out.push_back(!same);
  }
  return out;
}

void finish(const Observations& observations, Unit& unit) {
  const auto at = [&](std::size_t k) { return observations.strokes[unit.points[k]]; };
  const std::size_t count = unit.points.size();
  unit.stroke = at(0).stroke;
  unit.area = at(0).area;
  unit.quarter_m = at(count / 4).tip.v;
  unit.three_quarters_m = at(3 * count / 4).tip.v;
  unit.begin_s = at(0).time_s;
  unit.end_s = at(count - 1).time_s;
}

std::vector<Unit> along_strokes(const Observations& observations, std::size_t most) {
  const std::vector<StrokePoint>& points = observations.strokes;
  std::vector<double> along_m(points.size(), 0.0);
  std::size_t strokes = points.empty() ? 0 : 1;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const bool next = points[k].stroke != points[k - 1].stroke;
    strokes += next ? 1 : 0;
    along_m[k] = along_m[k - 1] + (next ? 0.0 : (points[k].tip - points[k - 1].tip).norm());
  }
  const double room = static_cast<double>(most > 2 * strokes ? most - strokes : most / 2 + 1);
  const double unit_m = points.empty() ? 0.0 : std::max(kShortest_m, along_m.back() / room);
  std::vector<Unit> units;
  double from_m = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k == 0 || points[k].stroke != points[k - 1].stroke || along_m[k] - from_m >= unit_m) {
      units.emplace_back();
      from_m = along_m[k];
    }
    units.back().points.push_back(static_cast<std::uint32_t>(k));
  }
  return units;
}

std::vector<Unit> in_space(const Observations& observations, std::size_t most) {
  std::map<GridCell, Unit> cells;
  for (double cell_m = kSmallestCell_m; cell_m < kLargestCell_m; cell_m *= kCellGrows) {
    cells.clear();
    for (std::size_t k = 0; k < observations.strokes.size(); ++k) {
      cells[cell_of(observations.strokes[k].tip.v, cell_m)].points.push_back(
          static_cast<std::uint32_t>(k));
    }
    if (cells.size() <= most) {
      break;
    }
  }
  std::vector<Unit> units;
  for (auto& [cell, unit] : cells) {
    units.push_back(std::move(unit));
  }
  return units;
}

}  // namespace

Observations observed(std::span<const Point<World>> points, double tip_radius_m,
                      std::span<const Vec3> shafts, std::span<const double> times_s) {
  Observations out;
  out.tip_radius_m = tip_radius_m;
  const std::vector<bool> is_new = different(points);
  const bool timed =
      times_s.size() == points.size() &&
      std::adjacent_find(times_s.begin(), times_s.end(), std::greater_equal<>()) == times_s.end();
  // A short excursion (half a second at 30 a second) that comes back, of a pointer that was lifted,
  // begins nothing.
  constexpr std::size_t kExcursion = 15;
  int stroke = 0, area = 0;
  std::size_t leapt = 0;  // where the last leap ended
  std::vector<StrokePoint>& all = out.strokes;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_new[i]) {
      continue;
    }
    if (!all.empty() && (points[i] - all.back().tip).norm() > kLeap_m) {
      const bool back = leapt > 0 && all.size() - leapt <= kExcursion &&
                        (points[i] - all[leapt - 1].tip).norm() <= kLeap_m;
      if (back) {
        area = all[leapt - 1].area;
        for (std::size_t k = leapt; k < all.size(); ++k) {
          all[k].area = area;
        }
      } else {
        ++area;
        leapt = all.size();
      }
    }
    stroke += timed && !all.empty() && times_s[i] - all.back().time_s > kPause_s ? 1 : 0;
    all.push_back({points[i], stroke, area, timed ? times_s[i] : static_cast<double>(i) * kPeriod_s,
                   shafts.size() == points.size() ? shafts[i] : Vec3{}});
  }
  if (!timed) {
    for (StrokePoint& p : all) {
      p.stroke = p.area;
    }
  }
  out.in_time = timed || static_cast<std::size_t>(2 * (area + 1)) <
                             std::min<std::size_t>(160, out.strokes.size());
  return out;
}

std::vector<Unit> units_of(const Observations& observations, std::size_t most) {
  std::vector<Unit> units =
      observations.in_time ? along_strokes(observations, most) : in_space(observations, most);
  int number = 0;
  for (Unit& unit : units) {
    finish(observations, unit);
    if (!observations.in_time) {
      unit.stroke = unit.area = number++;
    }
  }
  return units;
}

std::vector<std::array<std::uint32_t, kBlock>> blocks_of(const Observations& observations,
                                                         std::span<const Unit> units) {
  std::vector<std::array<std::uint32_t, kBlock>> blocks;
  const auto cut = [&](std::span<const std::uint32_t> run) {
    for (std::size_t k = 0; k + kBlock <= run.size(); k += kBlock) {
      std::array<std::uint32_t, kBlock> block{};
      std::copy_n(run.begin() + static_cast<std::ptrdiff_t>(k), kBlock, block.begin());
      blocks.push_back(block);
    }
  };
  if (!observations.in_time) {
    for (const Unit& unit : units) {
      cut(unit.points);
    }
    return blocks;
  }
  std::vector<std::uint32_t> run;
  for (std::size_t k = 0; k < observations.strokes.size(); ++k) {
    if (!run.empty() && observations.strokes[k].stroke != observations.strokes[run.back()].stroke) {
      cut(run);
      run.clear();
    }
    run.push_back(static_cast<std::uint32_t>(k));
  }
  cut(run);
  return blocks;
}

}  // namespace orthonav::nav::posterior
