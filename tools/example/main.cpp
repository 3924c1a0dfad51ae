// Opens the simulated operating room, navigates one level and prints what the surgeon is told.
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "engine/case/operation_plan.h"
#include "engine/case/tool_file.h"
#include "engine/live/assembled_operation.h"
#include "engine/phantom/phantom.h"
#include "engine/session/wording.h"
#include "engine/study/sim_scenario.h"
#include "hal/open/open.h"

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
      std::printf("  %.1f deg off the plan, tip %.1f mm from the entry",
                  guidance.tool->measured->angle_rad * 57.2958,
                  guidance.tool->measured->tip_to_entry_m * 1e3);
    }
    std::puts("");
  }
};

/// Returns the value, or prints the reason and ends the program.
template <class T>
T must(Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "example: %s\n", result.error().message.c_str());
    std::exit(2);
  }
  return std::move(result).value();
}

int main(int argc, char** argv) {
  const Case spine = phantom();
  Operation operation = must(plan_operation(spine, {"L4"}));
  auto headset =
      must(open_headset("sim:?seed=3", {room_of(spine, operation, built_in_tools()), {}}));
  AssemblyOptions options;
  options.loop.max_frames = argc > 1 ? std::atoi(argv[1]) : 0;
  auto assembled = must(assemble_operation(*headset, std::move(operation),
                                           must(method_named("best")), built_in_tools(), options));
  Printer printer;
  assembled->observe(&printer);
  must(assembled->run());
}
