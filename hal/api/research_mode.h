#pragma once

#include "base/time.h"

namespace orthonav {

/// HoloLens 2's research mode stamps the images of its four grey cameras late by this much, 3/8 of
/// a frame, and a head pose requested at the stamp is late by the same time: 3 mm at a pointer's
/// tip at 30 degrees per second. Found by users (microsoft/HoloLens2ForCV, issues 86, 117 and 134);
/// jdibenes/hl2ss subtracts it if its client asks, StreamRecorder's files hold the late stamps.
/// Depth cameras are not known to be late.
inline constexpr Duration kResearchModeStampsLate = std::chrono::microseconds(12'500);

/// Of the front cameras, nominally.
inline constexpr Duration kGreyCameraInterval = std::chrono::nanoseconds(33'333'333);

}  // namespace orthonav
