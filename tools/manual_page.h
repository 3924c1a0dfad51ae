#pragma once

#include <string>
#include <vector>

#include "tools/command_page.h"

namespace orthonav::tools {

/// A file of section 1: "orthonav-case-make.1".
struct ManualPage {
  std::string file_name;
  std::string roff;
};

/// Of a command and all below it. `release` is what the foot of each page says.
[[nodiscard]] std::vector<ManualPage> manual_pages(const CommandPage& page,
                                                   const std::string& release);

}  // namespace orthonav::tools
