#pragma once

#include <string>

#include "tools/command_page.h"

namespace orthonav::tools {

/// What bash completes of a command and all below it; zsh reads the same with `bashcompinit`.
[[nodiscard]] std::string bash_completion(const CommandPage& page);

}  // namespace orthonav::tools
