#pragma once

#include "tools/command.h"

namespace orthonav::tools {

/// `study systems`: what the simulated room predicts of published systems, as a table.
void add_systems_command(CLI::App& study, Action& action);

}  // namespace orthonav::tools
