#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace orthonav::tools {

/// Exit codes of every subcommand: the answer is yes / the answer is no / the input is bad.
inline constexpr int kDone = 0;
inline constexpr int kNo = 1;
inline constexpr int kBadInput = 2;

/// What main runs once the command line is parsed; a subcommand's callback sets it.
using Action = std::function<int()>;

class StopSignals;

/// One line on standard error, then the exit code for bad input.
int bad_input(const std::string& message);

// Each adds its subcommand to `app`; one file per subcommand. Those that take the signals finish
// their current work when asked to stop; the others end at once.
void add_calibrate_command(CLI::App& app, Action& action);
void add_accuracy_command(CLI::App& app, Action& action);
void add_case_command(CLI::App& app, Action& action);
void add_completion_command(CLI::App& app, Action& action);
void add_config_command(CLI::App& app, Action& action);
void add_demo_command(CLI::App& app, Action& action, StopSignals& signals);
void add_depth_command(CLI::App& app, Action& action);
void add_detect_command(CLI::App& app, Action& action);
void add_doctor_command(CLI::App& app, Action& action);
void add_evaluate_command(CLI::App& app, Action& action);
void add_golden_command(CLI::App& app, Action& action);
void add_manual_command(CLI::App& app, Action& action);
void add_plan_command(CLI::App& app, Action& action, StopSignals& signals);
void add_preview_command(CLI::App& app, Action& action, StopSignals& signals);
void add_print_command(CLI::App& app, Action& action);
void add_render_command(CLI::App& app, Action& action);
void add_recording_command(CLI::App& app, Action& action);
void add_register_command(CLI::App& app, Action& action);
void add_report_command(CLI::App& app, Action& action);
void add_rod_command(CLI::App& app, Action& action);
void add_run_command(CLI::App& app, Action& action, StopSignals& signals);
void add_sample_command(CLI::App& app, Action& action);
void add_serve_hl2ss_command(CLI::App& app, Action& action, StopSignals& signals);
void add_study_command(CLI::App& app, Action& action, StopSignals& signals);
void add_track_command(CLI::App& app, Action& action);

}  // namespace orthonav::tools
