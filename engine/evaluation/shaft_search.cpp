#include "engine/evaluation/shaft_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "base/random.h"
#include "engine/evaluation/every_nth.h"
#include "engine/evaluation/metal_cloud.h"

namespace orthonav::engine {
namespace {

constexpr double kShortestRun_m = 0.012;
constexpr double kLeastSlenderness = 2.2;
constexpr double kThinnest_m = 0.0005;  ///< radius
constexpr double kThickest_m = 0.005;
constexpr double kHeadReach_m = 0.009;
constexpr double kHeadLength_m = 0.020;

/// A part of the metal, for the search; the fits use all of it.
std::vector<Vec3> thinned(std::span<const Vec3> all) {
  constexpr std::size_t kMost = 9000;
  return every_nth(all, all.size() / kMost + 1);
}

/// The length of the unbroken metal about a line through `middle_m`, and its middle.
struct Run {
  double length_m = 0.0;
  double middle_s_m = 0.0;
};

Run unbroken(const std::vector<Vec3>& places_m, Vec3 middle_m, Vec3 direction) {
  constexpr double kWithin_m = 0.0012;
  constexpr double kSlab_m = 0.0015;
  constexpr int kSlabs = 60;
  std::array<bool, 2 * kSlabs + 1> metal{};
  for (const Vec3& place : places_m) {
    const Vec3 way = place - middle_m;
    const double s = way.dot(direction);
    if (way.squared_norm() - s * s <= kWithin_m * kWithin_m && std::abs(s) < kSlab_m * kSlabs) {
      metal[static_cast<std::size_t>(std::lround(s / kSlab_m) + kSlabs)] = true;
    }
  }
  const auto end_towards = [&](int step) {
    int last = kSlabs;
    for (int at = kSlabs; at >= 0 && at <= 2 * kSlabs && std::abs(at - last) <= 2; at += step) {
      last = metal[static_cast<std::size_t>(at)] ? at : last;
    }
    return last - kSlabs;
  };
  const int first = end_towards(-1);
  const int last = end_towards(1);
  return {(last - first) * kSlab_m, 0.5 * (first + last) * kSlab_m};
}

std::optional<Centreline> longest_line(const std::vector<Vec3>& places_m, Random& random) {
  constexpr int kRounds = 400;
  std::optional<Centreline> best;
  const auto any = [&] {
    return places_m[static_cast<std::size_t>(random.uniform() *
                                             static_cast<double>(places_m.size()))];
  };
  for (int round = 0; round < kRounds; ++round) {
    const Vec3 from = any();
    Vec3 way = any() - from;
    // Far enough apart to give a direction, near enough to belong to one shaft.
    for (int again = 0; again < 20 && (way.norm() < 0.010 || way.norm() > 0.040); ++again) {
      way = any() - from;
    }
    if (way.norm() < 0.010) {
      continue;
    }
    const Vec3 direction = way.normalized();
    const Run run = unbroken(places_m, from, direction);
    if (run.length_m >= kShortestRun_m && (!best || run.length_m > 2.0 * best->half_m)) {
      best = Centreline::straight(from + run.middle_s_m * direction, direction, 0.5 * run.length_m);
    }
  }
  return best;
}

/// A stretch of slabs [first, last] whose sections are of one size.
struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;
  double radius_m = 0.0;
};

/// The radius that the thinner part has: heads are thicker than shafts.
double usual_radius_m(const MetalSections& sections) {
  std::vector<double> radii_m;
  for (std::size_t i = 0; i < sections.slabs.size(); ++i) {
    if (sections.radius_m(i) > kThinnest_m) {
      radii_m.push_back(sections.radius_m(i));
    }
  }
  if (radii_m.empty()) {
    return 0.0;
  }
  std::sort(radii_m.begin(), radii_m.end());
  return radii_m[radii_m.size() * 2 / 5];
}

Stretch longest_stretch(const MetalSections& sections) {
  const double usual_m = usual_radius_m(sections);
  // Few voxels make up the section of a wire: it varies, and may fail.
  const bool thin = usual_m < kWire_m;
  const double most_m = thin ? 1.6 * usual_m + 0.0003 : 1.2 * usual_m + 0.0003;
  const double least_m = (thin ? 0.3 : 0.55) * usual_m;
  const std::size_t gap = thin ? 4 : 1;
  const auto fits = [&](std::size_t i) {
    const double r = sections.radius_m(i);
    return r < most_m && r > least_m;
  };
  Stretch best{0, 0, usual_m};
  std::size_t first = 0;
  std::size_t last = 0;
  bool open = false;
  for (std::size_t i = 0; i < sections.slabs.size(); ++i) {
    if (!fits(i)) {
      open = open && i - last <= gap;
      continue;
    }
    first = open ? first : i;
    open = true;
    last = i;
    if (last - first > best.last - best.first) {
      best = {first, last, usual_m};
    }
  }
  return best;
}

/// Least squares of the middles of a stretch by a line, or by a parabola.
Centreline refitted(const Centreline& old, const MetalSections& sections, const Stretch& stretch,
                    bool bent) {
  const double middle_s = 0.5 * (sections.s_m(stretch.first) + sections.s_m(stretch.last));
  const double half = std::max(0.5 * (sections.s_m(stretch.last) - sections.s_m(stretch.first)),
                               MetalSections::kStep_m);
  // Of the powers of q = (s - middle) / half, which are even or odd about the middle.
  double n = 0, q2 = 0, q4 = 0;
  Vec2 sum, sum_q, sum_q2;
  for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
    if (sections.slabs[i].area_m2 <= 0.0) {
      continue;
    }
    const double q = (sections.s_m(i) - middle_s) / half;
    const Vec3 place = old.at(sections.s_m(i)) + sections.slabs[i].middle_m.x * old.across +
                       sections.slabs[i].middle_m.y * old.athwart - old.middle_m;
    const Vec2 off{place.dot(old.across), place.dot(old.athwart)};
    n += 1.0;
    q2 += q * q;
    q4 += q * q * q * q;
    sum = sum + off;
    sum_q = sum_q + q * off;
    sum_q2 = sum_q2 + (q * q) * off;
  }
  const double determinant = n * q4 - q2 * q2;
  const Vec2 bow =
      bent && determinant > 1e-9 ? (1.0 / determinant) * (n * sum_q2 - q2 * sum) : Vec2{};
  const Vec2 centre = (1.0 / n) * (sum - q2 * bow);
  const Vec2 slope = (1.0 / (q2 * half)) * sum_q;
  const Vec3 direction =
      (old.direction + slope.x * old.across + slope.y * old.athwart).normalized();
  Centreline out = Centreline::straight(
      old.middle_m + middle_s * old.direction + centre.x * old.across + centre.y * old.athwart,
      direction, half);
  const Vec3 bow_m = bow.x * old.across + bow.y * old.athwart;
  out.bow_across_m = bow_m.dot(out.across);
  out.bow_athwart_m = bow_m.dot(out.athwart);
  return out;
}

