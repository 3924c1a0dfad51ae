#pragma once

#include <string>

#include "base/result.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// Reads a volume: NIfTI (`.nii`, `.nii.gz`), NRRD (`.nrrd`, `.seg.nrrd`), or a folder of DICOM
/// slices of one series (`series`: its UID, where the folder holds several), in HU. DICOM slices
/// are ordered by position (engine/scan/dicom_order.h); files that are not DICOM are skipped.
/// Refuses in one line unreadable files, those without three dimensions, more than 2^30 voxels,
/// axes that are not at right angles or spacings outside 0.05-20 mm, and files whose voxels are not
/// in them. Needs the Insight Toolkit, which runs in a child process: GDCM ends its program by
/// assertions where a file is damaged.
Result<Volume> load_volume(const std::string& path, const std::string& series = {});

}  // namespace orthonav::engine
