#include "tools/orthonav/demo/demo_arguments.h"

#include "engine/case/tool_file.h"
#include "tools/orthonav/config/config_file.h"

namespace orthonav::tools {
namespace {

/// Every n-th displayed frame becomes a picture while a screw is guided, a third of them otherwise:
/// ten minutes make a film of half a minute, at least a third of it guiding.
constexpr int kDrawEvery = 15;
constexpr int kUnguidedEvery = 3;

}  // namespace

Result<engine::OperationOptions> options_of(const DemoArguments& arguments) {
  engine::OperationOptions options;
  const engine::SetUp set_up = arguments.set_up.chosen();
  options.method = set_up.method;
  options.levels = arguments.levels;
  options.rods_alone = arguments.rods.rods_only;
  options.session.head_to_seat_m = arguments.rods.seat_mm * 1e-3;
  options.tools = engine::built_in_tools();
  options.use_reference = set_up.reference;
  options.sim.seed = arguments.seed;
  if (Status told = set_up.tell(options.sim); !told) {
    return Error{"--instrument: " + told.error().message};
  }
  if (arguments.perfect) {
    options.sim.error_model = sim::ErrorModel::perfect();
  }
  if (arguments.pace) {
    options.sim.error_model.pace = *arguments.pace;
  }
  options.sim.pace = arguments.realtime ? sim::Pace::kRealtime : sim::Pace::kFast;
  arguments.limits.set_in(options);
  options.tracker.parallel = arguments.threads > 1;
  options.loop.draw_every = kDrawEvery;
  // In real time it costs nothing, and the dashboard's view is to follow.
  options.loop.unguided_every = arguments.realtime ? 1 : kUnguidedEvery;
  options.loop.real_time = arguments.realtime;
  options.record_folder = arguments.record;
  return options;
}

KeptOperation::About about_demo(const DemoArguments& arguments, const std::string& case_name) {
  KeptOperation::About about;
  about.case_name = case_name;
  const engine::SetUp set_up = arguments.set_up.chosen();
  about.method = set_up.method;
  about.patient_reference = set_up.reference;
  about.device = "sim:";
  about.seed = arguments.seed;
  about.replaces_earlier = true;
  return about;
}

void add_demo_arguments(CLI::App& demo, DemoArguments& arguments) {
  add_case_option(demo, arguments.case_folder);
  arguments.set_up.add_to(demo);
  demo.add_option("-s,--seed", arguments.seed, "seed of every random number")
      ->check(seed_number())
      ->capture_default_str();
  demo.add_option("-o,--out", arguments.out, "folder of the results")
      ->check(some_text())
      ->capture_default_str();
  arguments.rods.add_to(demo, *add_levels_option(demo, arguments.levels));
  auto* fast =
      demo.add_flag("--fast", arguments.fast, "as fast as the machine goes, unless --realtime");
  demo.add_flag("--realtime", arguments.realtime, "30 frames a second")->excludes(fast);
  demo.add_option("--record", arguments.record, "also record the session into this new folder")
      ->check(some_text());
  demo.add_option("--beside", arguments.beside,
                  "folder of another demo's results, as of --as-published: the report sets its "
                  "figures beside its own")
      ->check(some_text());
  demo.add_option("--device", arguments.device, "part of the name of the Vulkan device");
  demo.add_option("--threads", arguments.threads, "threads of the tracker; no result depends on it")
      ->check(whole_number(1, 2))
      ->capture_default_str();
  demo.add_flag("--resume", arguments.resume,
                "continue the last operation in the folder of the results (docs/journal.md)");
  demo.add_flag("--no-video", arguments.no_video, "write no operation.mp4");
  demo.add_flag("--perfect", arguments.perfect, "every source of error at zero");
  arguments.onlookers.add_to(demo);
  arguments.calibration.add_to(demo);
  arguments.limits.add_to(demo);
  arguments.wearer.add_to(demo);
  add_config_option(demo);
  demo.add_option("--pace", arguments.pace, "how many times as fast the surgeon works (default: 1)")
      ->check(finite_number(0.5, 4));
  demo.add_flag("--json", arguments.json, "print the report as JSON");
}

}  // namespace orthonav::tools
