#pragma once

#include <string>

#include "tools/command_page.h"

namespace orthonav::tools {

/// What `--help` prints, in lines of at most `width` columns.
[[nodiscard]] std::string help_text(const CommandPage& page, std::size_t width);

/// Columns of the terminal that standard output goes to, within 60 and 120; 100 where it is none.
[[nodiscard]] std::size_t output_width();

/// Makes every command print its help so.
void use_help_text(CLI::App& app);

}  // namespace orthonav::tools
