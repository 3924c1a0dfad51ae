#include <map>
#include <memory>
#include <string>

#include "tools/orthonav/command.h"
#include "tools/orthonav/config/config_file.h"
#include "tools/orthonav/run/live_run.h"
#include "tools/orthonav/shared/arguments.h"

namespace orthonav::tools {
namespace {

/// Options for when the run ends and what it leaves.
void add_ends_and_results(CLI::App& run, RunArguments& arguments) {
  run.add_option("--frames", arguments.frames, "end after so many displayed frames (0: no limit)")
      ->check(whole_number(0));
  run.add_option("--for", arguments.for_s, "end after so long, as in 60s or 5min")
      ->transform(CLI::Validator(CLI::AsNumberWithUnit(
                                     std::map<std::string, double>{{"s", 1.0}, {"min", 60.0}},
                                     CLI::AsNumberWithUnit::UNIT_REQUIRED, "TIME"))
                      .description("TIME"))
      ->check(finite_number(0.1, 86400.0));
  run.add_option("--record", arguments.record, "record the session into this new folder")
      ->check(some_text());
  run.add_option("-o,--out", arguments.out,
                 "folder for report.html, report.json and operation.resume")
      ->check(some_text());
  run.add_flag("--resume", arguments.resume,
               "continue the last operation in that folder (docs/journal.md)")
      ->needs("--out");
  run.add_flag("--stats", arguments.stats,
               "print frame intervals, ages from capture to photon and tracking times");
  run.add_flag("--json", arguments.json, "print the report as JSON");
}

}  // namespace

void add_run_command(CLI::App& app, Action& action, StopSignals& signals) {
  auto arguments = std::make_shared<RunArguments>();
  auto* run = app.add_subcommand("run", "An operation with a headset, simulated or recorded");
  run->add_option("--headset", arguments->headset,
                  "URI: sim:, replay:PATH, hl2ss://HOST, openxr:+URI, igtl://HOST")
      ->check(some_text())
      ->type_name("URI|sim:|replay:|hl2ss://|openxr:|igtl://")
      ->capture_default_str();
  run->add_option("--clicker", arguments->clicker,
                  "headset, none, evdev:[PATH|NAME] or keyboard:[NAME] (docs/headsets.md)")
      ->check(some_text())
      ->type_name("DEVICE|headset|none|evdev:|keyboard:")
      ->capture_default_str();
  run->add_option("--voice", arguments->voice,
                  "headset, none, mic:[NAME], headset-mic: or wav:FILE (docs/voice.md)")
      ->check(some_text())
      ->type_name("DEVICE|headset|none|mic:|headset-mic:|wav:")
      ->capture_default_str();
  add_case_option(*run, arguments->case_folder);
  arguments->set_up.add_to(*run);
  arguments->rods.add_to(*run, *add_levels_option(*run, arguments->levels));
  add_tools_option(*run, arguments->tools_file);
  arguments->common.add_to(
      *run, {"assumed to be 0.4", "assumed to be 0.46, of a tracker 0.25; docs/headsets.md",
             "assumed to be 0.11 mm/sqrt(s); with --reference none"});
  arguments->screws.add_to(*run);
  arguments->onlookers.add_to(*run);
  arguments->calibration.add_to(*run);
  arguments->limits.add_to(*run);
  arguments->wearer.add_to(*run);
  add_ends_and_results(*run, *arguments);
  add_config_option(*run);
  run->callback([arguments, &action, &signals] {
    action = [arguments, &signals] {
      const Status spoken = arguments->wearer.use();
      return spoken ? run_live(*arguments, signals) : bad_input(spoken.error().message);
    };
  });
}

}  // namespace orthonav::tools
