#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/allocation_count.h"
#include "tests/support/camera_scene.h"
#include "tests/support/tag_detection.h"

namespace orthonav::sim {
namespace {

const StereoCalibration& calibration() {
  static const StereoCalibration both = hololens2_calibration();
  return both;
}

GreyImage left(RoomRenderer& renderer, const RoomState& state, std::uint64_t seed = 1) {
  GreyImage image;
  renderer.render(std::vector<RoomState>{state}, calibration().left, calibration().left_from_rig,
                  seed, image);
  return image;
}

PinholeView view_of(const RoomState& state) {
  return {{state.room_from_rig.rotation(), state.room_from_rig.translation()},
          0.42,
          0.42,
          0.236,
          0.236};
}

TEST(RoomRenderer, SeesEveryToolFromBothCameras) {
  const RoomDescription room = scene::operating_room(16);
  RoomState state = scene::operating_state(room);
  state.hand.reset();
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  GreyImage right;
  renderer->render(std::vector<RoomState>{state}, calibration().right,
                   scene::as_camera(calibration().right_from_rig), 2, right);
  for (const GreyImage& image : {left(*renderer, state), right}) {
    const auto found = scene::detect(image);
    EXPECT_EQ(found.size(), 3u);
    for (const int id : {3, 5, 17}) {
      EXPECT_TRUE(found.contains(id)) << id;
    }
  }
}

TEST(RoomRenderer, SameArgumentsGiveTheSameBytesInAnyOrder) {
  const RoomDescription room = scene::operating_room(16);
  const RoomState first = scene::operating_state(room);
  RoomState second = first;
  second.room_from_marker[0] = {second.room_from_marker[0].rotation(),
                                second.room_from_marker[0].translation() + Vec3{0.02, 0.01, 0}};
  second.hand.reset();
  const auto a = RoomRenderer::create(room, ErrorModel{});
  const auto b = RoomRenderer::create(room, ErrorModel{});
  const GreyImage first_a = left(*a, first, 11);
  const GreyImage second_a = left(*a, second, 12);
  RgbaImage picture;
  b->picture(first, view_of(first), picture);
  EXPECT_EQ(left(*b, second, 12), second_a);
  EXPECT_EQ(left(*b, first, 11), first_a);
  EXPECT_EQ(left(*a, first, 11), first_a);
  EXPECT_NE(first_a, second_a);
}

TEST(RoomRenderer, TheHandCoversWhatIsBehindIt) {
  const RoomDescription room = scene::operating_room(8);
  RoomState state = scene::operating_state(room);
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  const Vec3 eye = state.room_from_rig.translation();
  const Vec3 tag = state.room_from_marker[0].translation();
  const Vec3 towards_eye = (eye - tag).normalized();
  state.hand_axis = (state.room_from_rig * Direction<Rig>{{0, 1, 0}}).v;
  state.hand = Point<Room>{tag + 0.08 * towards_eye};
  EXPECT_FALSE(scene::detect(left(*renderer, state)).contains(3));
  state.hand = Point<Room>{tag - 0.08 * towards_eye};
  EXPECT_TRUE(scene::detect(left(*renderer, state)).contains(3));
}

TEST(RoomRenderer, ANearTagCoversAFarOne) {
  const RoomDescription room = scene::operating_room(8);
  RoomState state = scene::operating_state(room);
  state.hand.reset();
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  const Vec3 eye = state.room_from_rig.translation();
  // The guide's plate (id 5) slides in front of the pointer's (id 3), then behind it.
  const auto pointer = state.room_from_marker[0];
  const Vec3 towards_eye = (eye - pointer.translation()).normalized();
  state.room_from_marker[1] = {pointer.rotation(), pointer.translation() + 0.05 * towards_eye};
  auto found = scene::detect(left(*renderer, state));
  EXPECT_TRUE(found.contains(5));
  EXPECT_FALSE(found.contains(3));
  state.room_from_marker[1] = {pointer.rotation(), pointer.translation() - 0.05 * towards_eye};
  found = scene::detect(left(*renderer, state));
  EXPECT_TRUE(found.contains(3));
  EXPECT_FALSE(found.contains(5));
}

TEST(RoomRenderer, BonesShowInTheWoundOnly) {
  const RoomDescription room = scene::operating_room(24);
  RoomDescription boneless = room;
  for (RoomLevel& level : boneless.levels) {
    level.triangles.clear();
  }
  RoomState state = scene::operating_state(room);
  state.tool_present.assign(3, false);
  state.hand.reset();
  const ErrorModel perfect = ErrorModel::perfect();
  const GreyImage with = left(*RoomRenderer::create(room, perfect), state);
  const GreyImage without = left(*RoomRenderer::create(boneless, perfect), state);
  const auto camera_from_spine =
      calibration().left_from_rig * state.room_from_rig.inverse() * state.room_from_spine;
  int differing = 0;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      differing += with.at(x, y) != without.at(x, y) ? 1 : 0;
    }
  }
  EXPECT_GT(differing, 300);
  EXPECT_LT(differing, 20000);
  const auto grey_at = [&](const GreyImage& image, Vec3 in_spine) {
    const Vec2 p = *calibration().left.project((camera_from_spine * Point<Spine>{in_spine}).v);
    return static_cast<int>(image.at(static_cast<int>(p.x), static_cast<int>(p.y)));
  };
  const Vec3 operated_tip{0.0, 0.067, -0.004};  // L3's spinous process
  const Vec3 covered_tip{0.0, 0.067, 0.066};    // L1's lies under drape
  EXPECT_GT(grey_at(with, operated_tip), grey_at(without, operated_tip) + 20);
  EXPECT_EQ(grey_at(with, covered_tip), grey_at(without, covered_tip));
}

