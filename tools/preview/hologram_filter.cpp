#include "tools/preview/hologram_filter.h"
#include "engine/holograms/shapes/hologram_label.h"

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
    std::copy_if(from.begin(), from.end(), std::back_inserter(to), [this](const auto& item) {
      return shows(static_cast<unsigned>(engine::kind_of(item.label)));
    });
  };
  copy(scene.meshes, seen.meshes);
  copy(scene.lines, seen.lines);
  copy(scene.triangles, seen.triangles);
  copy(scene.texts, seen.texts);
}

}  // namespace orthonav::preview
