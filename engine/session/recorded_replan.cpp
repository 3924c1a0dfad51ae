#include "engine/session/recorded_replan.h"

#include "base/angle.h"

namespace orthonav::engine {
namespace {

constexpr double kMetresPerJournalMm = 1e-3;

}  // namespace

std::optional<nav::ScrewDifference> planned_in_surgery(const JsonNode& line) {
  if (!line.has("planned_in_surgery")) {
    return std::nullopt;
  }
  const JsonNode by = line.child("planned_in_surgery");
  return nav::ScrewDifference{by.number("entry_cranial_mm") * kMetresPerJournalMm,
                              by.number("entry_medial_mm") * kMetresPerJournalMm,
                              by.number("entry_inward_mm") * kMetresPerJournalMm,
                              by.number("aim_cranial_deg") * kRadiansPerDegree,
                              by.number("aim_medial_deg") * kRadiansPerDegree,
                              by.number("diameter_from_mm") * kMetresPerJournalMm,
                              by.number("diameter_to_mm") * kMetresPerJournalMm,
                              by.number("length_from_mm") * kMetresPerJournalMm,
                              by.number("length_to_mm") * kMetresPerJournalMm};
}

}  // namespace orthonav::engine
