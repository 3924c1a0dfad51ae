#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "base/random.h"
#include "nav/registration/search.h"
#include "tests/engine/case/model_files.h"

namespace orthonav::engine::model_cache_test {
namespace {

using nav::PreparedParts;
using nav::VertebraModel;
using test::TemporaryFolder;

std::size_t any_below(std::size_t below, Random& random) {
  return static_cast<std::size_t>(random.uniform() * static_cast<double>(below));
}

/// One way of spoiling a file; the seed says which and where.
std::string damaged(std::string bytes, Random& random) {
  const auto any = [&](std::size_t below) { return any_below(below, random); };
  // Half of the damages are in the header, which would otherwise hardly ever be hit.
  const std::size_t at = random.uniform() < 0.5 ? any(80) : any(bytes.size());
  const std::size_t length = std::min(1 + any(200), bytes.size() - at);
  switch (any(7)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << any(8)));
      break;
    case 1:
      for (std::size_t i = 0; i < length; ++i) {
        bytes[at + i] = static_cast<char>(random.next());
      }
      break;
    case 2:
      bytes.resize(at);
      break;
    case 3:
      bytes.erase(at, length);
      break;
    case 4:
      bytes.insert(at, std::string(length, static_cast<char>(random.next())));
      break;
    case 5:
      bytes.replace(at, length, std::string(length, '\0'));
      break;
    default:
      std::swap_ranges(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                       bytes.begin() + static_cast<std::ptrdiff_t>(at + length / 2),
                       bytes.begin() + static_cast<std::ptrdiff_t>(at + length - length / 2));
  }
  return bytes;
}

TEST_F(ModelFiles, DamagedInTwoThousandWaysGiveTheSamePartsOrNone) {
  const MeshKey key = MeshKey::of(bone_);
  const PreparedParts right = fresh_->parts();
  ASSERT_TRUE(same(decoded(bytes_, key).value(), right));
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    const std::string spoilt = damaged(bytes_, random);
    const auto parts = decoded(spoilt, key);
    if (spoilt != bytes_) {
      EXPECT_FALSE(parts.ok()) << "damage " << seed;
    } else {
      ASSERT_TRUE(parts.ok());
      EXPECT_TRUE(same(*parts, right)) << "damage " << seed;
    }
    refused += parts.ok() ? 0 : 1;
  }
  // Some damages, such as zeros over zeros, leave the file unchanged.
  EXPECT_GT(refused, 1700);
}

TEST_F(ModelFiles, DamagedOnDiskAreMadeAnew) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    Random random(seed);
    const TemporaryFolder folder;
    ModelCache cache(folder.path().string());
    (void)folder.with(name_of_file(bone_), damaged(bytes_, random));
    const auto model = cache.prepared(bone_);
    ASSERT_TRUE(model.ok()) << "damage " << seed;
    EXPECT_TRUE(same(**model, *fresh_)) << "damage " << seed;
  }
}

/// One way of spoiling the parts themselves.
void spoil(PreparedParts& parts, Random& random) {
  const auto any = [&](std::size_t below) { return any_below(below, random); };
  constexpr double kStrange[] = {0.0, -1.0, 1e300, std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()};
  const double strange = kStrange[any(5)];
  switch (any(6)) {
    case 0:
      parts.reachable[any(parts.reachable.size())] = static_cast<std::uint32_t>(random.next());
      break;
    case 1:
      parts.closest_m[any(parts.closest_m.size())].y = strange;
      break;
    case 2:
      parts.distance_m[any(parts.distance_m.size())] = static_cast<float>(strange);
      break;
    case 3:
      parts.distance_m.resize(any(parts.distance_m.size()));
      break;
    case 4:
      parts.closest_m.resize(any(parts.closest_m.size()));
      break;
    default:
      parts.reachable.resize(any(parts.reachable.size()));
  }
}

/// A checksum does not protect against a program that writes nonsense: parts with arbitrary numbers
/// are refused or searched without harm.
TEST_F(ModelFiles, WithWrongNumbersAndARightChecksumNeverCrash) {
  std::vector<Point<World>> strokes;
  for (int i = 0; i < 200; ++i) {
    strokes.push_back({{0.001 * (i % 20), 0.0004 * (i / 20), 0.0002 * (i % 7)}});
  }
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    Random random(seed);
    PreparedParts parts = fresh_->parts();
    spoil(parts, random);
    const auto read = decoded(encoded(MeshKey::of(bone_), parts), MeshKey::of(bone_));
    ASSERT_TRUE(read.ok());
    const auto model = VertebraModel::restore(bone_, *read);
    refused += model.ok() ? 0 : 1;
    if (model.ok() && seed % 10 == 0) {
      (void)nav::search_poses((*model)->search_field(), strokes);
    }
  }
  EXPECT_GT(refused, 60) << "wrong counts and what is not finite";
}

}  // namespace
}  // namespace orthonav::engine::model_cache_test
