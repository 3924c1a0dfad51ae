#pragma once

#include <string>

#include "base/result.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// A NIfTI file (version 1 or 2, `.nii` or `.nii.gz`, either byte order), metres, LPS, its stored
/// scaling applied (NIfTI-1.1, https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h). What
/// the header leaves open or says twice is refused: no orientation (both form codes 0), an sform
/// and a qform that disagree, spacings that do, the space of a template, axes that are not at right
/// angles (`squared_grid`), voxels that are no numbers, a file that is cut off.
/// Messages follow the name of the file.
Result<Volume> read_nifti(const std::string& path);

}  // namespace orthonav::engine