/// Whether thicker metal follows the line's end on that side.
bool has_head(const MetalSections& sections, double end_s_m, double radius_m) {
  int thick = 0;
  for (std::size_t i = 0; i < sections.slabs.size(); ++i) {
    const double past_m = std::abs(sections.s_m(i)) - std::abs(end_s_m);
    const bool same_side = (sections.s_m(i) > 0.0) == (end_s_m > 0.0);
    if (same_side && past_m > 0.0 && past_m < 0.008) {
      thick += sections.radius_m(i) > 1.3 * radius_m + 0.0003 ? 1 : 0;
    }
  }
  return thick >= 3;
}

/// Fits sections and line in turn until the line's length is stable. Returns its radius, 0 on
/// failure.
double settle(const MetalCloud& cloud, Centreline& line) {
  constexpr int kFewestRounds = 5;
  constexpr int kMaxRounds = 16;
  double within_m = 0.0045;
  double radius_m = 0.0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const MetalSections sections = sections_about(cloud, line, within_m);
    const Stretch stretch = longest_stretch(sections);
    if (stretch.last <= stretch.first + 3) {
      return 0.0;
    }
    // A wire may be bent; a screw is not. The bow shows where the wire continues.
    const double last_half_m = line.half_m;
    radius_m = stretch.radius_m;
    line = refitted(line, sections, stretch, radius_m < kWire_m && round > 1);
    within_m = std::clamp(1.5 * radius_m + 0.0008, 0.0025, 0.0065);
    if (round + 1 >= kFewestRounds &&
        std::abs(line.half_m - last_half_m) < 0.25 * MetalSections::kStep_m) {
      break;
    }
  }
  return radius_m;
}

