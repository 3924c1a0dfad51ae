#pragma once

#include "base/tracked.h"

namespace orthonav {

/// "measured", "predicted", "lost": in files and interfaces, whatever the display says.
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
