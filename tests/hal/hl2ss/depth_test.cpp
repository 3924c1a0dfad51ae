#include <gmock/gmock.h>

#include <cmath>
#include <iterator>
#include <map>

#include "base/stopwatch.h"
#include "hal/api/depth_camera.h"
#include "tests/hal/hl2ss/served_room.h"

namespace orthonav::hl2ss {
namespace {

using orthonav::test::bare_room;
using orthonav::test::next_pair;
using orthonav::test::paced;
using orthonav::test::ServedRoom;
using orthonav::test::wait_until;
using ::testing::SizeIs;

sim::SimOptions depth_session(double limit_s) {
  sim::SimOptions sim;
  sim.seed = 5;
  sim.limit_s = limit_s;
  sim.error_model = sim::ErrorModel::perfect();
  sim.depth_errors = sim::DepthErrors::none();
  sim.depth = {DepthStream::kAhat, DepthStream::kLongThrow};
  sim.render = false;
  return sim;
}

std::unique_ptr<Hl2ssHeadset> connect(const ServedRoom& room, const DepthWish& wish,
                                      Duration within = std::chrono::seconds(8)) {
  Hl2ssOptions options = room.client_options();
  options.depth = wish;
  options.depth_within = within;
  auto opened = Hl2ssHeadset::open(options);
  EXPECT_TRUE(opened.ok()) << opened.error().message;
  return opened ? std::move(*opened) : nullptr;
}

/// What the simulated room's own depth camera of this kind shows after each pair, by time.
struct Direct {
  std::unique_ptr<sim::SimHeadset> headset;
  DepthCamera* camera = nullptr;
  std::map<Timestamp, DepthFrame> frames;

