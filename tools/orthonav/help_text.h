#pragma once

#include <string>

#include "tools/orthonav/command_page.h"

namespace orthonav::tools {

/// What `--help` prints, in lines of at most `width` columns.
[[nodiscard]] std::string help_text(const CommandPage& page, std::size_t width);

/// Columns of the terminal on standard output, within 60 and 120; 100 if it is not a terminal.
[[nodiscard]] std::size_t output_width();

/// Makes every command print its help this way.
void use_help_text(CLI::App& app);

}  // namespace orthonav::tools
