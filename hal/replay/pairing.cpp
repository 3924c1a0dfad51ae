#include "hal/replay/pairing.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace orthonav::replay {
namespace {

/// The image nearest to a time; the earlier one if two are equally near. There must be at least
/// one.
const ImageMember& nearest(const std::vector<ImageMember>& images, std::int64_t ticks) {
  const auto after =
      std::lower_bound(images.begin(), images.end(), ticks,
                       [](const ImageMember& image, std::int64_t t) { return image.ticks < t; });
  if (after == images.begin()) {
    return *after;
  }
  const auto before = std::prev(after);
  return after == images.end() || ticks - before->ticks <= after->ticks - ticks ? *before : *after;
}

}  // namespace

std::vector<MemberPair> paired(const std::vector<ImageMember>& left,
                               const std::vector<ImageMember>& right, std::int64_t within_ticks) {
  std::vector<MemberPair> pairs;
  for (const ImageMember& l : left) {
    if (right.empty()) {
      break;
    }
    const ImageMember& r = nearest(right, l.ticks);
    if (std::abs(r.ticks - l.ticks) <= within_ticks && nearest(left, r.ticks).ticks == l.ticks) {
      pairs.push_back({l, r});
    }
  }
  return pairs;
}

}  // namespace orthonav::replay
