// Operates a level of the built-in spine in the simulated room and prints what the surgeon is told,
// until its screw is in. With another headset (device.cpp), only the line that opens it is another.
//   example [FRAMES]      ends after so many; exit code 1: the screw is not in
#include <orthonav/engine/case/operation_plan.h>
#include <orthonav/engine/case/tool_file.h>
#include <orthonav/engine/live/assembled_operation.h>
#include <orthonav/engine/phantom/phantom.h>
#include <orthonav/engine/session/text/wording.h>
#include <orthonav/hal/sim/sim_headset.h>
#include <orthonav/study/set_up.h>
#include <orthonav/study/sim_scenario.h>
#include <orthonav/study/surgeon/written_frame.h>

#include "must.h"

using namespace orthonav;
using namespace orthonav::engine;

/// Prints the status line and the numbers beside the tool, twice a second.
struct Printer : LoopObserver {
  void stepped(const FrameHeader& frame, const Inputs&, const Guidance& guidance) override {
    if (frame.sequence % 15 != 0) {
      return;
    }
    std::printf("%s  %s\n", step_text(guidance.status.at).c_str(),
                detail_text(guidance.status).c_str());
    if (guidance.tool && guidance.tool->measured) {
      const nav::ScrewGuidance& numbers = *guidance.tool->measured;
      std::printf("    %.1f° off the plan, tip %.1f mm beside the axis, %.1f mm deep\n",
                  numbers.angle_rad * 57.2958, numbers.tip_off_axis_m * 1e3, numbers.depth_m * 1e3);
    }
  }
};

/// The simulated room of the case: its surgeon goes by the numbers and is ten times as fast as a
/// real one.
std::unique_ptr<Headset> open_room(const Case& spine, const Operation& operation) {
  sim::SimOptions options;
  options.seed = 4;
  must(SetUp::best().tell(options));
  options.error_model.pace = 10.0;
  return must(sim::SimHeadset::open(room_of(spine, operation, built_in_tools()), options));
}

int main(int argc, char** argv) {
  // The case: the plan of one level, of which one screw is enough here.
  const Case spine = phantom();
  Operation operation = must(plan_operation(spine, {"L4"}));
  operation.levels.front().screws.resize(1);

  const auto headset = open_room(spine, operation);

  // The session: how tools are tracked and bones registered, and the loop that feeds it pairs of
  // pictures.
  AssemblyOptions options;
  options.loop.max_frames = argc > 1 ? std::atoi(argv[1]) : 0;
  options.use_reference = SetUp::best().reference;
  const auto live = must(assemble_operation(*headset, std::move(operation),
                                            must(method_named("best")), built_in_tools(), options));
  Printer printer;
  live->observe(&printer);
  // The simulated surgeon can't see pixels: they are told what is shown.
  sim::ShownToWearer to_surgeon(*headset);
  live->observe(&to_surgeon);
  must(live->run().ended);

  const LevelState& level = live->session().levels().front();
  if (!level.finished()) {
    std::printf("%s: no screw is in, its registration was %s\n", level.plan.label.c_str(),
                level.accepted ? "accepted" : "not accepted");
    return 1;
  }
  std::printf("%s: the screw is in", level.plan.label.c_str());
  if (const auto& wire = level.screws.front().wire.measured) {
    std::printf(", measured %.1f° and %.1f mm off the plan", wire->axis.angle_rad.value * 57.2958,
                wire->axis.entry_m.value * 1e3);
  }
  std::puts("");
}
