#pragma once

#include "tools/command.h"

namespace orthonav::tools {

/// `study sensitivity`: which magnitude of the room decides entry and angle.
void add_sensitivity_command(CLI::App& study, Action& action);

}  // namespace orthonav::tools
