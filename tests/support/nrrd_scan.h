#pragma once

#include <string>

#include "engine/scan/volume.h"

namespace orthonav::test {

/// Writes a scan in the patient's axes as NRRD of 16-bit values; returns whether it was written.
[[nodiscard]] bool write_nrrd(const std::string& path, const engine::Volume& scan);

}  // namespace orthonav::test
