#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/random.h"
#include "engine/holograms/labels/glare_patches.h"
#include "render/scene.h"

namespace orthonav::test {

/// What a label names: it must not be covered by another label, nor by its own.
struct NamedPlace {
  std::string name;
  render::Float3 at{};
  float radius_m = 0;
  bool wound = false;  ///< only for numbers that guide
};

/// A scene of labels close together, and what they must leave clear.
struct OperatingField {
  render::Scene scene;
  std::vector<NamedPlace> places;
  std::vector<engine::GlarePatch> papers;
};

// The patient lies prone: posterior is +y, the head towards +z, the left side at +x.

/// Names of all entry points from one to six lumbar levels, every other screw done, and the first
/// level's left screw being guided so that the tool leans by an angle.
OperatingField guided_levels(int levels, float lean_rad);
/// The same without a tool.
OperatingField entry_points(int levels);
/// A rod on each side through this many heads, with a bend between each two.
OperatingField rods(int heads);
/// This many touched places, some close together.
OperatingField checked_places(int count);

/// Both eyes at arm's length from any side above the patient, the head rolled.
std::vector<render::View> any_head(Random& random);
/// Seen from this far to the patient's left.
std::vector<render::View> head_at(float left_m, float above_m = 0.45f, float roll_rad = 0);

/// Unreadable texts in any of the views, one line each: ink over ink, ink over a place, numbers
/// that guide or the status line over paper. (The name of a place behind a tag may lie there too.)
std::vector<std::string> faults(const OperatingField& field,
                                const std::vector<render::View>& views);

/// Where a label is relative to the place it names, by its scene's texts.
struct Standing {
  render::TextAlign align = render::TextAlign::kLeft;
  float right = 0;
  float up = 0;
  bool shown = true;
  /// In cap heights; the depth follows the angle, which has a different height.
  friend bool operator==(const Standing& a, const Standing& b) {
    return a.align == b.align && std::abs(a.right - b.right) < 0.1f &&
           std::abs(a.up - b.up) < 0.1f && a.shown == b.shown;
  }
};
std::vector<Standing> standing(const render::Scene& scene);

}  // namespace orthonav::test
