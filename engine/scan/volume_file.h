#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "engine/scan/dicom_order.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// Reads a volume: NIfTI (`.nii`, `.nii.gz`), NRRD (`.nrrd`, `.seg.nrrd`), or DICOM: a multi-frame
/// file, or a folder with one series (`series`: its UID, where there are several) anywhere below
/// it, in HU. What each must state: nifti_file.h, nrrd_file.h, dicom_folder.h. Refuses in one line
/// what states it not at all, or twice and differently. The readers run in a child process: a
/// damaged file may end it, or take its time.
Result<Volume> load_volume(const std::string& path, const std::string& series = {});

/// Each DICOM series in a folder or file, in a child process too.
Result<std::vector<SeriesSummary>> list_series(const std::string& path);

}  // namespace orthonav::engine
