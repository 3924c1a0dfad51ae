#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace orthonav::sim {

/// What a surgeon goes by on the display while placing an instrument.
enum class GuidanceProfile : std::uint8_t {
  kOverlay,     ///< entry and trajectory as they hang over the bone; no number is read
  kNumbers,     ///< the entry as it hangs there; the angle by number, triangle and cross
  kClosedLoop,  ///< entry and angle by the numbers at the cross, and on while drilling
};

struct NamedGuidance {
  std::string_view name;
  GuidanceProfile value;
};
/// As profiles and command lines call them.
inline constexpr std::array<NamedGuidance, 3> kGuidanceNames = {{
    {"overlay", GuidanceProfile::kOverlay},
    {"numbers", GuidanceProfile::kNumbers},
    {"closed loop", GuidanceProfile::kClosedLoop},
}};

}  // namespace orthonav::sim
