// What a simulated operation on the built-in phantom costs per stereo pair until the first vertebra
// is registered: the simulated room, tracking and everything after it. Nothing is drawn: drawing
// has its own thread and its own benchmark.
#include <benchmark/benchmark.h>

#include <array>
#include <optional>

#include "base/histogram.h"
#include "base/stopwatch.h"
#include "engine/case/tool_file.h"
#include "engine/phantom/phantom.h"
#include "nav/guidance/screw_clearance.h"
#include "study/simulated_operation.h"

namespace orthonav {
namespace {

/// Wall time from the end of one pair's step to the end of the next one's: the room and the step.
class PairTimes : public engine::LoopObserver {
 public:
  void stepped(const FrameHeader& /*frame*/, const engine::Inputs& /*inputs*/,
               const engine::Guidance& /*guidance*/) override {
    if (since_last_) {
      ms_.add(since_last_->elapsed_ms());
    }
    since_last_.emplace();
  }
  [[nodiscard]] const Histogram& ms() const { return ms_; }

 private:
  std::optional<Stopwatch> since_last_;
  Histogram ms_;
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
    const Histogram& step = result->loop.step_wall_ms;
    state.counters["pairs"] = static_cast<double>(step.count());
    state.counters["pair_ms_mean"] = pairs.ms().mean().value_or(0.0);
    state.counters["step_ms_mean"] = step.mean().value_or(0.0);
    state.counters["step_ms_median"] = step.quantile(0.5).value_or(0.0);
    state.counters["step_ms_p99"] = step.quantile(0.99).value_or(0.0);
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
