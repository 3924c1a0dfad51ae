#include "hal/replay/pairing.h"

#include <cstdlib>

namespace orthonav::replay {

std::vector<MemberPair> paired(const std::vector<ImageMember>& left,
                               const std::vector<ImageMember>& right, std::int64_t within_ticks) {
  std::vector<MemberPair> pairs;
  std::size_t l = 0;
  std::size_t r = 0;
  while (l < left.size() && r < right.size()) {
    const std::int64_t apart = right[r].ticks - left[l].ticks;
    const auto closer = [&](const ImageMember& a, const ImageMember& b) {
      return std::abs(a.ticks - b.ticks) < std::abs(apart);
    };
    if (apart > within_ticks) {
      ++l;
    } else if (apart < -within_ticks) {
      ++r;
    } else if (r + 1 < right.size() && closer(right[r + 1], left[l])) {
      ++r;
    } else if (l + 1 < left.size() && closer(left[l + 1], right[r])) {
      ++l;
    } else {
      pairs.push_back({left[l++], right[r++]});
    }
  }
  return pairs;
}

}  // namespace orthonav::replay
