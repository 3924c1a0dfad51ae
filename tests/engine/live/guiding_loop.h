#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/live/frame_loop.h"
#include "tests/support/scripted_operation.h"
#include "tests/support/shown_frames.h"

namespace orthonav::engine {

inline bool shows_triangle(const ShownFrame& frame) {
  return std::any_of(frame.holograms.begin(), frame.holograms.end(),
                     [](const ShownHologram& h) { return h.kind == HologramKind::kTriangle; });
}

/// A session that guides the first screw, with the guide in sight.
class GuidingLoop : public ::testing::Test {
 protected:
  GuidingLoop() {
    s.accepts_first_level();
    s.says("next");
    s.tracker().guide = test::guide_at({0.015, 0.020, 0.0}, 0.1);
    s.pair();
  }
  LoopReport run(Headset& headset, LoopObserver* observer = nullptr, SnapshotSink* sink = nullptr) {
    SceneBuilder builder;
    FrameLoop loop(headset, s.session(), builder, options);
    seen.clear();
    loop.observe(&seen);
    loop.observe(observer);
    loop.draw_into(sink);
    return loop.run();
  }
  test::ScriptedOperation s;
  LoopOptions options;
  test::ShownFrames seen;  ///< in the last run
};

}  // namespace orthonav::engine
