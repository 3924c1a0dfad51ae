#include "tools/orthonav/shared/listening_place.h"

#include <utility>

#include "hal/net/host_port.h"

namespace orthonav::tools {

Result<ListeningPlace> listening_place(const std::string& option, const std::string& text) {
  const auto refused = [&](const std::string& why) {
    return Error{option + " \"" + text + "\": " + why +
                 "; must be PORT or ADDRESS:PORT, with a port from 0 to 65535"};
  };
  if (text.find(':') == std::string::npos) {
    const auto port = net::port_from("port", text, 0);
    return port ? Result(ListeningPlace{.port = *port}) : refused(port.error().message);
  }
  const auto place = net::host_and_port(text, 0);
  if (!place || !place->port) {
    return refused(place ? "names no port" : place.error().message);
  }
  return ListeningPlace{place->host, *place->port};
}

Result<net::Token> token_asked_for(const std::string& option, const std::string& file) {
  if (file.empty()) {
    return net::Token();
  }
  auto token = net::Token::of(file);
  return token ? std::move(token) : Error{option + " " + token.error().message, token.error().code};
}

}  // namespace orthonav::tools
