#include "tools/orthonav/dashboard/camera_view.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>

#include "tests/support/scripted_session.h"

namespace orthonav::tools::camera_view_test {
namespace {

/// Where the head was, so that places can be given in its axes.
const Transform<World, Rig> kHead = test::scripted_pose(7);

/// A pair whose left image is evenly grey.
StereoFrame grey_frame(Timestamp time) {
  StereoFrame frame;
  frame.time = time;
  frame.left = GreyImage(640, 480, 90);
  frame.world_from_rig = kHead;
  return frame;
}

/// A blue triangle 0.4 m ahead of the left camera, of which `right_m` and `up_m` is the middle.
engine::Snapshot snapshot_with_triangle(double right_m, double up_m) {
  engine::Snapshot snapshot;
  const auto in_world = [&](double x, double y) {
    const Vec3 camera = test::scripted_calibration().left_from_rig.inverse().translation();
    const Vec3 at = (kHead * Point<Rig>{camera + Vec3{right_m + x, up_m + y, -0.4}}).v;
    return render::Float3{static_cast<float>(at.x), static_cast<float>(at.y),
                          static_cast<float>(at.z)};
  };
  render::TriangleItem triangle;
  triangle.corners = {in_world(-0.02, -0.02), in_world(0.02, -0.02), in_world(0.0, 0.03)};
  triangle.colour = {0.0f, 0.0f, 1.0f, 1.0f};
  snapshot.scene.triangles.push_back(triangle);
  return snapshot;
}

/// Keeps the pictures that come and lets a test wait for them.
class Browser {
 public:
  CameraView::Onlooker onlooker() {
    return {[this] { return looks.load(); },
            [this](const RgbaImage& picture) {
              const MutexLock lock(mutex_);
              newest_ = picture;
              ++count_;
              changed_.notify_all();
            }};
  }
  /// Absent if fewer arrive within a minute.
  std::optional<RgbaImage> picture(int count) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    const MutexLock lock(mutex_);
    while (count_ < count) {
      if (!changed_.wait_until(mutex_, until)) {
        return std::nullopt;
      }
    }
    return newest_;
  }
  int count() {
    const MutexLock lock(mutex_);
    return count_;
  }
  std::atomic<bool> looks = true;

 private:
  Mutex mutex_;
  ConditionVariable changed_;
  RgbaImage newest_ ORTHONAV_GUARDED_BY(mutex_);
  int count_ ORTHONAV_GUARDED_BY(mutex_) = 0;
};

/// The middle of the blue pixels, in fractions of the picture; absent if there are none.
std::optional<Vec2> middle_of_blue(const RgbaImage& picture) {
  Vec2 sum{};
  double n = 0.0;
  for (std::size_t i = 0; i + 3 < picture.pixels.size(); i += 4) {
    if (picture.pixels[i + 2] > 150 && picture.pixels[i] < 60) {
      const auto pixel = static_cast<double>(i / 4);
      sum.x += std::fmod(pixel, picture.width_px) / picture.width_px;
      sum.y += std::floor(pixel / picture.width_px) / picture.height_px;
      n += 1.0;
    }
  }
  return n > 0.0 ? std::optional(Vec2{sum.x / n, sum.y / n}) : std::nullopt;
}

class CountingDisplay : public engine::SnapshotSink {
 public:
  Status draw(const engine::Snapshot& /*snapshot*/) override {
    ++drawn;
    return answer;
  }
  [[nodiscard]] bool stalled() const override { return hangs; }
  int drawn = 0;
  bool hangs = false;
  Status answer;
};

void show(CameraView& view, const StereoFrame& frame, const engine::Snapshot& snapshot) {
  view.pair_came(frame);
  view.captured(snapshot);
  ASSERT_TRUE(view.draw(snapshot).ok());
}

TEST(CameraView, DrawsTheHologramsWhereTheCameraSeesThem) {
  Browser browser;
  CameraView view(test::scripted_calibration(), nullptr, browser.onlooker());
  show(view, grey_frame(test::scripted_time(0)), snapshot_with_triangle(-0.06, 0.05));
  const auto first = browser.picture(1);
  ASSERT_TRUE(first.has_value()) << view.problem();
  const auto left_and_up = middle_of_blue(*first);
  ASSERT_TRUE(left_and_up.has_value()) << "no hologram was drawn";
  show(view, grey_frame(test::scripted_time(30)), snapshot_with_triangle(0.06, -0.05));
  const auto second = browser.picture(2);
  ASSERT_TRUE(second.has_value());
  const auto right_and_down = middle_of_blue(*second);
  ASSERT_TRUE(right_and_down.has_value());
  EXPECT_LT(left_and_up->x, right_and_down->x - 0.1);
  EXPECT_LT(left_and_up->y, right_and_down->y - 0.1) << "y runs down";
  // The camera's picture is behind them, not the empty background.
  const std::size_t corner = 4 * (static_cast<std::size_t>(first->width_px) * 40 + 400);
  EXPECT_EQ(first->pixels[corner], first->pixels[corner + 1]);
  EXPECT_NE(first->pixels[corner], 34);
}

TEST(CameraView, ShowsNoHologramInPlaceWhileTheHeadIsLost) {
  Browser browser;
  CameraView view(test::scripted_calibration(), nullptr, browser.onlooker());
  StereoFrame frame = grey_frame(test::scripted_time(0));
  frame.world_from_rig.reset();
  show(view, frame, snapshot_with_triangle(0.0, 0.0));
  const auto picture = browser.picture(1);
  ASSERT_TRUE(picture.has_value()) << view.problem();
  EXPECT_FALSE(middle_of_blue(*picture).has_value());
}

TEST(CameraView, DrawsOnlyWhileSomebodyLooksAndTwiceASecond) {
  Browser browser;
  CountingDisplay display;
  CameraView view(test::scripted_calibration(), &display, browser.onlooker());
  const engine::Snapshot snapshot = snapshot_with_triangle(0.0, 0.0);
  browser.looks = false;
  for (int i = 0; i < 30; ++i) {
    show(view, grey_frame(test::scripted_time(i)), snapshot);
  }
  browser.looks = true;
  // One second: at its beginning and half a second later.
  for (int i = 30; i < 60; ++i) {
    show(view, grey_frame(test::scripted_time(i)), snapshot);
    if (i == 30) {
      ASSERT_TRUE(browser.picture(1).has_value()) << view.problem();
    }
  }
  ASSERT_TRUE(browser.picture(2).has_value());
  EXPECT_EQ(browser.count(), 2);
  EXPECT_EQ(display.drawn, 60) << "the surgeon's display gets every one";
}

TEST(CameraView, PassesOnWhatTheDisplaySays) {
  Browser browser;
  CountingDisplay display;
  CameraView view(test::scripted_calibration(), &display, browser.onlooker());
  display.answer = Error{"gone"};
  display.hangs = true;
  EXPECT_EQ(view.draw(snapshot_with_triangle(0.0, 0.0)).error().message, "gone");
  EXPECT_TRUE(view.stalled());
}

}  // namespace
}  // namespace orthonav::tools::camera_view_test
