#pragma once

#include <cstdint>
#include <optional>

#include "hal/hl2ss/picture_order.h"

namespace orthonav::hl2ss {

/// By `frame_num` of the slice headers (ITU-T H.264, 7.3.2.1, 7.3.3 and 7.4.3).
class H264Order final : public PictureOrder {
 public:
  Status follow(Bytes access_unit) override;
  void restart() override { last_.reset(); }

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
