#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/transform.h"
#include "hal/igtl/header.h"

namespace orthonav::igtl {

/// One pose that another program sends.
struct SentPose {
  std::string name;  ///< `ProbeToTracker`, at most 20 bytes
  /// Absent if the sender marks it as unknown: by its status, or by an exact identity, which
  /// PlusServer sends for a tool out of sight.
  std::optional<Transform<World, Marker>> world_from_marker;
};

/// Whether a message of this type holds poses: TRANSFORM, TDATA or QTDATA.
[[nodiscard]] bool holds_poses(const std::string& type);

/// The poses in such a message, from millimetres. An Error says what is wrong: a length that does
/// not fit the type, a number that is not finite, an invalid rotation (rows more than 0.001 from
/// orthonormal, or mirrored), a distance of more than 20 m.
Result<std::vector<SentPose>> poses_in(const Header& header, Bytes body);

}  // namespace orthonav::igtl
