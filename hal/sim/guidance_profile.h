#pragma once

#include <cstdint>

namespace orthonav::sim {

/// What a surgeon goes by on the display while placing an instrument.
enum class GuidanceProfile : std::uint8_t {
  kOverlay,     ///< entry and trajectory as they hang over the bone; no number is read
  kNumbers,     ///< the entry as it hangs there; the angle by number, triangle and cross
  kClosedLoop,  ///< entry and angle by the numbers at the cross, and on while drilling
};

}  // namespace orthonav::sim
