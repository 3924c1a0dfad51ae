#pragma once

#include <cstdint>

#include "base/time.h"

namespace orthonav::engine {

/// Whether what was done lately would survive a crash.
enum class Saved : std::uint8_t {
  kNothingNew,   ///< nothing was done for a while, or it is on its way to the disk
  kSaved,        ///< it is on the disk
  kNotSaved,     ///< the disk failed: nothing is saved any more
  kNotRecorded,  ///< a recording was asked for and has stopped; nothing of the operation is lost
};

/// Asked in every step. Allocates nothing and waits for nobody.
class SaveWatch {
 public:
  virtual ~SaveWatch() = default;
  /// What happened longer than `lately` before `now` is nothing new.
  [[nodiscard]] virtual Saved saved(Timestamp now, Duration lately) const = 0;
};

}  // namespace orthonav::engine
