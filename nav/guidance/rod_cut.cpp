#include "nav/guidance/rod_cut.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "base/angle.h"
#include "base/printed.h"
#include "nav/geometry/spline.h"

namespace orthonav::nav {
namespace {

Status check_rod_distance(const char* name, double distance_m, double shortest_m,
                          double longest_m) {
  if (!std::isfinite(distance_m)) {
    return Error{printed("%s is not finite", name)};
  }
  if (distance_m < shortest_m || distance_m > longest_m) {
    const double limit_m = distance_m < shortest_m ? shortest_m : longest_m;
    return Error{printed(
        shortest_m < 0.0 ? "%s is %s mm, limit %.0f to %.0f mm" : "%s is %s mm, limit %.0f-%.0f mm",
        name, value_beside(distance_m * 1e3, limit_m * 1e3, 1).c_str(), shortest_m * 1e3,
        longest_m * 1e3)};
  }
  return {};
}

Status check_seat_distance(double distance_m) {
  return check_rod_distance("distance from head to seat", distance_m, -kHighestSeat_m,
                            kDeepestSeat_m);
}

Status check_rod_cut(const RodTemplate& rod, std::span<const Vec3> to_bone,
                     const RodSeating& seating) {
  if (rod.heads_m.size() < 2) {
    return Error{printed("rod to cut needs at least 2 screw heads, got %zu", rod.heads_m.size())};
  }
  if (to_bone.size() != rod.heads_m.size()) {
    return Error{printed("rod to cut has %zu screw heads, but %zu directions of screws",
                         rod.heads_m.size(), to_bone.size())};
  }
  for (std::size_t i = 0; i < to_bone.size(); ++i) {
    const double length = to_bone[i].norm();
    if (!rod.heads_m[i].is_finite()) {
      return Error{printed("screw head %zu is not finite", i + 1)};
    }
    if (!(std::isfinite(length) && length > 0.0)) {
      return Error{printed("direction of screw %zu is zero or not finite", i + 1)};
    }
  }
  if (const Status s = check_seat_distance(seating.head_to_seat_m); !s) {
    return s;
  }
  if (!seating.each_head_to_seat_m.empty() &&
      seating.each_head_to_seat_m.size() != rod.heads_m.size()) {
    return Error{printed("rod to cut has %zu screw heads, but %zu distances to a seat",
                         rod.heads_m.size(), seating.each_head_to_seat_m.size())};
  }
  for (const double seat_m : seating.each_head_to_seat_m) {
    if (const Status s = check_seat_distance(seat_m); !s) {
      return s;
    }
  }
  return check_rod_distance("overhang of the rod", seating.overhang_m, 0.0, kLongestOverhang_m);
}

/// Of the rod at each head, unit vectors: exact where the heads lie on a circle.
std::vector<Vec3> tangents_at(std::span<const Vec3> heads_m) {
  std::vector<Vec3> chords;
  for (std::size_t i = 1; i < heads_m.size(); ++i) {
    chords.push_back(heads_m[i] - heads_m[i - 1]);
  }
  std::vector<Vec3> tangents(heads_m.size());
  for (std::size_t i = 1; i < chords.size(); ++i) {
    // A chord is off the tangent by half its arc, so the shorter one counts more.
    const double before_m = chords[i - 1].norm();
    const double after_m = chords[i].norm();
    tangents[i] =
        (after_m / before_m * chords[i - 1] + before_m / after_m * chords[i]).normalized();
  }
  const auto mirrored = [](Vec3 tangent, Vec3 chord) {
    const Vec3 along = chord.normalized();
    return 2.0 * along.dot(tangent) * along - tangent;
  };
  const bool straight = chords.size() == 1;
  tangents.front() = straight ? chords.front().normalized() : mirrored(tangents[1], chords.front());
  tangents.back() =
      straight ? chords.back().normalized() : mirrored(tangents[chords.size() - 1], chords.back());
  return tangents;
}

}  // namespace

Result<std::vector<Vec3>> to_bone_across(const RodTemplate& rod, Vec3 to_bone) {
  if (rod.heads_m.size() < 2) {
    return Error{printed("rod to cut needs at least 2 screw heads, got %zu", rod.heads_m.size())};
  }
  const double length = to_bone.norm();
  if (!(std::isfinite(length) && length > 0.0)) {
    return Error{"direction to the bone is zero or not finite"};
  }
  std::vector<Vec3> across;
  for (const Vec3 along : tangents_at(rod.heads_m)) {
    const Vec3 left = to_bone - to_bone.dot(along) * along;
    const double off_rad = std::asin(std::min(1.0, left.norm() / length));
    if (!(off_rad >= kLeastOffRod_rad)) {
      return Error{printed("direction to the bone is %s° off the rod, at least 30° needed",
                           value_beside(degrees(off_rad), degrees(kLeastOffRod_rad), 1).c_str())};
    }
    across.push_back(left.normalized());
  }
  return across;
}

Result<RodCut> rod_cut(const RodTemplate& rod, std::span<const Vec3> to_bone,
                       const RodSeating& seating) {
  if (const Status s = check_rod_cut(rod, to_bone, seating); !s) {
    return s.error();
  }
  RodCut cut;
  for (std::size_t i = 0; i < to_bone.size(); ++i) {
    const double seat_m = seating.each_head_to_seat_m.empty() ? seating.head_to_seat_m
                                                              : seating.each_head_to_seat_m[i];
    cut.seats_m.push_back(rod.heads_m[i] + seat_m * to_bone[i].normalized());
  }
  const auto spline = CatmullRom::through(cut.seats_m);
  if (!spline) {
    return Error{"seats of the rod: " + spline.error().message, spline.error().code};
  }
  cut.seated_length_m = spline->length_m();
  cut.cut_length_m = cut.seated_length_m + 2.0 * seating.overhang_m;
  return cut;
}

}  // namespace orthonav::nav
