#pragma once

#include "tools/orthonav/command.h"

namespace orthonav::tools {

/// `study rods`: rods bent with the template compared with rods bent by eye.
void add_rods_command(CLI::App& study, Action& action);

}  // namespace orthonav::tools
