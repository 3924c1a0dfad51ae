#include "engine/holograms/hologram.h"

#include <algorithm>
#include <array>
#include <map>

#include "engine/holograms/shapes/render_values.h"

namespace orthonav::engine {
namespace {

/// The four outermost points: behind, to either side, above.
std::array<Vec3, 4> landmarks_m(const nav::TriangleMesh& mesh) {
  constexpr std::array<Vec3, 4> kDirections = {{{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}}};
  std::array<Vec3, 4> found{};
  for (std::size_t d = 0; d < kDirections.size(); ++d) {
    found[d] = *std::max_element(
        mesh.vertices_m.begin(), mesh.vertices_m.end(),
        [&](Vec3 a, Vec3 b) { return a.dot(kDirections[d]) < b.dot(kDirections[d]); });
  }
  return found;
}

/// H2 with what is touched on it, H12: what is to be verified.
class Bone : public Hologram {
 public:
  explicit Bone(Surfaces& surfaces) : surfaces_(surfaces) {}

  void draw(const Guidance& guidance, const Visibility& visible, render::Scene& scene) override {
    if (!visible.vertebra) {
      return;
    }
    const PlacedLevel& at = *visible.vertebra;
    add_vertebra(scene, tinted_surface_of(*at.level, guidance.unstroked),
                 to_matrix(at.world_from_vertebra.row_major()),
                 label_of(HologramKind::kVertebra, 1));
    std::size_t k = 0;
    if (!guidance.to_check.empty()) {
      add_place_to_check(scene, to_float3(guidance.to_check.front().v),
                         label_of(HologramKind::kCheckPoint, ++k));
    }
    const std::vector<nav::CheckPoint>& touched = at.level->check_points;
    for (const nav::CheckPoint& point : touched) {
      const render::Label label = label_of(HologramKind::kCheckPoint, ++k);
      const render::Float3 place = to_float3(point.place.v);
      if (&point != &touched.back()) {
        add_earlier_check_point(scene, place, point.within, label);
      } else {
        add_check_point(scene, place, distance_text(point.distance_m), point.within, label);
      }
    }
  }

  void tell(const Guidance& guidance, const Visibility& visible, ShownHolograms& told) override {
    if (!visible.vertebra) {
      return;
    }
    const PlacedLevel& at = *visible.vertebra;
    ShownHologram& vertebra = told.add(HologramKind::kVertebra);
    const nav::VertebraModel& model = *at.level->plan.model;
    const auto [known, is_new] = landmarks_m_.try_emplace(&model);
    if (is_new) {
      known->second = landmarks_m(model.mesh());
    }
    for (const Vec3 landmark : known->second) {
      vertebra.points_in_world.push_back(at.world_from_vertebra * Point<Vertebra>{landmark});
    }
    for (const nav::CheckPoint& point : at.level->check_points) {
      ShownHologram& check = told.add(HologramKind::kCheckPoint);
      if (&point == &at.level->check_points.back()) {
        check.text = distance_text(point.distance_m);
      }
      check.reading = point.distance_m;
      check.points_in_world.push_back(point.place);
    }
    if (!guidance.to_check.empty()) {
      told.add(HologramKind::kCheckPoint).points_in_world.push_back(guidance.to_check.front());
    }
  }

 private:
  const std::shared_ptr<const render::MeshData>& tinted_surface_of(const LevelState& level,
                                                                   std::span<const float> tints) {
    const auto& surface = surfaces_.of(level);
    if (tints.size() != surface->positions.size()) {
      return surface;
    }
    const bool known = tinted_from_ == surface.get() &&
                       std::equal(tints.begin(), tints.end(), tinted_->tints.begin());
    if (!known) {
      auto tinted = std::make_shared<render::MeshData>(*surface);
      tinted->tints.assign(tints.begin(), tints.end());
      tinted_ = std::move(tinted);
      tinted_from_ = surface.get();
    }
    return tinted_;
  }

  Surfaces& surfaces_;
  std::shared_ptr<const render::MeshData> tinted_;  ///< of the registration shown last
  const render::MeshData* tinted_from_ = nullptr;   ///< the surface that it was made of
  /// Landmarks by which a person compares the hologram with the bone; found once per model.
  std::map<const nav::VertebraModel*, std::array<Vec3, 4>> landmarks_m_;
};

/// H12: the middle of what to stroke next, or the landmark to touch.
class NextPlace : public Hologram {
 public:
  void draw(const Guidance& /*guidance*/, const Visibility& visible,
            render::Scene& scene) override {
    constexpr render::Label kLabel = label_of(HologramKind::kCheckPoint, 1);
    if (visible.stroke_next) {
      add_place_to_stroke(scene, to_float3(visible.stroke_next->v), kLabel);
    }
    if (visible.landmark) {
      add_place_to_check(scene, to_float3(visible.landmark->v), kLabel);
    }
  }

  void tell(const Guidance& /*guidance*/, const Visibility& visible,
            ShownHolograms& told) override {
    for (const std::optional<Point<World>>& place : {visible.stroke_next, visible.landmark}) {
      if (place) {
        told.add(HologramKind::kCheckPoint).points_in_world.push_back(*place);
      }
    }
  }
};

}  // namespace

std::unique_ptr<Hologram> bone_hologram(Surfaces& surfaces) {
  return std::make_unique<Bone>(surfaces);
}
std::unique_ptr<Hologram> next_place_hologram() { return std::make_unique<NextPlace>(); }

}  // namespace orthonav::engine
