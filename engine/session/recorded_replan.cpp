#include "engine/session/recorded_replan.h"

#include "base/angle.h"
#include "base/units.h"

namespace orthonav::engine {
namespace {}  // namespace

std::optional<nav::ScrewDifference> planned_in_surgery(const JsonNode& line) {
  if (!line.has("planned_in_surgery")) {
    return std::nullopt;
  }
  const JsonNode by = line.child("planned_in_surgery");
  return nav::ScrewDifference{by.number("entry_cranial_mm") * kMetresPerMm,
                              by.number("entry_medial_mm") * kMetresPerMm,
                              by.number("entry_inward_mm") * kMetresPerMm,
                              by.number("aim_cranial_deg") * kRadiansPerDegree,
                              by.number("aim_medial_deg") * kRadiansPerDegree,
                              by.number("diameter_from_mm") * kMetresPerMm,
                              by.number("diameter_to_mm") * kMetresPerMm,
                              by.number("length_from_mm") * kMetresPerMm,
                              by.number("length_to_mm") * kMetresPerMm};
}

}  // namespace orthonav::engine
