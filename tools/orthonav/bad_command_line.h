#pragma once

#include <CLI/App.hpp>

namespace orthonav::tools {

/// Prints in one line what is wrong with the command line and what was probably meant; returns the
/// exit code for bad input.
int bad_command_line(const CLI::App& app, const CLI::ParseError& error);

}  // namespace orthonav::tools
