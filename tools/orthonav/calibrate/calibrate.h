#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "nav/statistics/verdict.h"
#include "tools/orthonav/command.h"

namespace orthonav::tools {

// The parts of `calibrate`, one file each.
void add_calibrate_axis(CLI::App& calibrate, Action& action);
void add_calibrate_pivot(CLI::App& calibrate, Action& action);
void add_calibrate_stereo(CLI::App& calibrate, Action& action);
void add_calibrate_tool(CLI::App& calibrate, Action& action);

/// Adds the verdict and its reasons to JSON output.
void add_judgement(const nav::Judgement& judgement, nlohmann::ordered_json& out);
/// Prints one line: "pass: every figure is within its limit".
void print_judgement(const nav::Judgement& judgement);
/// Prints on standard error why there is no result; returns the exit code for "no".
int refused(const std::string& reason);

}  // namespace orthonav::tools
