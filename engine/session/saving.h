#pragma once

#include <cstdint>

#include "base/time.h"

namespace orthonav::engine {

/// Whether what was done lately would survive a crash.
enum class Saved : std::uint8_t {
  kNothingNew,  ///< nothing was done for a while, or it is on its way to the disk
  kSaved,       ///< it is on the disk
  kNotSaved,    ///< and nothing will be any more: the disk failed
};

/// Asked in every step. Allocates nothing and waits for nobody.
class SaveWatch {
 public:
  virtual ~SaveWatch() = default;
  /// `lately`: for so long before `now`.
  [[nodiscard]] virtual Saved saved(Timestamp now, Duration lately) const = 0;
};

}  // namespace orthonav::engine
