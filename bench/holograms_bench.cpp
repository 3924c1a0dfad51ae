// One frame of the surgeon's view, both eyes: a surface of 32k triangles, guidance, text.
// "Time" is by the clock; "CPU" adds all threads, those of llvmpipe too.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "engine/golden/golden_scenes.h"
#include "render/shapes.h"

namespace orthonav {
namespace {

/// The golden guidance scene, its vertebra replaced by a surface as fine as a real one.
engine::GoldenScene guidance() {
  std::vector<engine::GoldenScene> scenes = engine::golden_scenes();
  engine::GoldenScene scene = *std::find_if(scenes.begin(), scenes.end(),
                                            [](const auto& s) { return s.name == "guidance"; });
  auto mesh = std::make_shared<render::MeshData>(render::make_sphere(0.035f, 180, 90));
  scene.scene.meshes.front().mesh = mesh;
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

}  // namespace
}  // namespace orthonav

BENCHMARK_MAIN();
