#include "engine/case/model_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>

#include "base/random.h"
#include "engine/phantom/phantom.h"
#include "nav/registration/pose_search.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::model_cache_test {
namespace {

namespace fs = std::filesystem;
using nav::PreparedParts;
using nav::TriangleMesh;
using nav::VertebraModel;
using test::content_of;
using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// The smallest bone there may be, with no two sides alike: its file has half a megabyte.
TriangleMesh small_bone() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices_m.push_back({(i & 1) != 0 ? 0.021 : -0.018, (i & 2) != 0 ? 0.017 : -0.015,
                               (i & 4) != 0 ? 0.012 : -0.02});
  }
  mesh.vertices_m[7] = {0.019, 0.020, 0.010};
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

bool same(const PreparedParts& a, const PreparedParts& b) {
  return a.reachable == b.reachable && a.closest_m == b.closest_m && a.distance_m == b.distance_m;
}

bool same(const VertebraModel& a, const VertebraModel& b) {
  return same(a.parts(), b.parts()) && a.mesh().vertices_m == b.mesh().vertices_m &&
         a.reachable().vertices_m == b.reachable().vertices_m &&
         a.reachable().triangles == b.reachable().triangles &&
         a.reachable_extremes() == b.reachable_extremes() &&
         a.search_field().cells().cost == b.search_field().cells().cost;
}

/// CRC-32 by its definition (ISO 3309), bit by bit, to compare with the file's.
std::uint32_t crc32_by_hand(std::string_view bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> 1u) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
  }
  return ~crc;
}

/// The same bytes with another number in the header and a corrected checksum.
template <class T>
std::string with_number(std::string bytes, std::size_t at, T number) {
  std::memcpy(bytes.data() + at, &number, sizeof number);
  const std::uint32_t crc =
      crc32_by_hand(std::string_view(bytes).substr(0, bytes.size() - sizeof(std::uint32_t)));
  std::memcpy(bytes.data() + bytes.size() - sizeof crc, &crc, sizeof crc);
  return bytes;
}

class ModelFiles : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    fresh_ = VertebraModel::prepare(small_bone()).value();
    bytes_ = encoded(MeshKey::of(small_bone()), fresh_->parts());
  }
  static void TearDownTestSuite() { fresh_.reset(), bytes_.clear(); }

  /// With `content` in place of the file, expects a fresh model, a note that says `why`, and a
  /// correct file the next time.
  void expect_made_anew(const std::string& content, const std::string& why) {
    SCOPED_TRACE(why);
    const TemporaryFolder folder;
    ModelCache cache(folder.path().string());
    const std::string path = folder.with(fs::path(cache.file_of(bone_)).filename(), content);
    const auto model = cache.prepared(bone_);
    ASSERT_TRUE(model.ok()) << model.error().message;
    EXPECT_TRUE(same(**model, *fresh_));
    EXPECT_EQ(cache.loaded(), 0);
    ASSERT_THAT(cache.notes(), SizeIs(1));
    EXPECT_THAT(cache.notes()[0], HasSubstr(why));
    EXPECT_THAT(cache.notes()[0], HasSubstr(path));
    cache.keep();
    EXPECT_THAT(cache.notes(), SizeIs(1)) << "written without complaint";
    EXPECT_TRUE(content_of(path) == bytes_);
  }

  const TriangleMesh bone_ = small_bone();
  static inline std::shared_ptr<const VertebraModel> fresh_;
  static inline std::string bytes_;
};

TEST_F(ModelFiles, GiveTheSameModelToTheBitTheSecondTime) {
  const TemporaryFolder folder;
  const std::string models = folder.file("deeper/models");
  ModelCache first(models);
  const auto made = first.prepared(bone_);
  ASSERT_TRUE(made.ok());
  EXPECT_FALSE(fs::exists(models)) << "nothing is written before it is told to keep it";
  first.keep();
  EXPECT_EQ(first.made(), 1);
  EXPECT_EQ(first.loaded(), 0);
  EXPECT_TRUE(fs::exists(first.file_of(bone_)));

  ModelCache second(models);
  const auto loaded = second.prepared(bone_);
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(second.loaded(), 1);
  EXPECT_EQ(second.made(), 0);
  EXPECT_THAT(second.notes(), IsEmpty());
  EXPECT_TRUE(same(**loaded, **made));
  EXPECT_TRUE(same(**loaded, *fresh_));
  const auto time = fs::last_write_time(second.file_of(bone_));
  second.keep();
  EXPECT_EQ(fs::last_write_time(second.file_of(bone_)), time) << "what was loaded stays as it is";
}

