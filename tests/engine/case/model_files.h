#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "engine/case/model_cache.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::engine::model_cache_test {

/// The smallest bone there may be, with no two sides alike: its file has half a megabyte.
inline nav::TriangleMesh small_bone() {
  nav::TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices_m.push_back({(i & 1) != 0 ? 0.021 : -0.018, (i & 2) != 0 ? 0.017 : -0.015,
                               (i & 4) != 0 ? 0.012 : -0.02});
  }
  mesh.vertices_m[7] = {0.019, 0.020, 0.010};
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline std::string name_of_file(const nav::TriangleMesh& mesh) {
  return MeshKey::of(mesh).text() + ".model";
}

/// To the bit.
inline bool same(const nav::PreparedParts& a, const nav::PreparedParts& b) {
  return a.reachable == b.reachable && a.closest_m == b.closest_m && a.distance_m == b.distance_m;
}

inline bool same(const nav::VertebraModel& a, const nav::VertebraModel& b) {
  return same(a.parts(), b.parts()) && a.mesh().vertices_m == b.mesh().vertices_m &&
         a.reachable().vertices_m == b.reachable().vertices_m &&
         a.reachable().triangles == b.reachable().triangles &&
         a.search_field().cells().cost == b.search_field().cells().cost;
}

/// A bone that was prepared without any file, and what its file holds.
class ModelFiles : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    fresh_ = nav::VertebraModel::prepare(small_bone()).value();
    bytes_ = encoded(MeshKey::of(small_bone()), fresh_->parts());
  }
  static void TearDownTestSuite() { fresh_.reset(), bytes_.clear(); }

  /// With `content` in place of the file, expects a fresh model, a note that says `why`, and a
  /// correct file the next time.
  void expect_made_anew(const std::string& content, const std::string& why) {
    SCOPED_TRACE(why);
    const test::TemporaryFolder folder;
    ModelCache cache(folder.path().string());
    const std::string path = folder.with(name_of_file(bone_), content);
    const auto model = cache.prepared(bone_);
    ASSERT_TRUE(model.ok()) << model.error().message;
    EXPECT_TRUE(same(**model, *fresh_));
    EXPECT_EQ(cache.loaded(), 0);
    ASSERT_THAT(cache.notes(), ::testing::SizeIs(1));
    EXPECT_THAT(cache.notes()[0], ::testing::HasSubstr(why));
    EXPECT_THAT(cache.notes()[0], ::testing::HasSubstr(path));
    cache.keep();
    EXPECT_THAT(cache.notes(), ::testing::SizeIs(1)) << "written without complaint";
    EXPECT_TRUE(test::content_of(path) == bytes_);
  }

  const nav::TriangleMesh bone_ = small_bone();
  static inline std::shared_ptr<const nav::VertebraModel> fresh_;
  static inline std::string bytes_;
};

}  // namespace orthonav::engine::model_cache_test
