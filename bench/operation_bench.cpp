// What a simulated operation on the built-in phantom costs per stereo pair until the first vertebra
// is registered: the simulated room, tracking and everything after it. Nothing is drawn: drawing
// has its own thread and its own benchmark.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "base/stopwatch.h"
#include "bench/quantile.h"
#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "engine/study/simulated_operation.h"
#include "nav/guidance/clearance_spread.h"

namespace orthonav {
namespace {

/// Wall time from the end of one pair's step to the end of the next one's.
class PairTimes : public engine::LoopObserver {
 public:
  void stepped(const StereoFrame& /*frame*/, const engine::Inputs& /*inputs*/,
               const engine::Guidance& /*guidance*/) override {
    if (since_last_) {
      ms_.push_back(since_last_->elapsed_ms());
    }
    since_last_.emplace();
  }
  [[nodiscard]] const std::vector<double>& ms() const { return ms_; }

 private:
  std::optional<Stopwatch> since_last_;
  std::vector<double> ms_;
};

void operation(benchmark::State& state) {
  for (auto _ : state) {
    engine::OperationOptions options;
    options.tools = engine::built_in_tools();
    options.loop.draw_every = 0;
    options.loop.max_frames = state.range(0);
    PairTimes pairs;
    const auto result = engine::run_operation(engine::phantom(), options, {.loop = &pairs});
    if (!result) {
      state.SkipWithError(result.error().message.c_str());
      return;
    }
    const std::vector<double>& step = result->loop.step_wall_ms;
    std::vector<double> room;
    for (std::size_t i = 0; i + 1 < step.size() && i < pairs.ms().size(); ++i) {
      room.push_back(pairs.ms()[i] - step[i + 1]);
    }
    state.counters["pairs"] = static_cast<double>(step.size());
    state.counters["room_ms_median"] = quantile(room, 0.5);
    state.counters["room_ms_p99"] = quantile(room, 0.99);
    state.counters["step_ms_median"] = quantile(step, 0.5);
    state.counters["step_ms_p99"] = quantile(step, 0.99);
  }
}
/// What the readout of a screw's clearance costs in every pair: the clearance alone, and with its
/// bound for a pose known to 0.5 mm and 0.5° (1 SD along and about each axis).
void clearance(benchmark::State& state) {
  const engine::Case spine = engine::phantom({"L4"});
  const nav::SurfaceIndex bone(spine.levels[0].mesh);
  const nav::ScrewPlan& plan = spine.levels[0].screws[0];
  const auto screw = nav::cylinder_of(plan);
  std::array<double, 36> covariance{};
  for (std::size_t k = 0; k < 3; ++k) {
    covariance[7 * k] = 0.0005 * 0.0005;
    covariance[7 * (k + 3)] = 0.0087 * 0.0087;
  }
  const nav::PoseUncertainty pose(plan.entry.v, covariance);
  for (auto _ : state) {
    auto found = nav::screw_clearance(bone, *screw, state.range(0) == 0 ? nullptr : &pose);
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK(clearance)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

BENCHMARK(operation)->Arg(2400)->Iterations(1)->UseRealTime()->Unit(benchmark::kSecond);

}  // namespace
}  // namespace orthonav

BENCHMARK_MAIN();
