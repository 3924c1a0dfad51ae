#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hal/openxr/pinch.h"
#include "hal/openxr/placement.h"
#include "hal/openxr/view_setup.h"
#include "hal/openxr/xr_error.h"
#include "hal/openxr/xr_values.h"

namespace orthonav::openxr {
namespace {

using ::testing::HasSubstr;

constexpr double kSingle = 1e-6;  // what a float leaves of a metre

TEST(XrPose, BecomesTheTransformOfTheSameRotation) {
  const double half_rad = 0.35;
  XrPosef pose = {};
  pose.orientation = {0, static_cast<float>(std::sin(half_rad)), 0,
                      static_cast<float>(std::cos(half_rad))};
  pose.position = {1, 2, 3};
  const auto made = transform_of<Space, Viewer>(pose);
  ASSERT_TRUE(made.ok());
  // About +y, x turns towards -z.
  const Vec3 x = (*made * Direction<Viewer>{{1, 0, 0}}).v;
  EXPECT_NEAR(x.x, std::cos(2 * half_rad), kSingle);
  EXPECT_NEAR(x.y, 0, kSingle);
  EXPECT_NEAR(x.z, -std::sin(2 * half_rad), kSingle);
  EXPECT_NEAR(made->translation().z, 3, kSingle);
}

TEST(XrPose, IsRefusedWithoutARotation) {
  XrPosef zero = {};
  EXPECT_FALSE((transform_of<Space, Viewer>(zero).ok()));
  zero.orientation = {0, 0, 0, 1.1f};
  EXPECT_FALSE((transform_of<Space, Viewer>(zero).ok()));
  zero.orientation = {0, 0, 0, 1.005f};
  EXPECT_TRUE((transform_of<Space, Viewer>(zero).ok()));
  zero.position.x = std::nanf("");
  EXPECT_FALSE((transform_of<Space, Viewer>(zero).ok()));
}

TEST(XrFov, BecomesTangents) {
  EyeView view;
  ASSERT_TRUE(take_fov({-0.5f, 0.4f, 0.3f, -0.2f}, view).ok());
  EXPECT_NEAR(view.tan_left, std::tan(0.5), kSingle);
  EXPECT_NEAR(view.tan_right, std::tan(0.4), kSingle);
  EXPECT_NEAR(view.tan_up, std::tan(0.3), kSingle);
  EXPECT_NEAR(view.tan_down, std::tan(0.2), kSingle);
  EXPECT_FALSE(take_fov({0.4f, 0.4f, 0.3f, -0.2f}, view).ok());
  EXPECT_FALSE(take_fov({-0.5f, 0.4f, 1.6f, -0.2f}, view).ok());
}

TEST(BestBlend, SeesTheMostOfTheWorld) {
  const auto best = [](std::vector<XrEnvironmentBlendMode> modes) { return best_blend(modes); };
  EXPECT_EQ(best({XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ADDITIVE}),
            XR_ENVIRONMENT_BLEND_MODE_ADDITIVE);
  EXPECT_EQ(best({XR_ENVIRONMENT_BLEND_MODE_OPAQUE, XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND}),
            XR_ENVIRONMENT_BLEND_MODE_ALPHA_BLEND);
  EXPECT_EQ(best({XR_ENVIRONMENT_BLEND_MODE_OPAQUE}), XR_ENVIRONMENT_BLEND_MODE_OPAQUE);
  EXPECT_FALSE(best({}).has_value());
}

TEST(BestSpace, IsTheOneThatWearersMoveLeast) {
  const auto best = [](std::vector<XrReferenceSpaceType> types) { return best_space(types); };
  EXPECT_EQ(best({XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL,
                  XR_REFERENCE_SPACE_TYPE_STAGE}),
            XR_REFERENCE_SPACE_TYPE_STAGE);
  const auto local_floor = static_cast<XrReferenceSpaceType>(1000426000);
  EXPECT_EQ(best({XR_REFERENCE_SPACE_TYPE_LOCAL, local_floor}), local_floor);
  EXPECT_EQ(best({XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL}),
            XR_REFERENCE_SPACE_TYPE_LOCAL);
}

TEST(ViewSize, IsWhatBothEyesCanHave) {
  std::vector<XrViewConfigurationView> views(2, {XR_TYPE_VIEW_CONFIGURATION_VIEW});
  views[0].recommendedImageRectWidth = 1440;
  views[0].recommendedImageRectHeight = 936;
  views[0].maxImageRectWidth = views[0].maxImageRectHeight = 4096;
  views[1] = views[0];
  views[1].recommendedImageRectWidth = 1600;
  views[1].maxImageRectHeight = 900;
  const ViewSetup setup = sized(views);
  EXPECT_EQ(setup.width_px, 1600);
  EXPECT_EQ(setup.height_px, 900);
}

TEST(XrErrors, HaveNamesAndNumbersWhereThereIsNone) {
  EXPECT_EQ(error_of("do it", XR_ERROR_SESSION_LOST).message,
            "openxr: do it: XR_ERROR_SESSION_LOST");
  EXPECT_EQ(name_of(static_cast<XrResult>(-123456)), "XrResult -123456");
}

TEST(Pinch, NeedsAnOpenHandFirstAndTwoSightings) {
  Pinch pinch;
  EXPECT_FALSE(pinch.take(1.0f));
  EXPECT_FALSE(pinch.take(1.0f)) << "came closed";
  EXPECT_FALSE(pinch.take(0.2f));
  EXPECT_FALSE(pinch.take(0.9f)) << "once is a glitch";
  EXPECT_FALSE(pinch.take(0.7f));
  EXPECT_FALSE(pinch.take(0.9f));
  EXPECT_TRUE(pinch.take(0.9f));
  EXPECT_TRUE(pinch.take(0.6f)) << "between the two limits it stays";
  EXPECT_FALSE(pinch.take(0.5f));
  EXPECT_FALSE(pinch.take(0.85f));
  EXPECT_TRUE(pinch.take(0.85f));
  EXPECT_FALSE(pinch.take(std::nullopt));
  EXPECT_FALSE(pinch.take(0.9f));
  EXPECT_FALSE(pinch.take(0.9f));
}

TEST(Pinch, ClosesWhereTheTipsTouch) {
  EXPECT_FLOAT_EQ(closed_at(0.0f), 1.0f);
  EXPECT_FLOAT_EQ(closed_at(0.1f), 0.0f);
  EXPECT_GE(closed_at(0.016f), Pinch::kCloses);
  EXPECT_LT(closed_at(0.018f), Pinch::kCloses);
  EXPECT_GT(closed_at(0.028f), Pinch::kOpens);
  EXPECT_LE(closed_at(0.029f), Pinch::kOpens);
}

const Transform<World, Viewer> kBegin = {rotation_from_vector({0, 0.5, 0}), {1, 0, 2}};
const Transform<Space, Viewer> kViewer = {rotation_from_vector({0, -0.2, 0}), {0, 1.6, 0}};
const Transform<Space, Space> kMoved = {Mat3::identity(), {0.3, 0, 0.1}};

TEST(WorldAnchor, LaysWorldsElsewhereSoThatTheWearerBeginsThere) {
  WorldAnchor anchor(Placement::kElsewhere);
  EXPECT_FALSE(anchor.world_from_space(5).has_value());
  anchor.lay(5, kBegin, kViewer);
  const Vec3 off = (*anchor.world_from_space(5) * kViewer).translation() - kBegin.translation();
  EXPECT_LT(off.norm(), 1e-12);
  // Placed once: the wearer is then free to walk.
  anchor.lay(6, kBegin, Transform<Space, Viewer>());
  EXPECT_EQ(*anchor.world_from_space(6), *anchor.world_from_space(5));
}

TEST(WorldAnchor, CountsMovesFromTheirTimeOn) {
  WorldAnchor anchor(Placement::kMounted);
  anchor.move(100, kMoved);
  EXPECT_EQ(anchor.epoch(99), 0);
  EXPECT_EQ(anchor.epoch(100), 1);
  anchor.move(200, std::nullopt);
  EXPECT_EQ(anchor.epoch(150), 1);
  EXPECT_EQ(anchor.epoch(1000), 2);
  for (int i = 0; i < 50; ++i) {
    anchor.move(1000 + i, std::nullopt);
  }
  EXPECT_EQ(anchor.epoch(2000), 52);
}

TEST(WorldAnchor, OfMountedCamerasIsTheSpaceItself) {
  WorldAnchor anchor(Placement::kMounted);
  anchor.move(100, kMoved);
  const Transform<World, Space> same;
  EXPECT_EQ(*anchor.world_from_space(99), same);
  EXPECT_EQ(*anchor.world_from_space(100), same);
}

TEST(WorldAnchor, KeepsTheWearersPlaceWhereAMoveIsKnown) {
  WorldAnchor anchor(Placement::kElsewhere);
  anchor.lay(5, kBegin, kViewer);
  anchor.move(100, kMoved);
  const auto viewer_in_new = kMoved.inverse() * kViewer;
  const Vec3 off =
      (*anchor.world_from_space(100) * viewer_in_new).translation() - kBegin.translation();
  EXPECT_LT(off.norm(), 1e-12);
  anchor.move(200, std::nullopt);
  EXPECT_FALSE(anchor.world_from_space(200).has_value());
  EXPECT_TRUE(anchor.world_from_space(199).has_value());
}

}  // namespace
}  // namespace orthonav::openxr
