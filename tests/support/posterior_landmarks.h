#pragma once

#include "base/result.h"
#include "nav/geometry/mesh.h"

namespace orthonav::test {

/// The place of a vertebra's posterior arch, measured on the mesh by rays (axes LPS, metres).
struct PosteriorLandmarks {
  double midline_x_m = 0.0;         ///< middle of the canal
  double canal_half_width_m = 0.0;  ///< from the midline to the pedicles' inner walls
  double body_back_y_m = 0.0;       ///< the canal's front wall in the midline
  double arch_front_y_m = 0.0;      ///< the canal's back wall in the midline
  double crest_y_m = 0.0;           ///< hindmost point of the spinous process
  double low_z_m = 0.0;             ///< of the mesh
  double high_z_m = 0.0;
};

/// An Error when rays from front to back find no canal.
Result<PosteriorLandmarks> find_posterior_landmarks(const nav::TriangleMesh& mesh,
                                                    const nav::SurfaceIndex& surface);

}  // namespace orthonav::test
