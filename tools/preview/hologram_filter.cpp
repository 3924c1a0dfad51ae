#include "tools/preview/hologram_filter.h"

#include <algorithm>
#include <iterator>

namespace orthonav::preview {

void HologramFilter::show(unsigned number, bool shown) {
  if (number <= kLastHologram) {
    shown_.set(number, shown);
  }
}

void HologramFilter::toggle_all() {
  if (shown_.all()) {
    shown_.reset();
  } else {
    shown_.set();
  }
}

void HologramFilter::apply(const render::Scene& scene, render::Scene& seen) const {
  const auto copy = [this](const auto& from, auto& to) {
    to.clear();
    std::copy_if(from.begin(), from.end(), std::back_inserter(to),
                 [this](const auto& item) { return shows(item.label / 100); });
  };
  copy(scene.meshes, seen.meshes);
  copy(scene.lines, seen.lines);
  copy(scene.triangles, seen.triangles);
  copy(scene.texts, seen.texts);
}

}  // namespace orthonav::preview
