#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/printed.h"
#include "engine/case/tool_file.h"
#include "engine/print/board_file.h"
#include "nav/evaluation/tip_accuracy.h"
#include "tools/orthonav/accuracy/accuracy_output.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/json_output.h"
#include "tools/orthonav/shared/other_poses.h"

namespace orthonav::tools {
namespace {

// Whole images are searched only in every other pair, and only while the pointer is not seen.
constexpr int kFullSearchEvery = 2;

/// Limits of one figure on the command line, in millimetres: up to the first it passes, up to the
/// second it is noted.
struct LimitArgument {
  const char* option;
  const char* what;
  nav::AccuracyLimits nav::AccuracyOptions::*limits;
  std::vector<double> mm;
};

struct AccuracyArguments {
  std::string recording;
  std::string tools_file;
  std::string pointer;
  std::string board_file;
  std::string method = default_method();
  OtherPosesArguments other;
  JsonOutput json;
  std::vector<LimitArgument> limits = {
      {"--single-point-mm",
       "Of 95 % of the tips, held still",
       &nav::AccuracyOptions::single_point_p95,
       {}},
      {"--turning-mm", "Of 95 % of the tips, turning", &nav::AccuracyOptions::turning_p95, {}},
      {"--tip-bias-mm",
       "Of the tip from where the tool file has it",
       &nav::AccuracyOptions::tip_bias,
       {}},
      {"--distance-mean-mm",
       "Of the mean error of the distances",
       &nav::AccuracyOptions::distance_mean,
       {}},
      {"--distance-max-mm",
       "Of the largest error of a distance",
       &nav::AccuracyOptions::distance_max,
       {}}};
};

Result<nav::ToolGeometry> chosen_pointer(const AccuracyArguments& arguments) {
  const std::string& file = arguments.tools_file;
  const auto tools =
      engine::load_tools(file, has_other_poses(arguments.recording) ? engine::ToolTags::kOptional
                                                                    : engine::ToolTags::kNeeded);
  if (!tools) {
    return tools.error();
  }
  if (arguments.pointer.empty()) {
    for (const nav::ToolGeometry& tool : *tools) {
      if (tool.role == nav::ToolRole::kPointer) {
        return tool;
      }
    }
    return Error{file + ": no tool has the role pointer, name one (--pointer)"};
  }
  const auto tool = engine::tool_named(*tools, arguments.pointer);
  if (!tool) {
    return Error{file + ": " + tool.error().message};
  }
  if (tool->role == nav::ToolRole::kReference) {
    return Error{file + ": '" + tool->name + "' is a reference, it has no tip"};
  }
  return *tool;
}

Result<std::vector<Vec3>> board_points_m(const AccuracyArguments& arguments) {
  std::vector<Vec3> points_m;
  if (arguments.board_file.empty()) {
    return points_m;
  }
  const auto board = engine::load_board(arguments.board_file);
  if (!board) {
    return board.error();
  }
  for (const engine::TouchPoint& point : engine::touch_points(*board)) {
    points_m.push_back({point.at_m.x, point.at_m.y, 0.0});
  }
  return points_m;
}

nav::AccuracyOptions options_of(const AccuracyArguments& arguments) {
  nav::AccuracyOptions options;
  for (const LimitArgument& limit : arguments.limits) {
    if (limit.mm.size() == 2) {
      options.*limit.limits = {limit.mm[0] * 1e-3, limit.mm[1] * 1e-3};
    }
  }
  return options;
}

Result<MeasuredPoses> poses_of(const AccuracyArguments& arguments,
                               const nav::ToolGeometry& pointer) {
  if (!has_other_poses(arguments.recording)) {
    nav::TrackerOptions tracking;
    // Where a tag is predicted it is found as reliably as in the whole image, in a tenth of the
    // time.
    tracking.full_search_interval = kFullSearchEvery;
    return measured_poses(arguments.recording, arguments.method, pointer, tracking);
  }
  auto poses = other_poses(arguments.recording, arguments.other, pointer);
  if (poses && !poses->timed) {
    return Error{arguments.recording +
                 ": states no times, which this test needs: give the rate of "
                 "its rows (--rate-hz)"};
  }
  return poses;
}

int run_accuracy(const AccuracyArguments& arguments) {
  if (const Status s = arguments.json.check(); !s) {
    return bad_input(s.error().message);
  }
  const nav::AccuracyOptions options = options_of(arguments);
  if (const auto problems = options.check(); !problems.empty()) {
    return bad_input(problems.front());
  }
  const auto pointer = chosen_pointer(arguments);
  if (!pointer) {
    return bad_input(pointer.error().message);
  }
  const auto points_m = board_points_m(arguments);
  if (!points_m) {
    return bad_input(points_m.error().message);
  }
  const auto seen = poses_of(arguments, *pointer);
  if (!seen) {
    return bad_input(seen.error().message);
  }
  const auto report = nav::test_tip_accuracy(seen->world_from_marker, *pointer, *points_m, options);
  if (!report) {
    return bad_input(arguments.recording + ": " + report.error().message);
  }

  const AccuracySubject subject{pointer->name, arguments.method, seen->format};
  if (Status s = arguments.json.write(accuracy_json(subject, *report)); !s) {
    return bad_input(s.error().message);
  }
  if (!arguments.json.on_stdout()) {
    std::fputs(accuracy_text(subject, *report).c_str(), stdout);
  }
  return report->verdict() == nav::Verdict::kFail ? kNo : kDone;
}

constexpr const char* kAccuracyFooter =
    "\nRecord a minute: rest the tip in a dimple and hold the pointer still (5 s), turn and tilt "
    "it\n"
    "there by 25 degrees to all sides (15 s), then touch the numbered corners of a board from\n"
    "`orthonav print board` in their order, a second each, at least 5 cm from the dimple.\n"
    "A figure passes up to PASS, is noted up to NOTE, fails beyond. Exit 0: pass or note; 1: "
    "fail;\n"
    "2: too few data or bad input.";

}  // namespace

void add_accuracy_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<AccuracyArguments>();
  CLI::App* command = app.add_subcommand(
      "accuracy", "The one-minute accuracy test of a pointer, in the spirit of ASTM F2554");
  command
      ->add_option("RECORDING", arguments->recording,
                   "Folder of a StreamRecorder recording, a file of poses, or igtl://")
      ->required();
  command->add_option("-t,--tools", arguments->tools_file, "Tool definitions (JSON)")->required();
  command->add_option("--pointer", arguments->pointer, "Name of the tool (default: pointer)")
      ->check(some_text());
  command
      ->add_option("--board", arguments->board_file,
                   "Description of the board that was touched (default: no distances)")
      ->check(some_text());
  add_method_option(*command, arguments->method, "Tracking");
  const nav::AccuracyOptions defaults;
  for (LimitArgument& limit : arguments->limits) {
    const nav::AccuracyLimits& given = defaults.*limit.limits;
    command
        ->add_option(
            limit.option, limit.mm,
            printed("%s (default: %g %g)", limit.what, given.pass_m * 1e3, given.note_m * 1e3))
        ->expected(2)
        ->type_name("PASS NOTE")
        ->check(finite_number(0.001, 100));
  }
  arguments->other.add_to(*command);
  arguments->json.add_to(*command);
  command->footer(std::string(kAccuracyFooter) + kOtherPosesFooter);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_accuracy(*arguments); }; });
}

}  // namespace orthonav::tools