TEST_F(ModelFiles, AreNotMadeWithoutAFolder) {
  ModelCache cache;
  ASSERT_TRUE(cache.prepared(bone_).ok());
  cache.keep();
  EXPECT_THAT(cache.notes(), IsEmpty());
  EXPECT_EQ(cache.made(), 1);
}

TEST_F(ModelFiles, AreOfOneMeshEach) {
  const TemporaryFolder folder;
  ModelCache cache(folder.path().string());
  TriangleMesh moved = bone_;
  moved.vertices_m[3].x += 1e-12;  // any digit counts
  TriangleMesh rotated = bone_;
  std::swap(rotated.triangles[0], rotated.triangles[1]);
  EXPECT_NE(cache.file_of(bone_), cache.file_of(moved));
  EXPECT_NE(cache.file_of(bone_), cache.file_of(rotated));
}

TEST_F(ModelFiles, RefuseAMeshThatIsNoVertebraAsPreparingDoes) {
  const TemporaryFolder folder;
  ModelCache cache(folder.path().string());
  TriangleMesh open = bone_;
  open.triangles.pop_back();
  const auto model = cache.prepared(open);
  ASSERT_FALSE(model.ok());
  EXPECT_EQ(model.error().message, VertebraModel::prepare(open).error().message);
  cache.keep();
  EXPECT_EQ(folder.count(), 0u);
}

TEST_F(ModelFiles, AreMadeAnewWhenTheyAreNotWhatTheyShouldBe) {
  expect_made_anew("", "damaged");
  expect_made_anew("ORTHONAV-MODEL\r\n", "damaged");
  expect_made_anew(bytes_.substr(0, 75), "damaged");
  expect_made_anew(bytes_.substr(0, bytes_.size() / 2), "not as long");
  expect_made_anew(bytes_.substr(0, bytes_.size() - 1), "not as long");
  expect_made_anew(bytes_ + '\0', "not as long");
  expect_made_anew(std::string(bytes_.size(), 'x'), "no prepared model");
  std::string flipped = bytes_;
  flipped[flipped.size() / 3] = static_cast<char>(flipped[flipped.size() / 3] ^ 1);
  expect_made_anew(flipped, "checksum");
  expect_made_anew(with_number<std::uint32_t>(bytes_, 16, 2), "of version 2.");
  expect_made_anew(with_number<std::uint32_t>(bytes_, 20, nav::kPreparationVersion + 1), "version");
  expect_made_anew(with_number<std::uint32_t>(bytes_, 20, nav::kPreparationVersion - 1), "version");
  expect_made_anew(with_number<std::uint32_t>(bytes_, 24, 0), "another mesh");
}

TEST_F(ModelFiles, AreNotBelievedTheirSizes) {
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  for (const std::size_t at : {48, 56, 64}) {
    for (const std::uint64_t count :
         {kMost, kMost / 4 + 1, kMost / 24 + 1, std::uint64_t{1} << 40u}) {
      expect_made_anew(with_number(bytes_, at, count), "not as long");
    }
  }
}

TEST_F(ModelFiles, OfAnotherMeshUnderThisNameAreMadeAnew) {
  TriangleMesh other = bone_;
  other.vertices_m[7].y += 0.0005;
  const auto parts = VertebraModel::prepare(other).value()->parts();
  expect_made_anew(encoded(MeshKey::of(other), parts), "another mesh");
  // Even if the checksums of both meshes were equal, the samples would differ.
  expect_made_anew(encoded(MeshKey::of(bone_), parts), "does not fit its mesh");
}

