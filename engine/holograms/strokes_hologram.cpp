#include "engine/holograms/hologram.h"

#include <algorithm>
#include <map>

#include "engine/holograms/shapes/hologram_parts.h"
#include "engine/holograms/shapes/render_values.h"
#include "nav/published/stroke_pattern.h"

namespace orthonav::engine {
namespace {

/// H1, and with the published method the picture of where to stroke.
class Strokes : public Hologram {
 public:
  explicit Strokes(Surfaces& surfaces) : surfaces_(surfaces) {}

  void draw(const Guidance& guidance, const Visibility& visible, render::Scene& scene) override {
    const bool checks = visible.vertebra && (!guidance.to_check.empty() ||
                                             !visible.vertebra->level->check_points.empty());
    std::size_t measured = 0;  // samples of saved regions so far
    const auto add = [&](const nav::Region& region, std::size_t k, float opacity) {
      points_.clear();
      for (const nav::Sample& sample : region.samples) {
        points_.push_back(to_float3(sample.tip_in_world.v));
      }
      const std::size_t first = measured;
      if (region.saved) {
        measured += points_.size();
      }
      if (points_.size() < 2) {
        return;
      }
      if (region.saved && measured <= guidance.residuals_m.size()) {
        return add_residual_path(
            scene, points_, guidance.residuals_m.subspan(first, points_.size()),
            label_of(HologramKind::kPath, k), checks ? kPathBehindChecks : 1.0f);
      }
      add_sampled_path(scene, points_, region.saved ? PathState::kSaved : PathState::kRecording,
                       label_of(HologramKind::kPath, k), opacity);
    };
    if (visible.paths) {
      // Older ones are dimmer, so that the newest stands out.
      constexpr float kFade = 0.15f;
      constexpr float kLeast = 0.4f;
      for (std::size_t k = 0; k < guidance.regions.size(); ++k) {
        const auto age = static_cast<float>(guidance.regions.size() - 1 - k);
        add(guidance.regions[k], k + 1, std::max(kLeast, 1.0f - kFade * age));
      }
    }
    if (visible.paths && guidance.dropped) {
      // A deleted region fades, so that the surgeon sees which one it was.
      const double age_s = seconds(guidance.display_time - guidance.dropped->dropped_at);
      const double left = 1.0 - age_s / seconds(guidance.fade);
      if (left > 0.0) {
        add(guidance.dropped->region, kMaxInstances, static_cast<float>(std::min(left, 1.0)));
      }
    }
    if (visible.stroke_pattern) {
      add_stroke_pattern(guidance, scene);
    }
  }

  void tell(const Guidance& guidance, const Visibility& visible, ShownHolograms& told) override {
    // The newest samples are enough to see where the tip is.
    constexpr std::size_t kLatestSamples = 8;
    if (visible.paths && !guidance.regions.empty()) {
      const auto& samples = guidance.regions.back().samples;
      ShownHologram& path = told.add(HologramKind::kPath);
      const std::size_t first = samples.size() - std::min(samples.size(), kLatestSamples);
      for (std::size_t i = first; i < samples.size(); ++i) {
        path.points_in_world.push_back(samples[i].tip_in_world);
      }
    }
  }

 private:
  /// The bone from behind, smaller than it is, on the left of the view, with the strokes over it.
  void add_stroke_pattern(const Guidance& guidance, render::Scene& scene) {
    constexpr Vec3 kIn_view_m{-0.035, 0.0, -0.50};
    constexpr double kScale = 0.6;
    constexpr float kWidth_m = 0.0012F;
    constexpr render::Label kLabel = label_of(HologramKind::kPath, kMaxInstances - 1);
    const LevelState& level = guidance.levels[guidance.level];
    const nav::VertebraModel& model = *level.plan.model;
    const auto [found, made] = patterns_.try_emplace(&model);
    if (made) {
      found->second = nav::published::stroke_pattern(model.reachable(), model.reachable_surface());
    }
    // Seen from behind: the patient's left on the left, superior up, posterior towards the eyes.
    const Mat3 view_from_vertebra = Mat3::from_columns({-1, 0, 0}, {0, 0, 1}, {0, 1, 0});
    const Transform<World, Rig>& head = *guidance.head;
    const Mat3 rotation = head.rotation() * view_from_vertebra;
    const Vec3 middle_m = bounds_of(model.reachable()).centre();
    const Vec3 shift = (head * Point<Rig>{kIn_view_m}).v - kScale * (rotation * middle_m);
    std::array<double, 16> placed = Transform<World, Vertebra>(rotation, shift).row_major();
    for (const std::size_t i : {0U, 1U, 2U, 4U, 5U, 6U, 8U, 9U, 10U}) {
      placed[i] *= kScale;
    }
    add_vertebra(scene, surfaces_.of(level), to_matrix(placed), kLabel);
    for (const std::vector<Vec3>& line : found->second) {
      points_.clear();
      for (const Vec3 place : line) {
        points_.push_back(to_float3(kScale * (rotation * place) + shift));
      }
      add_line(scene, points_, kWidth_m, look::kWhite, kLabel);
    }
  }

  Surfaces& surfaces_;
  /// The lines of the pattern, in the frame of the model.
  std::map<const nav::VertebraModel*, std::vector<std::vector<Vec3>>> patterns_;
  std::vector<render::Float3> points_;
};

}  // namespace

std::unique_ptr<Hologram> strokes_hologram(Surfaces& surfaces) {
  return std::make_unique<Strokes>(surfaces);
}

}  // namespace orthonav::engine
