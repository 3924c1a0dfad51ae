#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "nav/geometry/mesh.h"
#include "nav/guidance/screw.h"

namespace orthonav::test {

/// A real vertebra with its plan.
struct AnatomyLevel {
  std::string name;  ///< "shape-mean/L4"
  nav::TriangleMesh mesh;
  std::vector<nav::ScrewPlan> screws;
};

/// Every level in alphabetical order: of the shared anatomy, or of the project's own five where
/// that is absent.
std::vector<AnatomyLevel> anatomy_levels();
/// Every fourth of them, or all of the five.
std::vector<AnatomyLevel> sampled_anatomy_levels();
/// One of them, or none.
std::optional<AnatomyLevel> anatomy_level(const std::string& name);

/// Which regions a simulated surgeon strokes.
struct StrokeRegions {
  bool laminae = true;
  bool spinous_process = true;
  bool facets = true;
};

/// Pointer tips of strokes over the posterior surface, without noise, in the model's frame: the
/// parts seen straight from behind at the laminae and the facets (out to a little beyond the entry
/// points) and from both sides at the spinous process. 0.7 mm apart: 20 mm/s at 30 Hz.
std::vector<Vec3> strokes(const AnatomyLevel& level, const StrokeRegions& regions, Random& random);

/// A uniformly distributed random orientation.
Mat3 random_rotation(Random& random);

}  // namespace orthonav::test
