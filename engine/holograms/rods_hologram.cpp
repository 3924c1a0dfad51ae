#include "engine/holograms/hologram.h"

#include <string_view>

#include "engine/holograms/shapes/render_values.h"
#include "render/decimated.h"
#include "render/shapes.h"

namespace orthonav::engine {
namespace {

/// The level whose screw of that side has its entry nearest to the head.
std::string_view level_at(const Guidance& guidance, Side side, Point<World> head) {
  std::string_view name;
  double nearest_m = 0.0;
  for (const LevelState& level : guidance.levels) {
    if (!level.usable()) {
      continue;
    }
    for (const nav::ScrewPlan& screw : level.plan.screws) {
      const Point<World> entry = level.registration->world_from_vertebra * screw.entry;
      const double away_m = (entry - head).norm();
      if (screw.side == side && (name.empty() || away_m < nearest_m)) {
        name = level.plan.label;
        nearest_m = away_m;
      }
    }
  }
  return name;
}

/// From where to where the rods are shifted while they are moved away: sideways off the patient,
/// as a rigid body, each to its own side.
Vec3 rod_offset_m(const Guidance& guidance, const RodState& rod) {
  if (!guidance.rods_moved_away || !rod.visible()) {
    return {};
  }
  constexpr double kMovedAway_m = 0.150;
  constexpr Vec3 kUp{0, 1, 0};
  const Vec3 along = rod.heads.back() - rod.heads.front();
  Vec3 side = along.cross(kUp);
  if (side.norm() < 1e-6) {
    side = {1, 0, 0};
  }
  // Right-handed: the direction of `side` depends on the order of touching, so take the one that
  // leads away from the other rod.
  Vec3 centre_of_rods{};
  double count = 0.0;
  for (const RodState& other : guidance.rods) {
    if (!other.visible()) {
      continue;
    }
    for (const Point<World>& head : other.heads) {
      centre_of_rods += head.v;
      count += 1.0;
    }
  }
  const Vec3 outward = rod.heads.front().v - centre_of_rods / count;
  const double sign = outward.dot(side) < 0.0 ? -1.0 : 1.0;
  return side.normalized() * (sign * kMovedAway_m);
}

/// H10.
class Rods : public Hologram {
 public:
  void draw(const Guidance& guidance, const Visibility& visible, render::Scene& scene) override {
    if (!visible.rods) {
      return;
    }
    tubes_.resize(guidance.rods.size());
    for (std::size_t i = 0; i < guidance.rods.size(); ++i) {
      const RodState& rod = guidance.rods[i];
      if (!rod.visible()) {
        continue;
      }
      RodHologram hologram;
      hologram.tube = tube_of(i, rod);
      points_.clear();
      for (const Point<World>& head : rod.heads) {
        points_.push_back(to_float3(head.v));
      }
      hologram.heads = points_;
      bends_.clear();
      if (rod.rod) {
        for (const nav::RodBend& bend : rod.rod->bends) {
          bends_.push_back({to_float3(bend.position_m), bend.angle_rad, bend.arc_length_m});
        }
        hologram.length_m = rod.rod->length_m;
      }
      if (rod.instructions) {  // how it is made, in place of its shape
        bends_.clear();
        for (const nav::RodInstruction& bend : rod.instructions->bends) {
          bends_.push_back({to_float3(bend.middle_m), bend.arc.angle_rad, bend.arc.centre_m,
                            RodBendMark::Making{bend.arc.roll_rad, bend.set_rad}});
        }
        hologram.length_m = rod.instructions->cut_length_m();
        hologram.to_cut = true;
      }
      names_.clear();
      for (const Point<World>& head : rod.heads) {
        names_.push_back(level_at(guidance, rod.side, head));
      }
      hologram.head_names = names_;
      hologram.bends = bends_;
      hologram.first_bend_only = !guidance.asked.numbers;
      hologram.offset = to_float3(rod_offset_m(guidance, rod));
      add_rod(scene, hologram, label_of(HologramKind::kRod, i + 1));
    }
  }

  void tell(const Guidance& guidance, const Visibility& visible, ShownHolograms& told) override {
    if (!visible.rods) {
      return;
    }
    for (const RodState& rod : guidance.rods) {
      if (!rod.visible()) {
        continue;
      }
      const Vec3 offset = rod_offset_m(guidance, rod);
      ShownHologram& hologram = told.add(HologramKind::kRod);
      for (const Point<World>& head : rod.heads) {
        hologram.points_in_world.push_back(head + offset);
      }
    }
  }

 private:
  struct Tube {
    std::vector<Point<World>> points;  ///< heads or axis, for which the tube was made
    std::shared_ptr<const render::MeshData> mesh;
  };

  const std::shared_ptr<const render::MeshData>& tube_of(std::size_t i, const RodState& rod) {
    Tube& tube = tubes_[i];
    if (tube.points == rod.heads) {
      return tube.mesh;
    }
    tube.points = rod.heads;
    tube.mesh.reset();
    if (rod.rod) {
      std::vector<render::Float3> path;
      for (const Vec3 p : rod.rod->path_m) {
        path.push_back(to_float3(p));
      }
      tube.mesh =
          render::prepared(render::make_tube(path, static_cast<float>(rod.rod->diameter_m / 2.0)));
    }
    return tube.mesh;
  }

  std::vector<Tube> tubes_;
  std::vector<render::Float3> points_;
  std::vector<RodBendMark> bends_;
  std::vector<std::string_view> names_;
};

}  // namespace

std::unique_ptr<Hologram> rods_hologram() { return std::make_unique<Rods>(); }

}  // namespace orthonav::engine
