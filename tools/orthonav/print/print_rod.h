#pragma once

#include "tools/orthonav/command.h"

namespace orthonav::tools {

/// `print rod`: the bending instructions of a rod on one page.
void add_print_rod(CLI::App& print, Action& action);

}  // namespace orthonav::tools
