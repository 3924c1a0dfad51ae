#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/hologram_label.h"
#include "engine/session/text/wording.h"

namespace orthonav::engine::scene_builder_test {

inline constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};
inline constexpr double kExact = 1e-9;

/// What a frame of this guidance shows, in words.
inline ShownFrame shown(const Guidance& guidance) {
  SceneBuilder builder;
  ShownFrame frame;
  builder.update(guidance);
  builder.write_shown(guidance, frame);
  return frame;
}

/// The scene that is drawn for it.
inline render::Scene scene_of(const Guidance& guidance, const VisibilityRules& rules = {}) {
  SceneBuilder builder(rules);
  render::Scene scene;
  builder.update(guidance);
  builder.write_scene(guidance, scene);
  return scene;
}

/// The status line, without what was heard.
inline std::string line_of(const Guidance& guidance) {
  std::string line;
  append_without_heard(line, guidance.status);
  return line;
}

/// The first hologram of that kind, or null.
inline const ShownHologram* find(const ShownFrame& frame, HologramKind kind) {
  const auto it = std::find_if(frame.holograms.begin(), frame.holograms.end(),
                               [&](const ShownHologram& h) { return h.kind == kind; });
  return it == frame.holograms.end() ? nullptr : &*it;
}

inline const ShownHologram* find_entry(const ShownFrame& frame, const std::string& level,
                                       Side side) {
  const auto it =
      std::find_if(frame.holograms.begin(), frame.holograms.end(), [&](const ShownHologram& h) {
        return h.kind == HologramKind::kEntry && h.level == level && h.side == side;
      });
  return it == frame.holograms.end() ? nullptr : &*it;
}

/// The holograms (Hn) that a scene of this guidance draws something of.
inline std::vector<HologramKind> drawn(const Guidance& guidance) {
  const render::Scene scene = scene_of(guidance);
  std::vector<HologramKind> ids;
  const auto note = [&](render::Label label) { ids.push_back(kind_of(label)); };
  for (const auto& item : scene.meshes) {
    note(item.label);
  }
  for (const auto& item : scene.lines) {
    note(item.label);
  }
  for (const auto& item : scene.triangles) {
    note(item.label);
  }
  for (const auto& item : scene.texts) {
    note(item.label);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// The same for the frame that the display is told.
inline std::vector<HologramKind> told(const Guidance& guidance) {
  std::vector<HologramKind> ids{HologramKind::kStatus};
  for (const ShownHologram& h : shown(guidance).holograms) {
    ids.push_back(h.kind);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

}  // namespace orthonav::engine::scene_builder_test
