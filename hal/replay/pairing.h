#pragma once

#include <cstdint>
#include <vector>

#include "hal/replay/image_tar.h"

namespace orthonav::replay {

struct MemberPair {
  ImageMember left;
  ImageMember right;
};

/// Pairs of images that are each other's nearest in time and at most `within_ticks` apart; both
/// lists are sorted by time, each time once. No image is in two pairs.
std::vector<MemberPair> paired(const std::vector<ImageMember>& left,
                               const std::vector<ImageMember>& right, std::int64_t within_ticks);

}  // namespace orthonav::replay