std::optional<Shaft> shaft_about(const MetalCloud& cloud, Centreline line) {
  const double radius_m = settle(cloud, line);
  const double length_m = 2.0 * line.half_m;
  if (radius_m < kThinnest_m || radius_m > kThickest_m || length_m < kShortestRun_m ||
      length_m < kLeastSlenderness * 2.0 * radius_m) {
    return std::nullopt;
  }
  const MetalSections sections = sections_about(cloud, line, kHeadReach_m);
  const bool rear_head = has_head(sections, -line.half_m, radius_m);
  const bool front_head = has_head(sections, line.half_m, radius_m);
  Shaft out{line, -line.half_m, line.half_m, radius_m, front_head != rear_head};
  if (out.headed ? front_head : line.direction.y > 0.0) {
    out.line.direction = -line.direction;
    out.line.across = -line.across;
    out.line.bow_across_m = -line.bow_across_m;
  }
  return out;
}

/// Removes a shaft and its head from the metal.
void take_out(const Shaft& shaft, MetalCloud& cloud) {
  const double margin_m = 0.0012 + cloud.half_extent_m({0, 0, 1});
  cloud.take([&](const Vec3& place) {
    const double s = shaft.line.s_of(place);
    const double off = shaft.line.off_m(place);
    const bool in_shaft =
        s > shaft.from_s_m - 0.003 && s < shaft.to_s_m + 0.003 && off < shaft.radius_m + margin_m;
    const bool in_head = shaft.headed && s <= shaft.from_s_m &&
                         s > shaft.from_s_m - kHeadLength_m && off < kHeadReach_m;
    return in_shaft || in_head;
  });
}

/// The remaining metal, grouped by nearness.
std::vector<OtherMetal> others_of(const MetalCloud& cloud) {
  constexpr double kNear_m = 0.010;
  constexpr double kLeast_m3 = 20e-9;
  std::vector<OtherMetal> sums;
  for (const Vec3& place : cloud.places_m()) {
    auto near = std::find_if(sums.begin(), sums.end(), [&](const OtherMetal& other) {
      return (other.centre.v - place).norm() < kNear_m;
    });
    if (near == sums.end()) {
      near = sums.insert(sums.end(), {{place}, 0.0});
    }
    near->volume_m3 += cloud.voxel_m3();
    near->centre.v += (cloud.voxel_m3() / near->volume_m3) * (place - near->centre.v);
  }
  std::erase_if(sums, [](const OtherMetal& other) { return other.volume_m3 < kLeast_m3; });
  return sums;
}

}  // namespace

MetalPieces straight_metal(const ScanField& scan) {
  constexpr int kMaxShafts = 40;
  constexpr int kMisses = 3;
  MetalPieces out;
  MetalCloud cloud(scan);
  Random random(20240229);
  for (int misses = 0; misses < kMisses && static_cast<int>(out.shafts.size()) < kMaxShafts;) {
    const std::vector<Vec3> some = thinned(cloud.places_m());
    const auto line = some.size() < 8 ? std::nullopt : longest_line(some, random);
    if (!line) {
      break;
    }
    const auto shaft = shaft_about(cloud, *line);
    if (shaft) {
      out.shafts.push_back(*shaft);
      take_out(*shaft, cloud);
    }
    misses += shaft ? 0 : 1;
  }
  out.others = others_of(cloud);
  return out;
}

}  // namespace orthonav::engine
