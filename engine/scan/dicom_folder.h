#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "engine/scan/dicom_order.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// The slices of every DICOM file at `path`: a file, or a folder with all below it (an export of an
/// archive is nested; DICOMDIR is passed over). Multi-frame CT gives a slice for each frame. Every
/// object of a series counts, also one that is no slice of a CT: `SliceHeader::problem` says why.
[[nodiscard]] std::vector<SliceHeader> dicom_slices(const std::string& path);

/// The CT of one series at `path`, in HU. `series` picks it, where there are several. Refuses as
/// `one_series` and `stacked` do, and what does not state modality CT, its pixel spacing, its
/// rescale slope and intercept and one grey value a pixel, each once; segmentations, structure sets
/// and secondary captures by name; slices whose pixels end early.
/// Messages follow the name of the file.
Result<Volume> read_dicom(const std::string& path, const std::string& series);

/// Whether a file begins as DICOM files do.
[[nodiscard]] bool is_dicom(const std::string& path);

}  // namespace orthonav::engine
