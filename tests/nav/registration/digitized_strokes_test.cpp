#include "tests/support/digitized_strokes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "engine/case/case_file.h"
#include "nav/registration/registration.h"
#include "tests/support/posterior_landmarks.h"
#include "tests/support/test_data.h"

namespace orthonav::test {
namespace {

/// A ray meets the mesh to rounding; the frame there and back adds some more.
constexpr double kOnBone_m = 0.00005;

StrokeErrorModel without_noise(StrokeVariant variant) {
  StrokeErrorModel m = error_model_of(variant);
  m.white_noise_m = m.correlated_noise_m = 0.0;
  return m;
}

class DigitizedStrokesTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    for (const char* name : {"visible-human", "shape-mean", "morph-a", "morph-b"}) {
      const auto source = engine::load_case(test_data("anatomy/" + std::string(name)).string());
      if (!source) {
        continue;
      }
      for (const engine::CaseLevel& level : source->levels) {
        meshes_.push_back(level.mesh);
      }
    }
    for (const nav::TriangleMesh& mesh : meshes_) {
      surfaces_.push_back(std::make_unique<nav::SurfaceIndex>(mesh));
    }
  }
  static void TearDownTestSuite() { meshes_.clear(), surfaces_.clear(); }
  void SetUp() override {
    if (meshes_.empty()) {
      GTEST_SKIP() << "needs shared/anatomy";
    }
  }
  static DigitizedStrokes strokes(std::size_t level, StrokeVariant variant, std::uint64_t seed,
                                  const StrokeErrorModel& error_model) {
    return digitize_strokes(meshes_[level], variant, seed, error_model).value();
  }
  static DigitizedStrokes strokes(std::size_t level, StrokeVariant variant, std::uint64_t seed) {
    return strokes(level, variant, seed, error_model_of(variant));
  }
  /// Of what was tracked, brought back by the true pose.
  static double distance_m(std::size_t level, const DigitizedStrokes& d,
                           const DigitizedSample& sample) {
    return surfaces_[level]->nearest((d.world_from_vertebra.inverse() * sample.tip).v)->distance_m;
  }
  static inline std::vector<nav::TriangleMesh> meshes_;
  static inline std::vector<std::unique_ptr<nav::SurfaceIndex>> surfaces_;
};

TEST_F(DigitizedStrokesTest, LieOnTheBoneWithoutNoise) {
  for (std::size_t level = 0; level < meshes_.size(); ++level) {
    for (const StrokeVariant variant : kStrokeVariants) {
      const auto d = strokes(level, variant, level, without_noise(variant));
      double worst_m = 0.0;
      for (const DigitizedSample& sample : d.samples) {
        if (!sample.off_bone) {
          worst_m = std::max(worst_m, distance_m(level, d, sample));
        }
      }
      EXPECT_LT(worst_m, kOnBone_m) << "level " << level << " " << name_of(variant);
    }
  }
}

TEST_F(DigitizedStrokesTest, AreOffTheBoneByTheNoise) {
  const auto d = strokes(3, StrokeVariant::kFull, 1);
  double sum_m2 = 0.0;
  for (const DigitizedSample& sample : d.samples) {
    sum_m2 += std::pow(distance_m(3, d, sample), 2);
  }
  // Across the surface only one of three axes counts; near edges a little less.
  EXPECT_NEAR(std::sqrt(sum_m2 / static_cast<double>(d.samples.size())), 0.0003, 0.00003);
}

TEST_F(DigitizedStrokesTest, LetTheTipsBallRestOnTheBone) {
  constexpr double kRadius_m = 0.0015;
  for (const StrokeVariant variant : {StrokeVariant::kFull, StrokeVariant::kSparse}) {
    StrokeErrorModel m = without_noise(variant);
    m.tip_radius_m = kRadius_m;
    const auto d = strokes(3, variant, 5, m);
    for (const DigitizedSample& sample : d.samples) {
      ASSERT_NEAR(distance_m(3, d, sample), kRadius_m, 1e-5);
      ASSERT_FALSE(surfaces_[3]->contains(sample.true_tip.v));
    }
  }
}

TEST_F(DigitizedStrokesTest, HaveAsManySamplesAsTheVariantSays) {
  std::set<std::size_t> partial;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const std::size_t full = strokes(1, StrokeVariant::kFull, seed).samples.size();
    EXPECT_GE(full, 1800U);
    EXPECT_LE(full, 2200U);
    partial.insert(strokes(1, StrokeVariant::kPartial, seed).samples.size());
    EXPECT_EQ(strokes(1, StrokeVariant::kSparse, seed).samples.size(), 300U);
  }
  EXPECT_GE(*partial.begin(), 800U);
  EXPECT_LE(*partial.rbegin(), 1200U);
  EXPECT_GT(partial.size(), 8U);
}

