// Opens the simulated operating room, navigates one level and prints what the surgeon is told.
#include <orthonav/engine/case/operation_plan.h>
#include <orthonav/engine/case/tool_file.h>
#include <orthonav/engine/live/assembled_operation.h>
#include <orthonav/engine/phantom/phantom.h>
#include <orthonav/engine/session/wording.h>
#include <orthonav/engine/study/sim_scenario.h>
#include <orthonav/hal/sim/sim_headset.h>

#include "must.h"

using namespace orthonav;
using namespace orthonav::engine;

struct Printer : LoopObserver {
  void stepped(const StereoFrame& frame, const Inputs&, const Guidance& guidance) override {
    if (frame.sequence % 30 != 0) {
      return;
    }
    std::printf("%s  %s", step_text(guidance.status.at).c_str(),
                detail_text(guidance.status).c_str());
    if (guidance.tool && guidance.tool->measured) {
      std::printf("  %.1f° off the plan, tip %.1f mm from the entry",
                  guidance.tool->measured->angle_rad * 57.2958,
                  guidance.tool->measured->tip_to_entry_m * 1e3);
    }
    std::puts("");
  }
};

int main(int argc, char** argv) {
  const Case spine = phantom();
  Operation operation = must(plan_operation(spine, {"L4"}));
  sim::SimOptions sim;
  sim.seed = 3;
  const auto headset =
      must(sim::SimHeadset::open(room_of(spine, operation, built_in_tools()), sim));
  AssemblyOptions options;
  options.loop.max_frames = argc > 1 ? std::atoi(argv[1]) : 0;
  auto assembled = must(assemble_operation(*headset, std::move(operation),
                                           must(method_named("best")), built_in_tools(), options));
  Printer printer;
  assembled->observe(&printer);
  must(assembled->run().ended);
}
