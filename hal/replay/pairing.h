#pragma once

#include <cstdint>
#include <vector>

#include "hal/replay/image_tar.h"

namespace orthonav::replay {

struct MemberPair {
  ImageMember left;
  ImageMember right;
};

/// Each left image with the right one nearest in time, at most `within_ticks` apart; both lists by
/// time. An image that is nearer to another than to its neighbour's partner stays alone.
std::vector<MemberPair> paired(const std::vector<ImageMember>& left,
                               const std::vector<ImageMember>& right, std::int64_t within_ticks);

}  // namespace orthonav::replay
