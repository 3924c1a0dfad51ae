#include "hal/net/host_port.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>

namespace orthonav::net {
namespace {

bool is_address(int family, const std::string& text) {
  in6_addr parsed{};
  return ::inet_pton(family, text.c_str(), &parsed) == 1;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_of_a_name(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_' ||
         c == '.';
}

/// Refuses what the resolver would take for an address that nobody meant: it reads "18944" as
/// 0.0.74.0 and "10.5" as 10.0.0.5.
Status check_host(const std::string& host) {
  if (host.empty()) {
    return Error{"names no host"};
  }
  if (!std::all_of(host.begin(), host.end(), is_of_a_name)) {
    return Error{"host \"" + host + "\" must be a name or an address"};
  }
  const std::string last = host.substr(host.rfind('.') + 1);
  const bool number = !last.empty() && (std::all_of(last.begin(), last.end(), is_digit) ||
                                        last.starts_with("0x") || last.starts_with("0X"));
  if (number && !is_address(AF_INET, host)) {
    return Error{"host \"" + host + "\" must be a name, or four numbers as in 127.0.0.1"};
  }
  return {};
}

}  // namespace

Result<HostPort> host_and_port(std::string_view text, int least_port) {
  HostPort out;
  std::optional<std::string_view> port;
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    out.host = text.substr(1, end == text.npos ? end : end - 1);
    // The name of an interface may follow, as in fe80::1%eth0.
    if (end == text.npos || !is_address(AF_INET6, out.host.substr(0, out.host.find('%')))) {
      return Error{"\"" + std::string(text) +
                   "\" must hold an address of version 6 in brackets, as in [::1]"};
    }
    if (const std::string_view rest = text.substr(end + 1); rest.starts_with(':')) {
      port = rest.substr(1);
    } else if (!rest.empty()) {
      return Error{"\"" + std::string(rest) + "\" after " + std::string(text.substr(0, end + 1)) +
                   " must be a colon and a port"};
    }
  } else {
    const std::size_t colon = text.find(':');
    if (colon != text.npos && text.find(':', colon + 1) != text.npos) {
      return Error{"\"" + std::string(text) +
                   "\" holds several colons: an address of version 6 is written in brackets, as in "
                   "[::1] or [::1]:18944"};
    }
    out.host = text.substr(0, colon);
    if (colon != text.npos) {
      port = text.substr(colon + 1);
    }
    if (const Status good = check_host(out.host); !good) {
      return good.error();
    }
  }
  if (port) {
    const auto number = port_from("port", *port, least_port);
    if (!number) {
      return number.error();
    }
    out.port = *number;
  }
  return out;
}

Result<int> port_from(std::string_view what, std::string_view text, int least, int most) {
  int port = 0;
  const char* const last = text.data() + text.size();
  const auto [end, problem] = std::from_chars(text.data(), last, port);
  if (problem != std::errc() || end != last || port < least || port > most) {
    return Error{std::string(what) + " \"" + std::string(text) + "\" must be a whole number from " +
                 std::to_string(least) + " to " + std::to_string(most)};
  }
  return port;
}

std::string before_port(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

}  // namespace orthonav::net
