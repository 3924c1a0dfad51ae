#pragma once

#include <cstdint>
#include <optional>

#include "hal/hl2ss/picture_order.h"

namespace orthonav::hl2ss {

/// By the picture order count of the slice headers (ITU-T H.265, 7.3.2.2, 7.3.2.3, 7.3.6.1 and
/// 8.3.1), which must grow by one from picture to picture: streams without delay have no other
/// order. One encoder at a time: the last parameter sets hold.
class HevcOrder final : public PictureOrder {
 public:
  Status follow(Bytes access_unit) override;
  void restart() override { last_count_.reset(); }

 private:
  /// What the parameter sets say of a slice header.
  struct SliceFormat {
    std::uint32_t count_bits = 0;  ///< of the picture order count; 0: no sequence set seen yet
    std::uint32_t extra_bits = 0;
    bool says_output = false;
    bool has_planes = false;  ///< three colour planes, coded separately
    bool has_picture_set = false;
  };
  Status read_parameters(std::uint8_t kind, Bytes unit);
  Status follow_slice(std::uint8_t kind, Bytes unit);

  SliceFormat format_;
  std::optional<std::uint32_t> last_count_;
};

}  // namespace orthonav::hl2ss
