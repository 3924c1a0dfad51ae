#include "engine/session/calibration_in_use.h"

namespace orthonav::engine {

CalibrationInUse calibration_in_use(const nav::ToolTracker& tracker) {
  CalibrationInUse out;
  for (std::size_t i = 0; i < tracker.tools().size(); ++i) {
    if (const auto size = tracker.tag_size(i)) {
      out.tags.push_back({tracker.tools()[i].name, size->applied, size->fraction, size->sd});
    }
  }
  if (const auto found = tracker.alignment()) {
    out.cameras = CamerasInUse{
        found->rotation_rad.norm(), found->applied,     found->focal_fraction, found->focal_sd,
        found->baseline_fraction,   found->baseline_sd, found->pairs};
  }
  out.pairs_refused = tracker.picture_agreement().refused;
  return out;
}

}  // namespace orthonav::engine
