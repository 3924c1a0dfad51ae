#pragma once

#include <string>

#include "base/result.h"

namespace orthonav::tools {

/// Where a command serves something.
struct ListeningPlace {
  std::string host = "127.0.0.1";
  int port = 0;
};

/// From "PORT", which is of this machine alone, or "ADDRESS:PORT". `option` stands in front of an
/// Error, as in "--web".
Result<ListeningPlace> listening_place(const std::string& option, const std::string& text);

}  // namespace orthonav::tools
