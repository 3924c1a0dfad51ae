#include "tools/listening_place.h"

#include <charconv>
#include <utility>

namespace orthonav::tools {

Result<ListeningPlace> listening_place(const std::string& option, const std::string& text) {
  constexpr int kMostPort = 65535;
  ListeningPlace place;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) {
    place.host = text.substr(0, colon);
  }
  const std::string port = colon == std::string::npos ? text : text.substr(colon + 1);
  const char* const last = port.data() + port.size();
  const auto [end, problem] = std::from_chars(port.data(), last, place.port);
  if (problem != std::errc() || end != last || place.port < 0 || place.port > kMostPort ||
      place.host.empty()) {
    return Error{option + " \"" + text +
                 "\": must be PORT or ADDRESS:PORT, with a port from 0 to 65535"};
  }
  return place;
}

Result<net::Token> token_asked_for(const std::string& option, const std::string& file) {
  if (file.empty()) {
    return net::Token();
  }
  auto token = net::Token::of(file);
  return token ? std::move(token) : Error{option + " " + token.error().message, token.error().code};
}

}  // namespace orthonav::tools
