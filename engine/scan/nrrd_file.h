#pragma once

#include <string>

#include "base/result.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// A NRRD file with its voxels in it (https://teem.sourceforge.net/nrrd/format.html), metres, LPS;
/// `key:=value` pairs are its fields. The header must state a patient's `space` (LPS, RAS or LAS),
/// `space directions` and `space origin`; `space units` are mm where absent. Refuses as
/// `squared_grid` does, and voxels in another file.
/// Messages follow the name of the file.
Result<Volume> read_nrrd(const std::string& path);

}  // namespace orthonav::engine