TEST_F(DigitizedStrokesTest, MoveLikeAHandAlongTheBone) {
  for (std::size_t level = 0; level < meshes_.size(); ++level) {
    for (const StrokeVariant variant : {StrokeVariant::kFull, StrokeVariant::kPartial}) {
      const auto d = strokes(level, variant, 3 + level, without_noise(variant));
      std::vector<double> steps_m;
      for (std::size_t i = 1; i < d.samples.size(); ++i) {
        if (d.samples[i].stroke == d.samples[i - 1].stroke) {
          steps_m.push_back((d.samples[i].true_tip - d.samples[i - 1].true_tip).norm());
        }
      }
      std::sort(steps_m.begin(), steps_m.end());
      EXPECT_GT(steps_m[steps_m.size() / 2], 0.0004) << level << " " << name_of(variant);
      EXPECT_LT(steps_m[steps_m.size() / 2], 0.0011) << level << " " << name_of(variant);
      EXPECT_LT(steps_m.back(), 0.003) << level << " " << name_of(variant);
      // Continuous strokes, no scattered dots.
      EXPECT_GT(steps_m.size(), d.samples.size() * 9 / 10);
    }
  }
}

TEST_F(DigitizedStrokesTest, ReachEveryRegionWhenFull) {
  for (std::size_t level = 0; level < meshes_.size(); ++level) {
    std::array<int, kBoneRegions> count{};
    for (const DigitizedSample& s : strokes(level, StrokeVariant::kFull, level).samples) {
      ++count[static_cast<std::size_t>(s.region)];
    }
    for (int r = 0; r < kBoneRegions; ++r) {
      EXPECT_GE(count[static_cast<std::size_t>(r)], 15)
          << "level " << level << ", " << name_of(static_cast<BoneRegion>(r));
    }
  }
}

TEST_F(DigitizedStrokesTest, GoAsDeepAsToldAndThereBeyondWhatTrimmingKeeps) {
  // To prepare a model takes longer than all that is done with it here.
  std::vector<std::shared_ptr<const nav::VertebraModel>> models;
  for (const nav::TriangleMesh& mesh : meshes_) {
    models.push_back(nav::VertebraModel::prepare(mesh).value());
  }
  for (const double deepest : {0.7, 1.1, 1.25}) {
    StrokeErrorModel m = error_model_of(StrokeVariant::kFull);
    m.deepest_aside = deepest;
    double beyond = 0.0;
    double all = 0.0;
    for (std::size_t level = 0; level < meshes_.size(); ++level) {
      const auto marks = find_posterior_landmarks(meshes_[level], *surfaces_[level]).value();
      const double canal_m = marks.arch_front_y_m - marks.body_back_y_m;
      for (const DigitizedSample& s : strokes(level, StrokeVariant::kFull, level, m).samples) {
        all += 1.0;
        beyond += models[level]->reachable_surface().nearest(s.true_tip.v)->distance_m > 0.0005
                      ? 1.0
                      : 0.0;
        const bool aside =
            std::abs(s.true_tip.v.x - marks.midline_x_m) > 1.2 * marks.canal_half_width_m;
        // Into the canal never, however deep the pointer goes beside it.
        ASSERT_LE(marks.arch_front_y_m - s.true_tip.v.y, (aside ? deepest : 0.5) * canal_m + 1e-9);
      }
    }
    EXPECT_LE(beyond / all, deepest < 1.0 ? 0.0005 : (deepest < 1.2 ? 0.02 : 0.06)) << deepest;
    EXPECT_GE(beyond / all, deepest < 1.0 ? 0.0 : (deepest < 1.2 ? 0.001 : 0.01)) << deepest;
  }
}

TEST_F(DigitizedStrokesTest, CoverPartsOfAllKindsOnBothSides) {
  std::set<std::string> words;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    const auto d = strokes(seed % meshes_.size(), StrokeVariant::kPartial, seed);
    words.insert(d.coverage);
    std::set<BoneRegion> regions;
    for (const DigitizedSample& s : d.samples) {
      regions.insert(s.region);
    }
    using R = BoneRegion;
    if (d.coverage == "laminae only") {
      EXPECT_EQ(regions, (std::set<R>{R::kLeftLamina, R::kRightLamina}));
    } else if (d.coverage == "left side and spinous process") {
      EXPECT_FALSE(regions.contains(R::kRightLamina) || regions.contains(R::kRightFacet) ||
                   regions.contains(R::kRightTransverseRoot));
      EXPECT_TRUE(regions.contains(R::kLeftLamina) && regions.contains(R::kCrest));
    } else if (d.coverage == "spinous process and right facet") {
      EXPECT_FALSE(regions.contains(R::kLeftLamina) || regions.contains(R::kLeftFacet) ||
                   regions.contains(R::kRightLamina));
      EXPECT_TRUE(regions.contains(R::kRightFacet) && regions.contains(R::kCrest));
    }
  }
  // Two one-sided ones, the laminae, two lamina, two facet, four thirds.
  EXPECT_EQ(words.size(), 11U);
}

