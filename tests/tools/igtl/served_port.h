#pragma once

#include <string>

#include "tests/tools/command_line.h"

namespace orthonav::tools::igtl_test {

/// The port that a command reports; 0: none yet.
inline int served_port(const test::StartedCommand& command) {
  const std::string said = command.err_so_far();
  const std::string before = "OpenIGTLink at 127.0.0.1:";
  const std::size_t at = said.find(before);
  return at == std::string::npos || said.find('\n', at) == std::string::npos
             ? 0
             : std::stoi(said.substr(at + before.size()));
}

}  // namespace orthonav::tools::igtl_test
