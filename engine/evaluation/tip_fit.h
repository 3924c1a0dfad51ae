#pragma once

#include <vector>

#include "engine/evaluation/shaft.h"

namespace orthonav::engine {

/// Where tips meet, the search for shafts gives one shaft's end to the other. Fits anew where both
/// end: the two lengths along the fitted axes that together explain the voxels about both best.
/// Marks the shafts that touch, and those whose end is not seen, since another length explains the
/// voxels as well: such a shaft ends where it is surely still metal.
void fit_touching_tips(const ScanField& scan, std::vector<Shaft>& shafts);

}  // namespace orthonav::engine
