#pragma once

#include "base/tracked.h"

namespace orthonav {

/// "measured", "predicted", "lost": the names in files and interfaces, independent of the display's
/// wording.
[[nodiscard]] constexpr const char* name_of(PoseStatus status) {
  switch (status) {
    case PoseStatus::kMeasured:
      return "measured";
    case PoseStatus::kPredicted:
      return "predicted";
    case PoseStatus::kLost:
      break;
  }
  return "lost";
}

}  // namespace orthonav
