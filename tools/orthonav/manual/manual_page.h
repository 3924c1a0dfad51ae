#pragma once

#include <string>
#include <vector>

#include "tools/orthonav/command_page.h"

namespace orthonav::tools {

/// A file of section 1: "orthonav-case-make.1".
struct ManualPage {
  std::string file_name;
  std::string roff;
};

/// The pages of a command and all its subcommands. `release` goes into the footer of each page.
[[nodiscard]] std::vector<ManualPage> manual_pages(const CommandPage& page,
                                                   const std::string& release);

}  // namespace orthonav::tools
