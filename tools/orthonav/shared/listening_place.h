#pragma once

#include <string>

#include "base/result.h"
#include "hal/net/token.h"

namespace orthonav::tools {

/// Where a command serves something.
struct ListeningPlace {
  std::string host = "127.0.0.1";
  int port = 0;
};

/// From "PORT", which is for this machine only, or "ADDRESS:PORT", "[ADDRESS]:PORT". `option`, such
/// as "--web", begins an Error.
Result<ListeningPlace> listening_place(const std::string& option, const std::string& text);

/// The token in a file, which is made where there is none; without a file nobody is asked for one.
/// `option`, such as "--token", begins an Error.
Result<net::Token> token_asked_for(const std::string& option, const std::string& file);

}  // namespace orthonav::tools
