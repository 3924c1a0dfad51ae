#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "base/how_many.h"
#include "hal/replay/repair.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/json_output.h"

namespace orthonav::tools {
namespace {

struct RepairArguments {
  std::string recording;
  JsonOutput json;
};

int repair(const RepairArguments& arguments) {
  if (const Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  const auto report = replay::repair_recording(arguments.recording);
  if (!report) {
    return bad_input(report.error().message);
  }
  const std::string name = report->folder.string();
  const nlohmann::ordered_json out = {
      {"recording", name}, {"pairs", report->pairs}, {"cut", report->cut}};
  if (const Status s = arguments.json.write(out); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    std::printf("%s: %s; %s\n", name.c_str(), how_many(report->pairs, "pair").c_str(),
                report->cut.empty() ? "was whole" : ("closed: " + report->cut).c_str());
  }
  return kDone;
}

}  // namespace

void add_recording_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RepairArguments>();
  CLI::App* recording = app.add_subcommand("recording", "Recordings: repair");
  recording->require_subcommand(1);
  CLI::App* command = recording->add_subcommand(
      "repair", "Closes a recording that was cut off, at its last whole pair");
  command
      ->add_option("RECORDING", arguments->recording,
                   "Folder of the recording; NAME.part gets its name NAME")
      ->required();
  arguments->json.add_to(*command);
  command->callback([arguments, &action] { action = [arguments] { return repair(*arguments); }; });
}

}  // namespace orthonav::tools
