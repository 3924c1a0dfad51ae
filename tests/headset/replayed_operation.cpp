// orthonav_replayed RECORDING POSES: runs a recorded operation on the lowest level of the built-in
// phantom again, with nothing drawn. Writes report.json to standard output, and into the file POSES
// a line for each tool of each pair: the pair's time, the step, how the pose is known, and
// world_from_marker by rows, in metres. Ends with 1 and a line where it cannot.
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <string>
#include <utility>

#include "base/pose_status_name.h"
#include "engine/case/operation_plan.h"
#include "engine/live/assembled_operation.h"
#include "engine/live/known_tools.h"
#include "engine/phantom/phantom.h"
#include "engine/report/operation_result.h"
#include "hal/replay/replay_headset.h"

namespace orthonav::engine {
namespace {

class PoseWriter : public LoopObserver {
 public:
  PoseWriter(const Session& session, std::ostream& out) : session_(session), out_(out) {
    out_ << std::setprecision(17);
  }
  void stepped(const FrameHeader& frame, const Inputs&, const Guidance& guidance) override {
    for (const nav::ToolState& tool : session_.tool_states()) {
      out_ << frame.time.time_since_epoch().count() << ',' << name_of(guidance.status.at) << ','
           << name_of(tool.world_from_marker.status);
      for (const double value : tool.world_from_marker.value.row_major()) {
        out_ << ',' << value;
      }
      out_ << '\n';
    }
  }

 private:
  const Session& session_;
  std::ostream& out_;
};

Result<std::string> replayed(const char* recording, std::ostream& poses) {
  auto headset = replay::ReplayHeadset::open(recording);
  if (!headset) {
    return headset.error();
  }
  const Case spine = phantom();
  auto plan = plan_operation(spine, {"L5"});
  if (!plan) {
    return plan.error();
  }
  auto tools = tools_known_to(**headset);
  if (!tools) {
    return tools.error();
  }
  auto method = method_named("best");
  if (!method) {
    return method.error();
  }
  AssemblyOptions options;
  options.loop.draw_every = 0;
  auto operation = assemble_operation(**headset, *std::move(plan), *method, *tools, options);
  if (!operation) {
    return operation.error();
  }
  PoseWriter writer((*operation)->session(), poses);
  (*operation)->observe(&writer);
  auto report = (*operation)->run();
  if (!report.ended) {
    return report.ended.error();
  }
  return report_json(result_of((*operation)->session().operation(), report));
}

}  // namespace
}  // namespace orthonav::engine

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: orthonav_replayed RECORDING POSES\n");
    return 2;
  }
  std::ofstream poses(argv[2]);
  const auto report = orthonav::engine::replayed(argv[1], poses);
  if (!report || !poses.flush()) {
    std::fprintf(stderr, "%s\n",
                 report ? "the file of poses cannot be written" : report.error().message.c_str());
    return 1;
  }
  std::fputs(report->c_str(), stdout);
  return 0;
}
