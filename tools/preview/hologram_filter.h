#pragma once

#include <array>
#include <bitset>

#include "render/scene.h"

namespace orthonav::preview {

/// A hologram by its number in docs ("H5" is 5) and its name.
struct HologramName {
  unsigned number;
  const char* name;
};
inline constexpr unsigned kLastHologram = 13;
inline constexpr std::array<HologramName, kLastHologram> kHolograms = {{
    {1, "sampled path"},
    {2, "vertebra"},
    {3, "entry points"},
    {4, "planned trajectory"},
    {5, "deviation triangle"},
    {6, "angle readout"},
    {7, "target cross"},
    {8, "virtual twin"},
    {9, "depth"},
    {10, "rod template"},
    {11, "status line"},
    {12, "check points"},
    {13, "numbers"},
}};

/// Which holograms are shown; all at first.
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
