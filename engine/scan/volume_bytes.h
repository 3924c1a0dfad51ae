#pragma once

#include <string_view>
#include <vector>

#include "base/result.h"
#include "engine/scan/dicom_order.h"
#include "engine/scan/volume.h"

namespace orthonav::engine {

/// A volume, or why there is none, from one process to another of the same program. False where the
/// file can't be written.
bool write_volume(int file, const Result<Volume>& volume);
Result<Volume> volume_of(std::string_view bytes);

/// The same for a list of series.
bool write_series(int file, const std::vector<SeriesSummary>& series);
std::vector<SeriesSummary> series_of(std::string_view bytes);

}  // namespace orthonav::engine
