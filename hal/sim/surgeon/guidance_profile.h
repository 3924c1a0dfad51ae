#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace orthonav::sim {

/// What a surgeon uses on the display while placing an instrument.
enum class GuidanceProfile : std::uint8_t {
  kOverlay,     ///< entry and trajectory as shown over the bone; no number is read
  kNumbers,     ///< the entry as shown; the angle by number, triangle and cross
  kClosedLoop,  ///< entry and angle by the numbers at the cross, also while drilling
  kPublished,   ///< the entry as shown; the angle by number and triangle (Liebmann et al. 2019)
};

struct NamedGuidance {
  std::string_view name;
  GuidanceProfile value;
};
/// The names in profiles and on command lines.
inline constexpr std::array<NamedGuidance, 4> kGuidanceNames = {{
    {"overlay", GuidanceProfile::kOverlay},
    {"numbers", GuidanceProfile::kNumbers},
    {"closed loop", GuidanceProfile::kClosedLoop},
    {"published", GuidanceProfile::kPublished},
}};

}  // namespace orthonav::sim
