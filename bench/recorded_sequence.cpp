#include "bench/recorded_sequence.h"

#include "tests/support/sample_recording.h"

namespace orthonav::bench {

std::optional<Sequence> recorded_sequence() {
  auto sample = test::load_sample();
  if (!sample) {
    return std::nullopt;
  }
  Sequence out;
  out.name = "recorded";
  for (const StereoFrame& frame : sample->frames) {
    const auto rig_from_world = frame.world_from_rig->inverse();
    auto& poses = out.rig_from_marker.emplace_back();
    auto& visible = out.visible.emplace_back();
    for (const nav::ToolGeometry& tool : sample->tools) {
      const test::TruthRow* row = sample->find(frame.time, tool.marker.id);
      poses.push_back(row ? rig_from_world * row->world_from_marker : Transform<Rig, Marker>{});
      const double fraction = row && row->visible ? 1.0 : 0.0;
      visible.push_back({fraction, fraction});
    }
  }
  // The sample gives no tip for the reference; angles need none.
  for (nav::ToolGeometry& tool : sample->tools) {
    tool.tip_in_marker = {{0.0, -0.15, 0.0}};
  }
  out.calibration = std::move(sample->calibration);
  out.tools = std::move(sample->tools);
  out.frames = std::move(sample->frames);
  return out;
}

}  // namespace orthonav::bench
