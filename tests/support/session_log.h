#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "hal/api/depth_camera.h"
#include "hal/api/devices.h"

namespace orthonav::test {

/// Everything that a headset delivered while it was polled as by a frame loop.
struct SessionLog {
  struct Moment {
    StereoFrame frame;
    Timestamp clock{};
    Timestamp display_time{};
    Tracked<Transform<World, Rig>> head_now;
    Tracked<Transform<World, Rig>> head_at_display;
  };
  struct DepthMoment {
    std::size_t camera = 0;
    DepthFrame frame;
    Timestamp clock{};
  };
  std::vector<Moment> moments;
  std::vector<DepthMoment> depth;
  std::vector<ClickerEvent> clicker;
  std::vector<Phrase> voice;
  std::vector<std::string> errors;
  bool ended = false;
};

/// Takes all frames that the depth cameras have by now.
inline void take_depth(Headset& headset, SessionLog& log, int max_calls = 2000) {
  const auto cameras = headset.depth_cameras();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    for (int call = 0; call < max_calls; ++call) {
      DepthFrame frame;
      const auto answer = cameras[i]->next(frame);
      if (!answer) {
        log.errors.push_back(answer.error().message);
      }
      if (answer && *answer != Next::kFrame) {
        break;
      }
      if (answer) {
        log.depth.push_back({i, std::move(frame), headset.clock().now()});
      }
    }
  }
}

/// Plays `headset` to its end, at most `max_calls` calls of next().
inline SessionLog play(Headset& headset, int max_calls = 2000) {
  SessionLog log;
  StereoFrame frame;
  for (int call = 0; call < max_calls && !log.ended; ++call) {
    const auto answer = headset.cameras()->next(frame);
    if (!answer) {
      log.errors.push_back(answer.error().message);
    }
    if (!answer || *answer == Next::kNone) {
      continue;
    }
    log.ended = *answer == Next::kEnd;
    const Timestamp now = headset.clock().now();
    if (*answer == Next::kFrame) {
      const Timestamp lit = now + headset.display_latency();
      log.moments.push_back({frame, now, lit, headset.head().world_from_rig(frame.time),
                             headset.head().world_from_rig(lit)});
    }
    take_depth(headset, log);
    if (Status s = headset.clicker().poll(now, log.clicker); !s) {
      log.errors.push_back(s.error().message);
    }
    if (Status s = headset.voice().poll(now, log.voice); !s) {
      log.errors.push_back(s.error().message);
    }
  }
  return log;
}

inline void expect_same(const Tracked<Transform<World, Rig>>& a,
                        const Tracked<Transform<World, Rig>>& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.status, b.status);
  if (a.status == PoseStatus::kLost || b.status == PoseStatus::kLost) {
    return;
  }
  EXPECT_EQ(a.value, b.value);
  EXPECT_EQ(a.covariance, b.covariance);
}

inline void expect_same(const SessionLog::DepthMoment& a, const SessionLog::DepthMoment& b) {
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.clock, b.clock);
  EXPECT_EQ(a.frame.sequence, b.frame.sequence);
  EXPECT_EQ(a.frame.map_epoch, b.frame.map_epoch);
  EXPECT_EQ(a.frame.time, b.frame.time);
  EXPECT_TRUE(a.frame.range_mm == b.frame.range_mm);
  EXPECT_TRUE(a.frame.brightness == b.frame.brightness);
  EXPECT_EQ(a.frame.world_from_rig, b.frame.world_from_rig);
}

/// Expects the same bits throughout.
inline void expect_same(const SessionLog& a, const SessionLog& b) {
  EXPECT_EQ(a.ended, b.ended);
  EXPECT_EQ(a.errors, b.errors);
  EXPECT_TRUE(a.clicker == b.clicker);
  EXPECT_TRUE(a.voice == b.voice);
  ASSERT_EQ(a.moments.size(), b.moments.size());
  for (std::size_t i = 0; i < a.moments.size(); ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const auto& x = a.moments[i];
    const auto& y = b.moments[i];
    EXPECT_EQ(x.frame.sequence, y.frame.sequence);
    EXPECT_EQ(x.frame.time, y.frame.time);
    EXPECT_EQ(x.frame.map_epoch, y.frame.map_epoch);
    EXPECT_TRUE(x.frame.left == y.frame.left);
    EXPECT_TRUE(x.frame.right == y.frame.right);
    EXPECT_EQ(x.frame.world_from_rig, y.frame.world_from_rig);
    EXPECT_EQ(x.clock, y.clock);
    EXPECT_EQ(x.display_time, y.display_time);
    expect_same(x.head_now, y.head_now);
    expect_same(x.head_at_display, y.head_at_display);
  }
  ASSERT_EQ(a.depth.size(), b.depth.size());
  for (std::size_t i = 0; i < a.depth.size(); ++i) {
    SCOPED_TRACE("depth frame " + std::to_string(i));
    expect_same(a.depth[i], b.depth[i]);
  }
}

inline void expect_same(const DepthCalibration& a, const DepthCalibration& b) {
  EXPECT_EQ(a.stream, b.stream);
  EXPECT_EQ(a.width_px, b.width_px);
  EXPECT_EQ(a.height_px, b.height_px);
  EXPECT_TRUE(a.rays == b.rays);
  EXPECT_EQ(a.sensor_from_rig, b.sensor_from_rig);
}

/// Expects the same bits of table and extrinsics, NaN equal to NaN.
inline void expect_same(const StereoCalibration& a, const StereoCalibration& b) {
  EXPECT_EQ(a.left_from_rig, b.left_from_rig);
  EXPECT_EQ(a.right_from_rig, b.right_from_rig);
  const auto compare = [](const CameraModel& x, const CameraModel& y) {
    ASSERT_EQ(x.width_px(), y.width_px());
    ASSERT_EQ(x.height_px(), y.height_px());
    std::size_t different = 0;
    for (std::size_t i = 0; i < x.lookup().size(); ++i) {
      const Vec2 p = x.lookup()[i];
      const Vec2 q = y.lookup()[i];
      const bool both_nothing = p.x != p.x && q.x != q.x;
      if (!(p == q) && !both_nothing) {
        ++different;
      }
    }
    EXPECT_EQ(different, 0u);
    const Vec2 aside{0.213, -0.176};
    EXPECT_EQ(x.project(aside), y.project(aside));
  };
  compare(a.left, b.left);
  compare(a.right, b.right);
}

}  // namespace orthonav::test
