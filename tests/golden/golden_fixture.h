#pragma once

#include <gmock/gmock.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/golden/golden_images.h"
#include "tests/render/silent_validation.h"
#include "tests/support/test_device.h"

namespace orthonav::engine {

/// Tests of one golden scene, which the parameter names.
class Golden : public ::testing::TestWithParam<std::string> {
 protected:
  // One painter for all: a device and its shaders take longer than a picture.
  static void SetUpTestSuite() {
    validation_ = std::make_unique<render::SilentValidation>();
    painter_ = std::make_unique<GoldenPainter>(test::test_device(), true, validation_->sink());
    spoiler_ = std::make_unique<GoldenPainter>(test::test_device());
  }
  static void TearDownTestSuite() {
    painter_.reset();
    spoiler_.reset();
    validation_.reset();
  }
  void SetUp() override {
    static const std::vector<GoldenScene> kScenes = golden_scenes();
    for (const GoldenScene& scene : kScenes) {
      if (scene.name == GetParam()) {
        golden_ = scene;
      }
    }
    ASSERT_EQ(golden_.name, GetParam());
  }
  GoldenImages painted(const GoldenScene& scene) { return painted_by(*painter_, scene); }
  /// Without validation: `painted` validates every scene as it should be.
  GoldenImages spoilt(const GoldenScene& scene) { return painted_by(*spoiler_, scene); }
  static GoldenImages painted_by(GoldenPainter& painter, const GoldenScene& scene) {
    Result<GoldenImages> images = painter.paint(scene);
    EXPECT_TRUE(images.ok()) << images.error().message;
    return images.ok() ? std::move(*images) : GoldenImages{};
  }
  /// Labels of one view out of the views side by side.
  LabelImage view_of(const LabelImage& joined, std::size_t view) const {
    LabelImage one{golden_.width_px, golden_.height_px, {}};
    for (int y = 0; y < one.height_px; ++y) {
      const auto begin = joined.labels.begin() + y * joined.width_px +
                         static_cast<std::ptrdiff_t>(view) * one.width_px;
      one.labels.insert(one.labels.end(), begin, begin + one.width_px);
    }
    return one;
  }
  GoldenScene golden_;
  void TearDown() override { EXPECT_THAT(painter_->validation_messages(), ::testing::IsEmpty()); }

  static inline std::unique_ptr<render::SilentValidation> validation_;
  static inline std::unique_ptr<GoldenPainter> painter_;
  static inline std::unique_ptr<GoldenPainter> spoiler_;
};

inline std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const GoldenScene& scene : golden_scenes()) {
    names.push_back(scene.name);
  }
  return names;
}

}  // namespace orthonav::engine
