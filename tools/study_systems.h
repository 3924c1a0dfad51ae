#pragma once

#include "tools/command.h"

namespace orthonav::tools {

/// `study systems`: the simulated room's predictions for published systems, as a table.
void add_systems_command(CLI::App& study, Action& action);

}  // namespace orthonav::tools