TEST_F(ModelFiles, AreNotConfusedByWhatIsNoFile) {
  const TemporaryFolder folder;
  ModelCache cache(folder.path().string());
  fs::create_directory(cache.file_of(bone_));
  const auto model = cache.prepared(bone_);
  ASSERT_TRUE(model.ok());
  EXPECT_TRUE(same(**model, *fresh_));
  cache.keep();
  ASSERT_THAT(cache.notes(), SizeIs(2));
  EXPECT_THAT(cache.notes()[1], HasSubstr("is not kept"));

  fs::remove(cache.file_of(bone_));
  ASSERT_EQ(mkfifo(cache.file_of(bone_).c_str(), 0600), 0);
  ModelCache again(folder.path().string());
  ASSERT_TRUE(again.prepared(bone_).ok()) << "a pipe would be waited for";
  EXPECT_THAT(again.notes(), SizeIs(1));
}

TEST_F(ModelFiles, ThatCannotBeWrittenAreANoteAndNoMore) {
  const TemporaryFolder folder;
  ModelCache cache(folder.with("taken", "a file") + "/models");
  ASSERT_TRUE(cache.prepared(bone_).ok());
  cache.keep();
  ASSERT_THAT(cache.notes(), ::testing::Not(IsEmpty()));
  EXPECT_THAT(cache.notes().back(), HasSubstr("is not kept"));
  EXPECT_EQ(content_of(folder.file("taken")), "a file");
}

/// One way of spoiling a file; the seed says which and where.
std::string damaged(std::string bytes, Random& random) {
  const auto any = [&](std::size_t below) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(below));
  };
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
    (void)folder.with(fs::path(cache.file_of(bone_)).filename(), damaged(bytes_, random));
    const auto model = cache.prepared(bone_);
    ASSERT_TRUE(model.ok()) << "damage " << seed;
    EXPECT_TRUE(same(**model, *fresh_)) << "damage " << seed;
  }
}

/// A checksum does not protect against a program that writes nonsense: parts with arbitrary numbers
/// are refused or searched without harm.
TEST_F(ModelFiles, WithWrongNumbersAndARightChecksumNeverCrash) {
  std::vector<Vec3> strokes;
  for (int i = 0; i < 200; ++i) {
    strokes.push_back({0.001 * (i % 20), 0.0004 * (i / 20), 0.0002 * (i % 7)});
  }
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    Random random(seed);
    PreparedParts parts = fresh_->parts();
    const auto any = [&](std::size_t below) {
      return static_cast<std::size_t>(random.uniform() * static_cast<double>(below));
    };
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

/// A summary of the prepared data of a known bone. When this fails, the same mesh is prepared
/// differently than before: raise nav::kPreparationVersion, so that earlier files are not used, and
/// put the new figures here.
TEST(PreparationVersion, IsRaisedWithEveryChangeOfThePreparation) {
  const auto model = VertebraModel::prepare(phantom({"L4"}).levels.at(0).mesh).value();
  const PreparedParts parts = model->parts();
  double faces = 0.0;
  double closest_m = 0.0;
  double distance_m = 0.0;
  for (std::size_t i = 0; i < parts.reachable.size(); ++i) {
    faces += parts.reachable[i];
  }
  for (const Vec3& p : parts.closest_m) {
    closest_m += p.norm();
  }
  for (const float d : parts.distance_m) {
    distance_m += static_cast<double>(d);
  }
  EXPECT_EQ(nav::kPreparationVersion, 1u);
  EXPECT_EQ(parts.reachable.size(), 9675u);
  EXPECT_EQ(parts.closest_m.size(), 35588u);
  EXPECT_EQ(parts.distance_m.size(), 84952u);
  // The same to the bit with every compiler so far; this tolerance allows for other libraries'
  // sines.
  constexpr double kRelative = 1e-9;
  EXPECT_NEAR(faces, 79674415.0, kRelative * faces);
  EXPECT_NEAR(closest_m, 1696.4018681262553, kRelative * closest_m);
  EXPECT_NEAR(distance_m, 1683.2944238461989, kRelative * distance_m);
}

}  // namespace
}  // namespace orthonav::engine::model_cache_test