TEST(RoomRenderer, AnEmptyRoomIsATable) {
  const auto renderer = RoomRenderer::create({}, ErrorModel::perfect());
  RoomState state;
  state.room_from_rig = scene::looking({0.3, 0.6, 0.0}, {0.0, 0.0, 0.0});
  const GreyImage image = left(*renderer, state);
  ASSERT_EQ(image.pixels.size(), 640u * 480u);
  for (const auto& [x, y] : {std::pair{5, 5}, {320, 240}, {600, 400}}) {
    EXPECT_GT(image.at(x, y), 40);
    EXPECT_LT(image.at(x, y), 140);
  }
  EXPECT_TRUE(scene::detect(image).empty());
  RgbaImage picture;
  renderer->picture(state, view_of(state), picture);
  EXPECT_EQ(picture.pixels.size(), 4u * 960u * 540u);
}

TEST(RoomRenderer, NoStatesGiveABlackImage) {
  const auto renderer = RoomRenderer::create({}, ErrorModel{});
  GreyImage image;
  renderer->render({}, calibration().left, calibration().left_from_rig, 1, image);
  EXPECT_EQ(image, GreyImage(640, 480));
}

TEST(RoomRenderer, UnknownTagsAreBlankPlates) {
  RoomDescription room = scene::operating_room(8);
  room.tools[0].family = "tag99h1";
  room.tools[1].id = 100000;
  RoomState state = scene::operating_state(room);
  state.hand.reset();
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  const auto found = scene::detect(left(*renderer, state));
  EXPECT_EQ(found.size(), 1u);
  EXPECT_TRUE(found.contains(17));
}

TEST(RoomRenderer, PixelsWithoutADirectionStayBlack) {
  std::vector<Vec2> table(calibration().left.lookup().begin(), calibration().left.lookup().end());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (i % 640 < 100) {
      table[i] = {nan, nan};
    }
  }
  const CameraModel blind = CameraModel::from_lookup(640, 480, table).value();
  const RoomDescription room = scene::operating_room(8);
  GreyImage image;
  RoomRenderer::create(room, ErrorModel::perfect())
      ->render(std::vector<RoomState>{scene::operating_state(room)}, blind,
               calibration().left_from_rig, 1, image);
  EXPECT_EQ(image.at(20, 20), 0);
  EXPECT_GT(image.at(200, 20), 0);
}

