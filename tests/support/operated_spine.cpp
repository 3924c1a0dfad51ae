#include "tests/support/operated_spine.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace orthonav::test {
namespace {

Vec3 any_direction(Random& random) {
  Vec3 v;
  do {
    v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  } while (v.norm() > 1.0 || v.norm() < 0.1);
  return v.normalized();
}

Motion any_motion(double rotation_rad, double translation_m, Vec3 about_m, Random& random) {
  const Mat3 rotation =
      rotation_from_vector(random.uniform(0.3, 1.0) * rotation_rad * any_direction(random));
  const Vec3 translation = random.uniform(0.3, 1.0) * translation_m * any_direction(random);
  return {rotation, about_m + translation - rotation * about_m};
}

Motion after(const Motion& second, const Motion& first) {
  return {second.rotation * first.rotation, second(first.translation_m)};
}

/// Where an axis through a point meets the bone when seen from behind, near the planned entry.
std::optional<Vec3> entry_of(const nav::SurfaceIndex& bone, Vec3 abreast_m, Vec3 direction) {
  constexpr double kBehind_m = 0.025;
  const auto hit = bone.first_hit(abreast_m - kBehind_m * direction, direction);
  if (!hit || hit->distance_m > 2.0 * kBehind_m) {
    return std::nullopt;
  }
  return hit->point_m;
}

Vec3 any_across(Vec3 direction, Random& random) {
  return direction.cross(any_direction(random)).normalized();
}

TrueScrew driven(const nav::SurfaceIndex& bone, const nav::ScrewPlan& plan,
                 const OperationSettings& settings, Random& random) {
  const Vec3 planned = (plan.target - plan.entry).normalized();
  const double length_m = (plan.target - plan.entry).norm();
  const double far = random.uniform() < settings.far_fraction ? 2.5 : 1.0;
  const Vec3 across = any_across(planned, random);
  const Vec3 off = far * settings.entry_sd_m *
                   (random.normal() * across + random.normal() * planned.cross(across));
  const Vec3 rotation = far * settings.angle_sd_rad *
                        (random.normal() * across + random.normal() * planned.cross(across));
  const Vec3 direction = rotation_from_vector(rotation) * planned;
  const double depth_m = length_m + settings.depth_sd_m * random.normal();
  TrueScrew out;
  const auto entry = entry_of(bone, plan.entry.v + off, direction);
  if (entry) {
    out.entry_m = *entry;
    out.tip_m = *entry + depth_m * direction;
  } else {
    out.entry_m = plan.entry.v;
    out.tip_m = plan.target.v;
  }
  out.radius_m = settings.wires ? random.uniform(0.0008, 0.001) : plan.radius_m;
  return out;
}

/// A wire from its tip to far behind the bone.
std::vector<MetalPiece> wire(const TrueScrew& screw, double bow_m, Random& random) {
  constexpr double kBehind_m = 0.06;
  constexpr double kStep_m = 0.002;
  constexpr double kSteel_hu = 14000.0;
  const Vec3 direction = (screw.tip_m - screw.entry_m).normalized();
  const double length_m = (screw.tip_m - screw.entry_m).norm();
  const Vec3 side = any_across(direction, random);
  // In the bone it deviates from the chord by bow at the middle and by nothing at the ends (a
  // parabola equals a circle to one per cent here); behind the bone it is straight.
  const auto at = [&](double s) {
    const double q = 2.0 * s / length_m - 1.0;
    const double off_m = s < 0.0 ? 4.0 * bow_m * s / length_m : bow_m * (1.0 - q * q);
    return screw.entry_m + s * direction + off_m * side;
  };
  std::vector<MetalPiece> out;
  for (double s = -kBehind_m; s < length_m; s += kStep_m) {
    const double end = std::min(length_m, s + kStep_m);
    out.push_back({at(s), at(end), screw.radius_m, kSteel_hu});
    if (bow_m != 0.0 && end < length_m) {
      out.push_back({at(end), at(end), screw.radius_m, kSteel_hu});
    }
  }
  return out;
}

constexpr double kHeadLength_m = 0.014;
constexpr double kHeadOff_m = 0.001;

std::vector<MetalPiece> headed_screw(const TrueScrew& screw) {
  constexpr double kHeadRadius_m = 0.006;
  const Vec3 direction = (screw.tip_m - screw.entry_m).normalized();
  const Vec3 neck = screw.entry_m - kHeadOff_m * direction;
  return {{neck, screw.tip_m, screw.radius_m},
          {neck - kHeadLength_m * direction, neck, kHeadRadius_m}};
}

MetalPiece placed(MetalPiece piece, const Motion& motion) {
  piece.from_m = motion(piece.from_m);
  piece.to_m = motion(piece.to_m);
  return piece;
}

/// Joins the heads of one side by rods.
void join_heads(const engine::Case& subject, OperatedSpine& spine) {
  constexpr double kRodRadius_m = 0.00275;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    std::optional<Vec3> last;
    for (const TrueScrew& screw : spine.screws) {
      if (!screw.placed || subject.levels[screw.level].screws[screw.screw].side != side) {
        continue;
      }
      const Vec3 direction = (screw.tip_m - screw.entry_m).normalized();
      const Vec3 seat = spine.bones[screw.level].scanner_from_model(
          screw.entry_m - (kHeadOff_m + 0.6 * kHeadLength_m) * direction);
      if (last) {
        spine.metal.push_back({*last, seat, kRodRadius_m});
        spine.metal.push_back({seat, seat, kRodRadius_m});
      }
      last = seat;
    }
  }
}

}  // namespace

OperatedSpine operated(const engine::Case& subject, const OperationSettings& settings,
                       Random random) {
  OperatedSpine out;
  const Motion patient =
      any_motion(settings.rotation_rad, settings.translation_m,
                 subject.levels.front().spine_from_vertebra.translation(), random);
  for (std::size_t l = 0; l < subject.levels.size(); ++l) {
    const engine::CaseLevel& level = subject.levels[l];
    const nav::SurfaceIndex bone(level.mesh);
    const Motion own =
        any_motion(settings.level_rotation_rad, settings.level_translation_m, {}, random);
    const Motion before{level.spine_from_vertebra.rotation(),
                        level.spine_from_vertebra.translation()};
    out.bones.push_back({level.mesh, after(patient, after(before, own))});
    for (std::size_t s = 0; s < level.screws.size(); ++s) {
      TrueScrew screw = driven(bone, level.screws[s], settings, random);
      screw.level = l;
      screw.screw = s;
      screw.placed = random.uniform() >= settings.missing;
      const auto pieces = !screw.placed    ? std::vector<MetalPiece>{}
                          : settings.wires ? wire(screw, settings.bow_m, random)
                                           : headed_screw(screw);
      for (const MetalPiece& piece : pieces) {
        out.metal.push_back(placed(piece, out.bones.back().scanner_from_model));
      }
      out.screws.push_back(screw);
    }
  }
  if (settings.rods) {
    join_heads(subject, out);
  }
  return out;
}

}  // namespace orthonav::test
