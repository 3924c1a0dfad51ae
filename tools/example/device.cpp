// Gives orthonav a device from outside, opens it by its URI and runs an operation on it.
//   device [URI]      skeleton:30, or any other that orthonav knows
#include <orthonav/engine/case/operation_plan.h>
#include <orthonav/engine/case/tool_file.h>
#include <orthonav/engine/live/assembled_operation.h>
#include <orthonav/engine/phantom/phantom.h>
#include <orthonav/hal/open/open.h>

#include "must.h"
#include "skeleton_device.h"

using namespace orthonav;

int main(int argc, char** argv) {
  must(register_scheme({"skeleton", "skeleton:PAIRS", nullptr, mine::open_skeleton}));
  const auto headset = must(open_headset(argc > 1 ? argv[1] : "skeleton:30"));
  auto operation = must(engine::plan_operation(engine::phantom(), {"L4"}));
  const auto assembled = must(engine::assemble_operation(*headset, std::move(operation),
                                                         must(engine::method_named("best")),
                                                         engine::built_in_tools()));
  const engine::LoopReport report = assembled->run();
  std::printf("%s: %lld frames shown\n", headset->name().c_str(),
              static_cast<long long>(report.displayed));
  must(report.ended);
}
