#include "tools/orthonav/dashboard/web_access.h"

#include <unistd.h>

#include <algorithm>
#include <array>

#include "hal/net/allowed.h"
#include "hal/net/host_port.h"
#include "tools/orthonav/shared/listening_place.h"

namespace orthonav::tools {
namespace {

constexpr std::string_view kCookie = "orthonav_token=";

/// 0.0.0.0 and :: are addresses to listen on, not to connect to.
std::string name_for_browsers(const std::string& host, const net::Endpoint& address) {
  std::array<char, 256> name{};
  const std::string numbers = net::text_of(address);
  if ((numbers == "0.0.0.0" || numbers == "::") &&
      ::gethostname(name.data(), name.size() - 1) == 0) {
    return name.data();
  }
  return net::before_port(host);
}

}  // namespace

Result<WebAccess> WebAccess::of(const std::string& at, const std::string& token_file) {
  WebAccess access;
  const auto place = listening_place("--web", at);
  if (!place) {
    return place.error();
  }
  access.host_ = place->host;
  access.port_ = place->port;
  const auto address = net::resolve(access.host_);
  if (!address) {
    return Error{"--web \"" + at + "\": " + address.error().message, address.error().code};
  }
  if (token_file.empty() && !net::is_loopback(*address)) {
    return Error{"--web \"" + at + "\": other machines reach this address: needs --token FILE"};
  }
  access.seen_as_ = name_for_browsers(access.host_, *address);
  auto token = token_asked_for("--token", token_file);
  if (!token) {
    return token.error();
  }
  access.token_ = std::move(*token);
  return access;
}

std::string WebAccess::url(int port) const {
  return "http://" + seen_as_ + ":" + std::to_string(port) + "/" +
         (token_.is_asked_for() ? "?token=" + token_.text() : "");
}

bool WebAccess::lets_in(std::string_view host, std::string_view cookies) const {
  if (!token_.is_asked_for()) {
    const auto asked = net::host_and_port(host);
    return asked &&
           (asked->host == "127.0.0.1" || asked->host == "localhost" || asked->host == "::1");
  }
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    std::string_view cookie = cookies.substr(0, end);
    cookie.remove_prefix(std::min(cookie.find_first_not_of(' '), cookie.size()));
    if (cookie.starts_with(kCookie) && token_.is(cookie.substr(kCookie.size()))) {
      return true;
    }
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
  }
  return false;
}

std::string WebAccess::cookie() const {
  return std::string(kCookie) + token_.text() + "; Path=/; HttpOnly; SameSite=Strict";
}

}  // namespace orthonav::tools
