#pragma once

#include "tools/orthonav/command.h"

namespace orthonav::tools {

/// `study compare`: two studies over the same cases and seeds, pair by pair.
void add_compare_command(CLI::App& study, Action& action);

}  // namespace orthonav::tools
