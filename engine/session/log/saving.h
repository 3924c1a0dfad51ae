#pragma once

#include <cstdint>

#include "base/time.h"

namespace orthonav::engine {

/// Whether recent actions would survive a crash.
enum class Saved : std::uint8_t {
  kNothingNew,   ///< nothing was done recently, or it is still being written
  kSaved,        ///< everything is on the disk
  kNotSaved,     ///< the disk failed, and nothing is saved any more
  kNotRecorded,  ///< a requested recording has stopped; the operation itself is saved
};

/// Asked in every step. Must not allocate or block.
class SaveWatch {
 public:
  virtual ~SaveWatch() = default;
  /// Anything older than `lately` before `now` is not new.
  [[nodiscard]] virtual Saved saved(Timestamp now, Duration lately) const = 0;
};

}  // namespace orthonav::engine
