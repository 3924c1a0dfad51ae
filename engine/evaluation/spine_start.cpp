#include "engine/evaluation/spine_start.h"

#include <algorithm>
#include <array>
#include <optional>

#include "nav/geometry/absolute_orientation.h"

namespace orthonav::engine {
namespace {

constexpr double kNear_m = 0.015;             ///< of a shaft's tip from a planned target
constexpr double kNear_rad = 0.45;            ///< of its direction from the planned one
constexpr double kPairs_m = 0.014;            ///< by how much distances within two pairs may differ
constexpr double kMisfit_m = 0.006;           ///< RMS of two screws on two shafts
constexpr double kMostRotation_rad = 0.7854;  ///< patient against case

/// A planned screw or a shaft as two points: its tip, and one a screw's length behind it.
struct Line {
  Vec3 tip_m;
  Vec3 rear_m;
  [[nodiscard]] Vec3 direction() const { return (tip_m - rear_m).normalized(); }
};

std::vector<Line> planned_lines(const Case& subject) {
  std::vector<Line> out;
  for (const CaseLevel& level : subject.levels) {
    for (const nav::ScrewPlan& screw : level.screws) {
      out.push_back({(level.spine_from_vertebra * screw.target).v,
                     (level.spine_from_vertebra * screw.entry).v});
    }
  }
  return out;
}

std::vector<Line> shaft_lines(std::span<const Shaft> shafts) {
  constexpr double kLength_m = 0.045;
  std::vector<Line> out;
  for (const Shaft& shaft : shafts) {
    out.push_back({shaft.tip().v, shaft.line.at(shaft.to_s_m - kLength_m)});
  }
  return out;
}

struct Start {
  Transform<Scan, Spine> pose;
  int screws = 0;  ///< that have a shaft beside them
  double misfit_m = 0.0;
};

int screws_beside(const Transform<Scan, Spine>& pose, const std::vector<Line>& planned,
                  const std::vector<Line>& shafts) {
  return static_cast<int>(std::count_if(planned.begin(), planned.end(), [&](const Line& plan) {
    const Vec3 tip = (pose * Point<Spine>{plan.tip_m}).v;
    const Vec3 direction = pose.rotation() * plan.direction();
    return std::any_of(shafts.begin(), shafts.end(), [&](const Line& shaft) {
      return (shaft.tip_m - tip).norm() < kNear_m &&
             angle_between_rad(shaft.direction(), direction) < kNear_rad;
    });
  }));
}

std::optional<Start> of_pairs(const Line& plan_a, const Line& plan_b, const Line& shaft_a,
                              const Line& shaft_b) {
  const auto differs = [](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return std::abs((a - b).norm() - (c - d).norm()) > kPairs_m;
  };
  if (differs(plan_a.tip_m, plan_b.tip_m, shaft_a.tip_m, shaft_b.tip_m) ||
      differs(plan_a.rear_m, plan_b.rear_m, shaft_a.rear_m, shaft_b.rear_m)) {
    return std::nullopt;
  }
  const std::array<Vec3, 4> from = {plan_a.tip_m, plan_a.rear_m, plan_b.tip_m, plan_b.rear_m};
  const std::array<Vec3, 4> to = {shaft_a.tip_m, shaft_a.rear_m, shaft_b.tip_m, shaft_b.rear_m};
  const auto fit = nav::absolute_orientation(from, to);
  if (!fit || fit->rmse_m > kMisfit_m) {
    return std::nullopt;
  }
  return Start{{fit->rotation, fit->translation_m}, 0, fit->rmse_m};
}

/// One screw on one shaft, turned as little as possible.
Start of_one(const Line& plan, const Line& shaft) {
  const Vec3 axis = plan.direction().cross(shaft.direction());
  const double angle = angle_between_rad(plan.direction(), shaft.direction());
  const Mat3 rotation =
      axis.norm() > 1e-9 ? rotation_from_vector(angle * axis.normalized()) : Mat3::identity();
  return {{rotation, shaft.tip_m - rotation * plan.tip_m}, 0, kMisfit_m};
}

std::vector<Start> all_starts(const std::vector<Line>& planned, const std::vector<Line>& shafts) {
  std::vector<Start> out;
  const auto keep = [&](const Start& start) {
    if (rotation_angle_rad(start.pose.rotation(), Mat3::identity()) <= kMostRotation_rad) {
      out.push_back(start);
      out.back().screws = screws_beside(start.pose, planned, shafts);
    }
  };
  for (std::size_t a = 0; a < planned.size(); ++a) {
    for (std::size_t i = 0; i < shafts.size(); ++i) {
      keep(of_one(planned[a], shafts[i]));
      for (std::size_t b = a + 1; b < planned.size(); ++b) {
        for (std::size_t j = 0; j < shafts.size(); ++j) {
          const auto start =
              i == j ? std::nullopt : of_pairs(planned[a], planned[b], shafts[i], shafts[j]);
          if (start) {
            keep(*start);
          }
        }
      }
    }
  }
  return out;
}

bool alike(const Transform<Scan, Spine>& a, const Transform<Scan, Spine>& b, Vec3 centre_m) {
  constexpr double kAlike_m = 0.008;
  constexpr double kAlike_rad = 0.14;
  return ((a * Point<Spine>{centre_m}) - (b * Point<Spine>{centre_m})).norm() < kAlike_m &&
         rotation_angle_rad(a.rotation(), b.rotation()) < kAlike_rad;
}

}  // namespace

std::vector<Transform<Scan, Spine>> spine_starts(const Case& subject, std::span<const Shaft> shafts,
                                                 std::size_t most) {
  const std::vector<Line> planned = planned_lines(subject);
  std::vector<Start> all = all_starts(planned, shaft_lines(shafts));
  std::stable_sort(all.begin(), all.end(), [](const Start& a, const Start& b) {
    return a.screws != b.screws ? a.screws > b.screws : a.misfit_m < b.misfit_m;
  });
  Vec3 centre_m;
  for (const Line& line : planned) {
    centre_m += line.tip_m / static_cast<double>(planned.size());
  }
  std::vector<Transform<Scan, Spine>> out;
  for (const Start& start : all) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const auto& other) {
      return alike(start.pose, other, centre_m);
    });
    if (!known && out.size() + 1 < most) {
      out.push_back(start.pose);
    }
  }
  out.emplace_back();
  return out;
}

}  // namespace orthonav::engine
