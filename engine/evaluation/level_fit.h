#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/case/case.h"
#include "engine/evaluation/bone_registration.h"

namespace orthonav::engine {

/// One vertebra of the case to be registered to its bone.
struct LevelSurface {
  const CaseLevel* level = nullptr;
  std::vector<SurfaceSample> few;   ///< for trying starts
  std::vector<SurfaceSample> many;  ///< for the fit itself
};

/// A registered level, or why the fit is refused.
struct LaidLevel {
  BoneRegistration bone;
  std::string refusal;  ///< empty: accepted
};

/// The best fit of each level, in their order: coverage decides. `starts` are those of the whole
/// spine. A level whose place contradicts the others is refused. An Error if the spine fits the
/// scan nearly equally well in two places.
Result<std::vector<LaidLevel>> laid_levels(const ScanField& scan, const MetalMask& mask,
                                           std::span<const LevelSurface> levels,
                                           std::span<const Transform<Scan, Spine>> starts);

}  // namespace orthonav::engine
