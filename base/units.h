#pragma once

namespace orthonav {

/// Millimetres are used only in files, speech and readouts.
inline constexpr double kMetresPerMm = 1e-3;

}  // namespace orthonav
