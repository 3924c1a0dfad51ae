#pragma once

#include <optional>

#include "base/time.h"
#include "base/transform.h"

namespace orthonav {

/// Detects that the map has moved: two consecutive poses of a head show a motion that no head could
/// have made. A wrong stamp alone does not count, nor does one that repeats.
class MapWatch {
 public:
  /// Takes the next pose; true if World has changed from this pose on. A pose no later than the one
  /// before is ignored: only its stamp, or both, may be wrong.
  bool moved(Timestamp time, const Transform<World, Rig>& world_from_rig);
  /// The next pose lies in another map.
  void break_off() { broken_off_ = true; }

 private:
  struct Seen {
    Timestamp time{};
    Transform<World, Rig> world_from_rig;
  };
  [[nodiscard]] bool is_possible(const Seen& next) const;

  std::optional<Seen> last_;
  std::optional<Seen> before_;  ///< the one before it, close enough in time to give a speed
  Duration ignored_{};          ///< in which poses since the last one may have been taken
  bool broken_off_ = false;
};

}  // namespace orthonav
