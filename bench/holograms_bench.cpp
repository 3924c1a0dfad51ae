// One frame of the surgeon's view, both eyes: a surface of 32k triangles, guidance, text.
// "Time" is by the clock; "CPU" adds all threads, those of llvmpipe too.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "engine/golden/golden_scenes.h"
#include "engine/holograms/labels/label_layout.h"
#include "engine/holograms/shapes/hologram_shapes.h"
#include "render/decimated.h"
#include "render/projection.h"
#include "render/shapes.h"

namespace orthonav {
namespace {

/// The golden guidance scene, its vertebra replaced by a surface as fine as a real one.
engine::GoldenScene guidance() {
  std::vector<engine::GoldenScene> scenes = engine::golden_scenes();
  engine::GoldenScene scene = *std::find_if(scenes.begin(), scenes.end(),
                                            [](const auto& s) { return s.name == "guidance"; });
  scene.scene.meshes.front().mesh = render::prepared(render::make_sphere(0.035f, 180, 90));
  std::vector<render::Float3> path;
  for (int i = 0; i < 500; ++i) {
    path.push_back(
        {-0.02f + 8e-5f * static_cast<float>(i), 0.04f + 1e-3f * static_cast<float>(i % 7), 0.01f});
  }
  render::LineItem line;
  line.label = 101;
  line.points = path;
  scene.scene.lines.push_back(line);
  return scene;
}

void draw_both_eyes(benchmark::State& state) {
  const engine::GoldenScene scene = guidance();
  render::RendererOptions options;
  options.width_px = static_cast<int>(state.range(0));
  options.height_px = static_cast<int>(state.range(1));
  const auto renderer = render::Renderer::create(options);
  if (!renderer) {
    state.SkipWithError(renderer.error().message.c_str());
    return;
  }
  state.SetLabel((*renderer)->device().name);
  std::vector<RgbaImage> images;
  for (auto _ : state) {
    const Status drawn = (*renderer)->draw(scene.scene, scene.views, {}, images);
    if (!drawn) {
      state.SkipWithError(drawn.error().message.c_str());
    }
  }
}
BENCHMARK(draw_both_eyes)
    ->Args({640, 360})
    ->Args({1268, 720})
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

/// Labels laid out for both eyes of a head that sways, as the loop does with every snapshot.
void lay_out_labels(benchmark::State& state) {
  render::Scene crowd = guidance().scene;
  for (int level = 0; level < state.range(0); ++level) {
    for (const float side : {0.0165f, -0.0165f}) {
      engine::EntryHologram entry;
      entry.position = {side, 0.032f, -0.034f * static_cast<float>(level)};
      entry.surface_normal = {0, 1, 0};
      entry.text = "L1 right";
      engine::add_entry(crowd, entry,
                        310 + 2 * static_cast<render::Label>(level) + (side > 0 ? 1 : 0));
    }
  }
  render::Scene scene;
  engine::LabelLayout layout;
  int frame = 0;
  for (auto _ : state) {
    state.PauseTiming();
    scene = crowd;
    const float sway_m = 0.1f * std::sin(0.02f * static_cast<float>(++frame));
    const auto views = render::stereo_pair(
        render::look_at({sway_m, 0.45f, -0.25f}, {0, 0.03f, -0.05f}, {0, 0.3f, 1}, 0.39f, 0.26f));
    state.ResumeTiming();
    layout.lay_out(scene, views, {}, Timestamp{} + frame * std::chrono::milliseconds(33));
  }
}
BENCHMARK(lay_out_labels)->Arg(0)->Arg(2)->Arg(6)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace orthonav

BENCHMARK_MAIN();
