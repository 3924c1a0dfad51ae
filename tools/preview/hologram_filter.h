#pragma once

#include <bitset>

#include "engine/session/shown_frame.h"
#include "render/scene.h"

namespace orthonav::preview {

inline constexpr unsigned kLastHologram = engine::kHolograms.size();

/// Which holograms are shown, by their numbers in docs ("H5" is 5); all at first.
class HologramFilter {
 public:
  HologramFilter() { shown_.set(); }
  [[nodiscard]] bool shows(unsigned number) const {
    return number > kLastHologram || shown_.test(number);
  }
  void show(unsigned number, bool shown);
  void toggle(unsigned number) { show(number, !shows(number)); }
  /// All of them; or none, when all are shown.
  void toggle_all();
  /// The scene without the hidden holograms; an item without a known number stays.
  void apply(const render::Scene& scene, render::Scene& seen) const;
  friend bool operator==(const HologramFilter&, const HologramFilter&) = default;

 private:
  std::bitset<kLastHologram + 1> shown_;
};

}  // namespace orthonav::preview
