#include <benchmark/benchmark.h>

#include "tests/support/camera_scene.h"

// What a frame of the simulated room costs, on one core.
namespace orthonav::sim {
namespace {

/// A stereo pair with the default error model: five levels of 8 · rings² triangles, three tools, a
/// hand, three moments of exposure, everything moving from pair to pair.
void stereo_pair(benchmark::State& bench) {
  const RoomDescription room = scene::operating_room(static_cast<int>(bench.range(0)));
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  const StereoCalibration calibration = hololens2_calibration();
  RoomState state = scene::operating_state(room);
  GreyImage left;
  GreyImage right;
  std::uint64_t seed = 0;
  for (auto _ : bench) {
    state.room_from_rig = {
        state.room_from_rig.rotation(),
        state.room_from_rig.translation() + Vec3{0.0, seed % 4 < 2 ? 1e-4 : -1e-4, 0.0}};
    const auto states = scene::exposure(state, {0.0003, 0.0, 0.0002});
    renderer->render(states, calibration.left, calibration.left_from_rig, ++seed, left);
    renderer->render(states, calibration.right, scene::as_camera(calibration.right_from_rig),
                     ++seed, right);
    benchmark::DoNotOptimize(right.pixels.data());
  }
  bench.counters["triangles_a_level"] = static_cast<double>(room.levels[0].triangles.size());
}
BENCHMARK(stereo_pair)->Arg(33)->Arg(65)->Unit(benchmark::kMillisecond);

void picture(benchmark::State& bench) {
  const RoomDescription room = scene::operating_room(33);
  const auto renderer = RoomRenderer::create(room, ErrorModel{});
  const RoomState state = scene::operating_state(room);
  const PinholeView view{{state.room_from_rig.rotation(), state.room_from_rig.translation()},
                         0.42,
                         0.42,
                         0.236,
                         0.236};
  RgbaImage image;
  for (auto _ : bench) {
    renderer->picture(state, view, image);
    benchmark::DoNotOptimize(image.pixels.data());
  }
}
BENCHMARK(picture)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace orthonav::sim

BENCHMARK_MAIN();