TEST_F(DigitizedStrokesTest, LeaveAThirdOfASideOut) {
  int seen = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto d = strokes(2, StrokeVariant::kPartial, seed);
    if (d.coverage != "left side without its upper third") {
      continue;
    }
    ++seen;
    const auto marks = find_posterior_landmarks(meshes_[2], *surfaces_[2]).value();
    double left_m = -1.0;
    double right_m = -1.0;
    for (const DigitizedSample& s : d.samples) {
      double& highest_m = s.true_tip.v.x > marks.midline_x_m ? left_m : right_m;
      highest_m = std::max(highest_m, s.true_tip.v.z);
    }
    EXPECT_GT(right_m - left_m, 0.008);
  }
  EXPECT_GT(seen, 0);
}

TEST_F(DigitizedStrokesTest, AreFewAndShortWhenSparse) {
  for (std::size_t level = 0; level < meshes_.size(); ++level) {
    std::set<BoneRegion> regions;
    std::set<int> seen;
    for (const DigitizedSample& s : strokes(level, StrokeVariant::kSparse, level).samples) {
      regions.insert(s.region);
      seen.insert(s.stroke);
    }
    EXPECT_GE(seen.size(), 8U);
    EXPECT_LE(seen.size(), 12U);
    EXPECT_GE(regions.size(), 8U) << "level " << level;
  }
}

TEST_F(DigitizedStrokesTest, StandInAnyFrameOfTheWorld) {
  StrokeErrorModel few = without_noise(StrokeVariant::kSparse);
  few.fewest_samples = few.most_samples = 20;
  constexpr int kFrames = 150;
  Vec3 place{};
  Vec3 up{};
  double farthest_m = 0.0;
  for (std::uint64_t seed = 0; seed < kFrames; ++seed) {
    const auto pose = strokes(4, StrokeVariant::kSparse, seed, few).world_from_vertebra;
    EXPECT_NEAR(pose.rotation().determinant(), 1.0, 1e-12);
    farthest_m = std::max(farthest_m, pose.translation().norm());
    place += pose.translation() / kFrames;
    up += pose.rotation().column(2) / kFrames;
  }
  EXPECT_LE(farthest_m, 1.0);
  EXPECT_GT(farthest_m, 0.9);
  // Means of 150 such vectors have a norm of about 0.06 and 0.08; four times that is chance no
  // more.
  EXPECT_LT(place.norm(), 0.25);
  EXPECT_LT(up.norm(), 0.32);
}

TEST_F(DigitizedStrokesTest, AreTheSameForTheSameSeed) {
  const auto a = strokes(4, StrokeVariant::kOutliers, 8);
  const auto b = strokes(4, StrokeVariant::kOutliers, 8);
  const auto c = strokes(4, StrokeVariant::kOutliers, 9);
  EXPECT_EQ(a.world_from_vertebra, b.world_from_vertebra);
  EXPECT_EQ(a.tips(), b.tips());
  EXPECT_FALSE(a.world_from_vertebra == c.world_from_vertebra);
  // The frame and the hand don't know of the noise.
  const auto quiet =
      strokes(4, StrokeVariant::kOutliers, 8, without_noise(StrokeVariant::kOutliers));
  EXPECT_EQ(a.world_from_vertebra, quiet.world_from_vertebra);
  ASSERT_EQ(a.samples.size(), quiet.samples.size());
  EXPECT_EQ(a.samples[700].true_tip, quiet.samples[700].true_tip);
  EXPECT_FALSE(a.samples[700].tip == quiet.samples[700].tip);
}

TEST(DigitizedStrokes, RefusesWhatHasNoCanal) {
  nav::TriangleMesh box;
  for (int i = 0; i < 8; ++i) {
    box.vertices_m.push_back({(i & 1) * 0.08, (i & 2) * 0.04, (i & 4) * 0.01});
  }
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  EXPECT_FALSE(digitize_strokes(box, StrokeVariant::kFull, 1).ok());
}

}  // namespace
}  // namespace orthonav::test
