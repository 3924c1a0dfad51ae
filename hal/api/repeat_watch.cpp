#include "hal/api/repeat_watch.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace orthonav {
namespace {

constexpr std::uint64_t kOddFactor = 0x9e3779b97f4a7c15U;  // 2^64 over the golden ratio
/// A pose that a device interpolates between two equal ones is equal up to rounding; a head does
/// not rest within a nanometre and a nanoradian.
constexpr double kSamePose = 1e-9;

constexpr std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * kOddFactor;
  return hash ^ (hash >> 32U);
}

/// In four lanes, so that multiplications need not wait for one another: 300 kB in some 20 µs.
std::uint64_t hash_of(const GreyImage& picture) {
  std::array<std::uint64_t, 4> lanes = {1, 2, 3, 4};
  const std::uint8_t* at = picture.pixels.data();
  std::size_t left = picture.pixels.size();
  for (; left >= sizeof(lanes); left -= sizeof(lanes), at += sizeof(lanes)) {
    std::array<std::uint64_t, 4> words{};
    std::memcpy(words.data(), at, sizeof(words));
    for (std::size_t k = 0; k < lanes.size(); ++k) {
      lanes[k] = mixed(lanes[k], words[k]);
    }
  }
  std::uint64_t hash = 0;
  for (const std::uint64_t lane : lanes) {
    hash = mixed(hash, lane);
  }
  for (; left > 0; --left, ++at) {
    hash = mixed(hash, *at);
  }
  return hash;
}

bool is_same(const Transform<World, Rig>& a, const Transform<World, Rig>& b) {
  const Vec3 apart = a.translation() - b.translation();
  double most = std::max({std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)});
  for (int row = 0; row < 3; ++row) {
    const auto column = static_cast<std::size_t>(row);
    for (int other = 0; other < 3; ++other) {
      most = std::max(most, std::abs(a.rotation()[other][column] - b.rotation()[other][column]));
    }
  }
  return most <= kSamePose;
}

}  // namespace

std::optional<Repeated> of_pictures(bool left, bool right) {
  if (left && right) {
    return Repeated::kBothPictures;
  }
  if (left) {
    return Repeated::kLeftPicture;
  }
  return right ? std::optional(Repeated::kRightPicture) : std::nullopt;
}

const char* text_of(Repeated repeated) {
  switch (repeated) {
    case Repeated::kLeftPicture:
      return "the left camera repeats its picture";
    case Repeated::kRightPicture:
      return "the right camera repeats its picture";
    case Repeated::kBothPictures:
      return "both cameras repeat their pictures";
    case Repeated::kHeadPose:
      break;
  }
  return "head tracking repeats its pose";
}

bool RepeatWatch::Pictures::repeats(const GreyImage& picture) {
  const std::uint64_t hash = hash_of(picture);
  const auto end = hashes_.begin() + static_cast<std::ptrdiff_t>(std::min(count_, hashes_.size()));
  if (std::find(hashes_.begin(), end, hash) != end) {
    return true;
  }
  hashes_[count_++ % hashes_.size()] = hash;
  return false;
}

std::optional<Repeated> RepeatWatch::repeated(
    const GreyImage& left, const GreyImage& right,
    const std::optional<Transform<World, Rig>>& world_from_rig, MayRepeat may,
    std::optional<Repeated> told) {
  // Without pictures there is none that could change while the pose does not.
  const bool has_pictures = !left.pixels.empty() && !right.pixels.empty();
  std::optional<Repeated> found;
  if (has_pictures && !may.pictures) {
    const bool left_repeats = left_.repeats(left);
    const bool right_repeats = right_.repeats(right);
    const bool both = told == Repeated::kBothPictures;
    found = of_pictures(left_repeats || both || told == Repeated::kLeftPicture,
                        right_repeats || both || told == Repeated::kRightPicture);
  }
  if (has_pictures && !may.head_pose && world_from_rig) {
    const bool stands = last_pose_ && is_same(*last_pose_, *world_from_rig);
    last_pose_ = world_from_rig;
    found = !found && stands ? Repeated::kHeadPose : found;
  }
  return found;
}

std::optional<Repeated> RepeatWatch::look(
    const GreyImage& left, const GreyImage& right,
    const std::optional<Transform<World, Rig>>& world_from_rig, MayRepeat may,
    std::optional<Repeated> told) {
  const auto found = repeated(left, right, world_from_rig, may, told);
  if (found) {
    ++in_a_row_;
    last_ = *found;
    return found;
  }
  return std::exchange(in_a_row_, 0) >= 2 ? std::optional(last_) : std::nullopt;
}

}  // namespace orthonav
