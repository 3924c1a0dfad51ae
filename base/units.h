#pragma once

namespace orthonav {

/// Millimetres live in files, speech and readouts only.
inline constexpr double kMetresPerMm = 1e-3;

}  // namespace orthonav