TEST(RoomRenderer, NothingIsAllocatedAfterTheFirstFrame) {
  const RoomDescription room = scene::operating_room(16);
  RoomState state = scene::operating_state(room);
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  const auto right_from_rig = scene::as_camera(calibration().right_from_rig);
  std::vector<RoomState> states = scene::exposure(state, {0.001, 0, 0});
  GreyImage image;
  RgbaImage picture;
  const auto frame = [&](std::uint64_t seed) {
    renderer->render(states, calibration().left, calibration().left_from_rig, seed, image);
    renderer->render(states, calibration().right, right_from_rig, seed, image);
    renderer->picture(states[1], view_of(state), picture);
  };
  frame(1);
  const std::size_t before = test::allocation_count();
  for (std::uint64_t i = 2; i < 12; ++i) {
    for (RoomState& moment : states) {  // closer and closer: everything grows on the image
      moment.room_from_rig = {moment.room_from_rig.rotation(),
                              moment.room_from_rig.translation() + Vec3{-0.01, -0.015, 0}};
    }
    frame(i);
  }
  EXPECT_EQ(test::allocation_count(), before);
  const std::vector<int> one(10);  // the count does count
  EXPECT_GT(test::allocation_count(), before);
  EXPECT_EQ(one.size(), 10u);
}

TEST(RoomRenderer, ImagesOfOddSizesAreFilledToTheEdge) {
  // A quarter of the real camera in steps that nothing divides.
  BrownConrady odd = hololens2_left();
  odd.width_px = 157;
  odd.height_px = 119;
  odd.fx_px /= 4.0;
  odd.fy_px /= 4.0;
  odd.cx_px = 101.0;
  odd.cy_px = 60.0;
  const CameraModel camera = CameraModel::from_brown_conrady(odd).value();
  const RoomDescription room = scene::operating_room(8);
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  GreyImage image;
  for (int turn = 0; turn < 8; ++turn) {  // tools and hand leave over every edge
    RoomState state = scene::operating_state(room);
    const Mat3 aside = rotation_from_vector({0.3 * (turn % 3 - 1), 0.3 * (turn / 3 - 1), 0.0});
    state.room_from_rig = {state.room_from_rig.rotation() * aside,
                           state.room_from_rig.translation()};
    renderer->render(std::vector<RoomState>{state}, camera, calibration().left_from_rig, 1, image);
    ASSERT_EQ(image.pixels.size(), 157u * 119u);
    for (int y = 0; y < 119; ++y) {
      ASSERT_GT(image.at(156, y), 5);
    }
    for (int x = 0; x < 157; ++x) {
      ASSERT_GT(image.at(x, 118), 5);
    }
  }
}

TEST(RoomPicture, ShowsDrapeTissueBoneAndTags) {
  const RoomDescription room = scene::operating_room(24);
  RoomState state = scene::operating_state(room);
  state.hand.reset();
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  RgbaImage image;
  const PinholeView view = view_of(state);
  renderer->picture(state, view, image);
  ASSERT_EQ(image.width_px, 960);
  ASSERT_EQ(image.height_px, 540);
  int cloth = 0;
  int blood = 0;
  int ivory = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    const int r = image.pixels[i];
    const int g = image.pixels[i + 1];
    const int b = image.pixels[i + 2];
    ASSERT_EQ(image.pixels[i + 3], 255);
    cloth += g > r + 40 && b > r + 40 ? 1 : 0;
    blood += r > g + 40 && r > b + 40 && g < 90 ? 1 : 0;
    ivory += r > 150 && g > 130 && b > 90 && r > b + 10 && r < b + 90 ? 1 : 0;
  }
  EXPECT_GT(cloth, 150000);
  EXPECT_GT(blood, 4000);
  EXPECT_GT(ivory, 300);
  // The tag's white quiet zone, projected by hand.
  const Vec3 in_eye = (view.room_from_eye.inverse() *
                       (state.room_from_marker[0] * Point<Marker>{{0.0, 0.0275, 0.0}}))
                          .v;
  const int x = static_cast<int>(480.0 * (1.0 + in_eye.x / -in_eye.z / 0.42));
  const int y = static_cast<int>(270.0 * (1.0 - in_eye.y / -in_eye.z / 0.236));
  const std::size_t at = 4 * static_cast<std::size_t>(y * 960 + x);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GT(image.pixels[at + k], 150) << k;
  }
}

TEST(RoomPicture, TakesTheSizeItIsGiven) {
  const RoomDescription room = scene::operating_room(8);
  const RoomState state = scene::operating_state(room);
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  RgbaImage small;
  small.width_px = 321;
  small.height_px = 181;
  renderer->picture(state, view_of(state), small);
  EXPECT_EQ(small.width_px, 321);
  EXPECT_EQ(small.pixels.size(), 4u * 321u * 181u);
}

}  // namespace
}  // namespace orthonav::sim
