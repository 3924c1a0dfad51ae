#pragma once

#include <map>
#include <memory>

#include "engine/holograms/shapes/hologram_label.h"
#include "engine/holograms/visibility.h"
#include "engine/session/guidance.h"
#include "engine/session/shown_frame.h"
#include "render/scene.h"

namespace orthonav::engine {

/// The holograms of a frame in words. Reuses the frame's buffers: in the steady state it allocates
/// nothing.
class ShownHolograms {
 public:
  explicit ShownHolograms(ShownFrame& frame) : frame_(frame) {}
  ShownHologram& add(HologramKind kind);
  /// Ends the frame.
  void end() { frame_.holograms.resize(used_); }
  [[nodiscard]] ShownFrame& frame() { return frame_; }

 private:
  ShownFrame& frame_;
  std::size_t used_ = 0;
};

/// The levels' surfaces, each made once: the renderer keeps its copies by pointer.
class Surfaces {
 public:
  const std::shared_ptr<const render::MeshData>& of(const LevelState& level);

 private:
  std::map<const nav::VertebraModel*, std::shared_ptr<const render::MeshData>> made_;
};

/// A hologram, or a few that are one idea, whole: what a frame shows of it, as items of the scene
/// and as what a person wearing the display reads off it. `visible` says what more than one of them
/// depends on. Neither allocates in the steady state.
class Hologram {
 public:
  virtual ~Hologram() = default;
  virtual void draw(const Guidance& guidance, const Visibility& visible, render::Scene& scene) = 0;
  virtual void tell(const Guidance& guidance, const Visibility& visible, ShownHolograms& told) = 0;
};

// Each in the source of its name, in the order in which they are drawn.
std::unique_ptr<Hologram> strokes_hologram(Surfaces& surfaces);
std::unique_ptr<Hologram> bone_hologram(Surfaces& surfaces);
std::unique_ptr<Hologram> entries_hologram();
std::unique_ptr<Hologram> next_place_hologram();  // bone_hologram.cpp
std::unique_ptr<Hologram> selected_screw_hologram(Surfaces& surfaces);
std::unique_ptr<Hologram> rods_hologram();
std::unique_ptr<Hologram> status_hologram();

// Labels that decide what stays in a frame that is drawn late (scene_builder.cpp).
namespace labels {
inline constexpr render::Label kCross = label_of(HologramKind::kCross, 1);  // its dots: the next
inline constexpr render::Label kTwinTool = label_of(HologramKind::kTwin, 2);
inline constexpr render::Label kNextAct = label_of(HologramKind::kNumbers, 2);
inline constexpr render::Label kStop = label_of(HologramKind::kNumbers, 5);
}  // namespace labels

}  // namespace orthonav::engine