  Direct(const sim::SimOptions& sim, DepthStream stream) {
    auto opened = sim::SimHeadset::open(bare_room(), sim);
    EXPECT_TRUE(opened.ok());
    headset = std::move(*opened);
    for (DepthCamera* each : headset->depth_cameras()) {
      camera = each->calibration().stream == stream ? each : camera;
    }
    StereoFrame pair;
    DepthFrame frame;
    while (*headset->cameras()->next(pair) == Next::kFrame) {
      while (*camera->next(frame) == Next::kFrame) {
        frames[frame.time] = frame;
      }
    }
  }
  /// Whether a picture from up to `now` is later than all `taken`.
  [[nodiscard]] bool owes(const std::vector<DepthFrame>& taken, Timestamp now) const {
    const auto first_later = frames.upper_bound(now);
    return first_later != frames.begin() &&
           (taken.empty() || std::prev(first_later)->first > taken.back().time);
  }
};

struct Served {
  DepthCalibration calibration;
  std::vector<DepthFrame> frames;
};

/// Everything that the stand-in sends of a depth stream while the pairs are taken. A pair is taken
/// only when every picture that is due has arrived, because pictures not taken in time are replaced
/// by newer ones.
Served served_depth(const sim::SimOptions& sim, const DepthWish& wish, std::size_t enough,
                    const Direct& direct) {
  Served all;
  ServedRoom room(sim, paced());
  const auto headset = connect(room, wish);
  if (!headset) {
    return all;
  }
  EXPECT_THAT(headset->depth_cameras(), SizeIs(1)) << headset->depth_trouble();
  if (headset->depth_cameras().empty()) {
    return all;
  }
  DepthCamera& camera = *headset->depth_cameras().front();
  all.calibration = camera.calibration();
  StereoFrame pair;
  DepthFrame frame;
  // Pictures from before the connection never come.
  constexpr auto kGivenUp = std::chrono::seconds(1);
  Stopwatch since_pair;
  EXPECT_TRUE(wait_until([&] {
    const auto next = camera.next(frame);
    EXPECT_TRUE(next.ok()) << next.error().message;
    if (next && *next == Next::kFrame) {
      all.frames.push_back(frame);
    } else if (!direct.owes(all.frames, pair.time) || since_pair.elapsed() > kGivenUp) {
      if (*headset->cameras()->next(pair) == Next::kFrame) {
        since_pair = Stopwatch();
      }
    }
    return all.frames.size() >= enough;
  }));
  return all;
}

void expect_same_camera(const DepthCalibration& told, const DepthCalibration& actual) {
  ASSERT_EQ(told.width_px, actual.width_px);
  ASSERT_EQ(told.height_px, actual.height_px);
  EXPECT_EQ(told.stream, actual.stream);
  EXPECT_NEAR(told.wraps_at_m, actual.wraps_at_m, 1e-6);
  EXPECT_LT((told.sensor_from_rig.translation() - actual.sensor_from_rig.translation()).norm(),
            1e-6);
  EXPECT_LT(rotation_angle_rad(told.sensor_from_rig.rotation(), actual.sensor_from_rig.rotation()),
            1e-6);
  // A twentieth of a pixel: 0.1 mm at half a metre.
  constexpr double kRay = 2e-4;
  std::size_t known = 0;
  for (std::size_t i = 0; i < told.rays.size(); ++i) {
    const auto& a = told.rays[i];
    const auto& b = actual.rays[i];
    if (a[2] == 0.0F) {
      continue;
    }
    ++known;
    ASSERT_GT(b[2], 0.0F) << "no direction at pixel " << i;
    ASSERT_LT((Vec3{a[0], a[1], a[2]} - Vec3{b[0], b[1], b[2]}).norm(), kRay) << "pixel " << i;
  }
  // Along the circle's edge one or two pixels are lost to the tables' corners.
  EXPECT_GT(known, told.rays.size() * 7 / 10);
}

void expect_same_pose(const DepthFrame& a, const DepthFrame& b) {
  ASSERT_EQ(a.world_from_rig.has_value(), b.world_from_rig.has_value());
  if (a.world_from_rig) {
    // Single precision.
    constexpr double kSingle = 2e-6;
    EXPECT_LT((a.world_from_rig->translation() - b.world_from_rig->translation()).norm(), kSingle);
    EXPECT_LT(rotation_angle_rad(a.world_from_rig->rotation(), b.world_from_rig->rotation()),
              kSingle);
  }
}

std::ptrdiff_t differing(const DepthImage& a, const DepthImage& b) {
  std::ptrdiff_t count = a.pixels.size() == b.pixels.size() ? 0 : -1;
  for (std::size_t i = 0; count >= 0 && i < a.pixels.size(); ++i) {
    count += a.pixels[i] == b.pixels[i] ? 0 : 1;
  }
  return count;
}

/// Raw pictures and PNG lose nothing.
void expect_exact(const DepthWish& wish, double limit_s, std::size_t enough) {
  const sim::SimOptions sim = depth_session(limit_s);
  const Direct direct(sim, wish.stream);
  const Served all = served_depth(sim, wish, enough, direct);
  expect_same_camera(all.calibration, direct.camera->calibration());
  ASSERT_GE(all.frames.size(), enough);
  for (const DepthFrame& frame : all.frames) {
    const auto same = direct.frames.find(frame.time);
    ASSERT_NE(same, direct.frames.end()) << seconds(frame.time.time_since_epoch());
    EXPECT_EQ(differing(frame.range_mm, same->second.range_mm), 0);
    EXPECT_EQ(differing(frame.brightness, same->second.brightness), 0);
    expect_same_pose(frame, same->second);
    EXPECT_EQ(frame.map_epoch, 0);
  }
  // None is left out from the first that came to the last.
  const auto first = direct.frames.find(all.frames.front().time);
  const auto last = direct.frames.find(all.frames.back().time);
  EXPECT_THAT(all.frames, SizeIs(static_cast<std::size_t>(std::distance(first, last) + 1)));
}

TEST(Depth, OfAhatRawComesAsItWas) {
  expect_exact({DepthStream::kAhat, DepthCoding::kRaw}, 0.6, 6);
}

TEST(Depth, OfLongThrowRawComesAsItWas) {
  expect_exact({DepthStream::kLongThrow, DepthCoding::kRaw}, 1.5, 3);
}

TEST(Depth, OfLongThrowAsPngComesAsItWas) {
  expect_exact({DepthStream::kLongThrow, DepthCoding::kPng}, 1.5, 3);
}

/// 45 a second from a headset that has 30 pairs a second.
TEST(Depth, OfAhatComesAtTheRateOfTheDevice) {
  const sim::SimOptions sim = depth_session(0.6);
  const Direct direct(sim, DepthStream::kAhat);
  const Served all = served_depth(sim, {DepthStream::kAhat, DepthCoding::kRaw}, 10, direct);
  ASSERT_GE(all.frames.size(), 10u);
  constexpr double kTickS = 1e-7;
  for (std::size_t i = 1; i < all.frames.size(); ++i) {
    EXPECT_NEAR(seconds(all.frames[i].time - all.frames[i - 1].time), 1.0 / 45.0, kTickS);
  }
}

/// A quarter of the depth as video: steps of 4 mm, and the codec's errors.
void expect_within_steps(DepthCoding coding, double most_off) {
  const sim::SimOptions sim = depth_session(0.6);
  const Direct direct(sim, DepthStream::kAhat);
  const Served all = served_depth(sim, {DepthStream::kAhat, coding}, 6, direct);
  ASSERT_GE(all.frames.size(), 6u);
  for (const DepthFrame& frame : all.frames) {
    const DepthFrame& same = direct.frames.at(frame.time);
    std::size_t both = 0;
    std::size_t off = 0;
    std::size_t ghosts = 0;  // a value where nothing was measured
    double sum_mm = 0.0;
    for (std::size_t i = 0; i < frame.range_mm.pixels.size(); ++i) {
      const int told = frame.range_mm.pixels[i];
      const int true_mm = same.range_mm.pixels[i];
      ghosts += told != 0 && true_mm == 0 ? 1 : 0;
      // Past 1,023 mm eight bits wrap around.
      if (told == 0 || true_mm == 0 || true_mm > 1000) {
        continue;
      }
      ++both;
      sum_mm += std::abs(told - true_mm) < 20 ? told - true_mm : 0.0;
      off += std::abs(told - true_mm) > 6 ? 1 : 0;
    }
    EXPECT_GT(both, same.range_mm.pixels.size() / 2);
    EXPECT_LT(static_cast<double>(off), most_off * static_cast<double>(both)) << "of " << both;
    EXPECT_LT(ghosts, both / 100) << "of " << both;
    EXPECT_LT(std::abs(sum_mm / static_cast<double>(both)), 1.0);
  }
}

TEST(Depth, OfAhatAsH264ComesWithinItsSteps) { expect_within_steps(DepthCoding::kH264, 0.001); }

/// The pairs are the same, to the bit, whether depth comes beside them or not.
TEST(Depth, ChangesNothingOfThePairs) {
  sim::SimOptions sim = depth_session(0.31);
  sim.render = true;
  ServedRoom room(sim, paced());
  const auto headset = connect(room, {DepthStream::kAhat, DepthCoding::kRaw});
  ASSERT_NE(headset, nullptr);
  auto direct = sim::SimHeadset::open(bare_room(), sim);
  ASSERT_TRUE(direct.ok());
  StereoFrame frame;
  StereoFrame expected;
  DepthFrame depth;
  int pairs = 0;
  for (; next_pair(*headset, frame) == Next::kFrame; ++pairs) {
    ASSERT_EQ(*(*direct)->cameras()->next(expected), Next::kFrame);
    EXPECT_EQ(frame.time, expected.time);
    EXPECT_TRUE(frame.left == expected.left);
    EXPECT_TRUE(frame.right == expected.right);
    (void)headset->depth_cameras().front()->next(depth);
  }
  EXPECT_EQ(pairs, 9);
}

TEST(Depth, IsNotThereWhereNobodyAsksForIt) {
  ServedRoom room(depth_session(0.5), paced());
  const auto headset = room.connect();
  ASSERT_NE(headset, nullptr);
  EXPECT_THAT(headset->depth_cameras(), SizeIs(0));
  EXPECT_EQ(headset->depth_trouble(), "");
}

/// A headset without such a camera hangs up: it is opened anyway, and reports why.
TEST(Depth, ThatIsRefusedLeavesTheRest) {
  sim::SimOptions sim = depth_session(0.5);
  sim.depth = {DepthStream::kLongThrow};
  ServedRoom room(sim, paced());
  const auto headset =
      connect(room, {DepthStream::kAhat, DepthCoding::kRaw}, std::chrono::milliseconds(200));
  ASSERT_NE(headset, nullptr);
  EXPECT_THAT(headset->depth_cameras(), SizeIs(0));
  EXPECT_THAT(headset->depth_trouble(), ::testing::HasSubstr("no depth camera ahat: port "));
  StereoFrame frame;
  EXPECT_EQ(next_pair(*headset, frame), Next::kFrame);
}

}  // namespace
}  // namespace orthonav::hl2ss
