#pragma once

#include "base/result.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// Detects missing pictures in a stream of access units (Annex B). libavcodec decodes the units
/// after a missing picture without an error, and the result is a wrong picture.
class PictureOrder {
 public:
  virtual ~PictureOrder() = default;
  /// Takes the next access unit; an Error if a picture that it depends on never arrived.
  virtual Status follow(Bytes access_unit) = 0;
  virtual void restart() = 0;
};

}  // namespace orthonav::hl2ss
