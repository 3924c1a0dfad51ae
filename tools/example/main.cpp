// Opens the simulated operating room, navigates one level and prints what guides the surgeon.
#include <cstdio>

#include "engine/frame_loop.h"
#include "engine/operation_plan.h"
#include "engine/phantom.h"
#include "engine/sim_scenario.h"
#include "engine/tool_file.h"

using namespace orthonav;
using namespace orthonav::engine;

struct Printer : LoopObserver {
  FrameLoop* loop = nullptr;
  int left = 10;
  void stepped(const StereoFrame& frame, const Inputs&, const Guidance& guidance) override {
    if (!guidance.tool || frame.sequence % 15 != 0) return;
    const nav::ScrewGuidance& screw = guidance.tool->measured;
    std::printf("%s: %.1f deg off the plan, tip %.1f mm from the entry\n",
                guidance.step_text.c_str(), screw.angle_rad * 57.2958, screw.tip_to_entry_m * 1e3);
    if (--left == 0) loop->stop();
  }
};

int main() {
  const Case spine = phantom();
  auto operation = plan_operation(spine, {"L4"});
  auto headset = open_headset("sim:?seed=3", {room_of(spine, *operation, built_in_tools()), {}});
  auto method = method_named("paper");
  auto tracker = method->create_tracker((*headset)->cameras().calibration(), built_in_tools(), {});
  auto session = Session::create(std::move(*operation), std::move(*tracker), method->registrar);
  SceneBuilder builder;
  FrameLoop loop(**headset, **session, builder, {});
  Printer printer;
  printer.loop = &loop;
  loop.observe(&printer);
  return loop.run().ok() && printer.left == 0 ? 0 : 1;
}
