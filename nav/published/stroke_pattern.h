#pragma once

#include <vector>

#include "nav/geometry/mesh.h"

namespace orthonav::nav::published {

/// The strokes in which the publication's surgeons were trained, as a picture shows them (Liebmann
/// et al. 2019, section 3.2; the paper does not draw them): both transverse processes from tip to
/// tip, the crest of the spinous process, and a line over each lamina. They reach the three places
/// that the registration compares (registration.h). Lines over the trimmed model seen from behind,
/// in its frame (LPS, metres); empty where it has no such surface.
[[nodiscard]] std::vector<std::vector<Vec3>> stroke_pattern(const TriangleMesh& trimmed,
                                                            const SurfaceIndex& surface);

}  // namespace orthonav::nav::published
