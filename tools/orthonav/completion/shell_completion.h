#pragma once

#include <string>

#include "tools/orthonav/command_page.h"

namespace orthonav::tools {

/// The bash completion of a command and all its subcommands; zsh reads it with `bashcompinit`.
[[nodiscard]] std::string bash_completion(const CommandPage& page);

}  // namespace orthonav::tools
