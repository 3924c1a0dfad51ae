#pragma once

#include <string>

#include "engine/scan/volume.h"

namespace orthonav::test {

/// Writes a scan whose axes are those of the patient as NRRD of 16-bit values; whether it was
/// written.
[[nodiscard]] bool write_nrrd(const std::string& path, const engine::Volume& scan);

}  // namespace orthonav::test
