#pragma once

#include "engine/live/frame_loop.h"
#include "render/projection.h"
#include "tests/support/scripted_operation.h"

namespace orthonav::engine {

/// A scripted operation whose snapshots are made as the frame loop makes them.
class GuidedScene {
 public:
  static constexpr Vec3 kLeftEntry{0.015, 0.020, 0.0};

  /// Guiding to the left screw, the guide 5.7° off and 10 mm before the entry.
  void guide() {
    s.accepts_first_level();
    s.says("next");
    s.tracker().guide = test::guide_at(kLeftEntry + Vec3{0, 0.010, 0}, 0.1);
    s.pair();
  }
  const Snapshot& snapshot(const Guidance& guidance) {
    builder_.update(guidance);
    snapshot_.display_time = guidance.display_time;
    snapshot_.tool_time = builder_.visible().pose_time;
    snapshot_.map_epoch = s.map_epoch;
    builder_.write_scene(guidance, snapshot_.scene);
    return snapshot_;
  }

  test::ScriptedOperation s;

 private:
  SceneBuilder builder_;
  Snapshot snapshot_;
};

/// A view down at it from arm's length.
inline render::View view_from(render::Float3 eye) {
  return render::look_at(eye, {0, 0.03f, 0}, {0, 0.3f, 1}, 0.39f, 0.26f);
}
inline render::Head head_at(render::Float3 eye) { return render::head_of({view_from(eye)}); }
inline constexpr render::Float3 kEyeAbove{0.1f, 0.45f, -0.2f};

}  // namespace orthonav::engine
