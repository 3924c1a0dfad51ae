#include "engine/case/model_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include "tests/engine/case/model_files.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::model_cache_test {
namespace {

namespace fs = std::filesystem;
using nav::TriangleMesh;
using nav::VertebraModel;
using test::content_of;
using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

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
  const fs::path file = fs::path(models) / name_of_file(bone_);
  EXPECT_TRUE(fs::exists(file));

  ModelCache second(models);
  const auto loaded = second.prepared(bone_);
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(second.loaded(), 1);
  EXPECT_EQ(second.made(), 0);
  EXPECT_THAT(second.notes(), IsEmpty());
  EXPECT_TRUE(same(**loaded, **made));
  EXPECT_TRUE(same(**loaded, *fresh_));
  const auto time = fs::last_write_time(file);
  second.keep();
  EXPECT_EQ(fs::last_write_time(file), time) << "what was loaded stays as it is";
}

TEST_F(ModelFiles, AreNotMadeWithoutAFolder) {
  ModelCache cache;
  ASSERT_TRUE(cache.prepared(bone_).ok());
  cache.keep();
  EXPECT_THAT(cache.notes(), IsEmpty());
  EXPECT_EQ(cache.made(), 1);
}

TEST_F(ModelFiles, AreOfOneMeshEach) {
  TriangleMesh moved = bone_;
  moved.vertices_m[3].x += 1e-12;  // any digit counts
  TriangleMesh rotated = bone_;
  std::swap(rotated.triangles[0], rotated.triangles[1]);
  EXPECT_NE(name_of_file(bone_), name_of_file(moved));
  EXPECT_NE(name_of_file(bone_), name_of_file(rotated));
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
  expect_made_anew(std::string(bytes_.size(), 'x'), "not a prepared model");
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
  const std::string file = folder.file(name_of_file(bone_));
  fs::create_directory(file);
  const auto model = cache.prepared(bone_);
  ASSERT_TRUE(model.ok());
  EXPECT_TRUE(same(**model, *fresh_));
  cache.keep();
  ASSERT_THAT(cache.notes(), SizeIs(2));
  EXPECT_THAT(cache.notes()[1], HasSubstr("is not kept"));

  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
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

}  // namespace
}  // namespace orthonav::engine::model_cache_test
