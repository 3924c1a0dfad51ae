#pragma once

#include <cstdint>
#include <optional>

#include "base/result.h"
#include "hal/hl2ss/bytes.h"

namespace orthonav::hl2ss {

/// Detects missing pictures in a stream of access units (Annex B), by `frame_num` of the slice
/// headers (ITU-T H.264, 7.3.2.1, 7.3.3 and 7.4.3). libavcodec decodes the units after a missing
/// picture without an error, and the result is a wrong picture.
class H264Order {
 public:
  /// Takes the next access unit; an Error if a picture that it depends on never arrived.
  Status follow(Bytes access_unit);
  void restart() { last_.reset(); }

 private:
  struct Picture {
    std::uint32_t frame_num = 0;
    bool is_reference = false;
  };
  Status follow(const Picture& next, bool is_key);

  std::uint32_t frame_num_bits_ = 0;  ///< 0: no parameter set seen yet
  std::optional<Picture> last_;
};

}  // namespace orthonav::hl2ss
