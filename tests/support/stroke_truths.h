#pragma once

#include <cstdint>

#include "nav/geometry/mesh.h"
#include "tests/support/digitized_strokes.h"

namespace orthonav::test {

/// How soft tissue covers the stroked bone.
enum class Tissue {
  kUniform,  ///< equally thick everywhere
  kSmooth,   ///< uneven: a smooth field over the bone, SD half its mean
  kAreas,    ///< each region of the bone has a thickness of its own, SD half their mean
  kStrokes,  ///< each stroke presses as it likes, SD half their mean
  kValleys,  ///< thick in valleys, thin on ridges
};
inline constexpr Tissue kTissues[] = {Tissue::kUniform, Tissue::kSmooth, Tissue::kAreas,
                                      Tissue::kStrokes, Tissue::kValleys};
[[nodiscard]] const char* name_of(Tissue tissue);

/// Errors of strokes other than the tracker's noise.
struct StrokeTruths {
  Tissue tissue = Tissue::kSmooth;
  double mean_tissue_m = 0.0;
  /// SD along each axis of a shift that all points share (calibration, tip).
  double common_sd_m = 0.0;
  int copies = 1;  ///< of every sample, one after the other
  /// SD along an axis of a copy's place about the sample's: the same place sent again, resampled.
  double copy_jitter_m = 0.0;
  bool shuffled = false;  ///< samples in any order, as a file may hold them
  /// Points of a left-handed frame: their x changes sign. No rigid motion maps the bone to them.
  bool left_handed = false;
};

/// Moves the tips off the bone, and shifts all points together. Samples already off the bone stay.
/// The fields are lattice noise (a value at each node of a 14 mm grid, blended by quintic
/// polynomials, below zero cut off): no Gaussian process. The same seed gives the same tissue.
void apply_truths(const StrokeTruths& truths, const nav::TriangleMesh& mesh, std::uint64_t seed,
                  DigitizedStrokes& strokes);

/// The bone as a segmentation sees it: every vertex moved along its normal by lattice noise of this
/// SD over 7 mm.
[[nodiscard]] nav::TriangleMesh segmented(const nav::TriangleMesh& mesh, double sd_m,
                                          std::uint64_t seed);
[[nodiscard]] nav::TriangleMesh scaled(const nav::TriangleMesh& mesh, double factor);
/// The mirror image, left and right swapped.
[[nodiscard]] nav::TriangleMesh mirrored(const nav::TriangleMesh& mesh);

}  // namespace orthonav::test
