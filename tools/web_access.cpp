#include "tools/web_access.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "base/file_code.h"
#include "hal/net/allowed.h"
#include "tools/listening_place.h"

namespace orthonav::tools {
namespace {

constexpr std::string_view kCookie = "orthonav_token=";
constexpr std::size_t kShortestToken = 16;
constexpr std::size_t kLongestToken = 128;

bool may_be_in_a_token(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '_';
}

/// 128 random bits from the system.
Result<std::string> token_at_random() {
  std::array<std::uint8_t, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    return Error{"the system gives no random numbers"};
  }
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string token;
  for (const std::uint8_t byte : bytes) {
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

/// At no moment is the file readable by others.
Status write_for_owner_alone(const std::string& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file < 0) {
    return Error{path + ": cannot be made (" + std::generic_category().message(errno) + ")",
                 file_code(errno)};
  }
  const bool written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (::close(file) != 0 || !written) {
    ::unlink(path.c_str());
    return Error{path + ": cannot be written", ErrorCode::kIo};
  }
  return {};
}

Result<std::string> token_of(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) {
    auto token = token_at_random();
    if (!token) {
      return token;
    }
    if (const Status written = write_for_owner_alone(path, *token + "\n"); !written) {
      return written.error();
    }
    return token;
  }
  if (!S_ISREG(found.st_mode)) {
    return Error{path + ": is no regular file"};
  }
  if ((found.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    return Error{path + ": others may read or write it; chmod 600 makes it yours alone"};
  }
  std::ifstream in(path, std::ios::binary);
  std::string token(kLongestToken + 2, '\0');
  in.read(token.data(), static_cast<std::streamsize>(token.size()));
  token.resize(static_cast<std::size_t>(in.gcount()));
  if (token.ends_with('\n')) {
    token.pop_back();
  }
  if (token.size() < kShortestToken || token.size() > kLongestToken ||
      !std::all_of(token.begin(), token.end(), may_be_in_a_token)) {
    return Error{path + ": must hold 16 to 128 letters, digits, '-' and '_' in one line"};
  }
  return token;
}

/// 0.0.0.0 and :: are addresses to listen on, not to connect to.
std::string name_for_browsers(const std::string& host, const net::Endpoint& address) {
  std::array<char, 256> name{};
  const std::string numbers = net::text_of(address);
  if ((numbers == "0.0.0.0" || numbers == "::") &&
      ::gethostname(name.data(), name.size() - 1) == 0) {
    return name.data();
  }
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
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
  if (!token_file.empty()) {
    auto token = token_of(token_file);
    if (!token) {
      return Error{"--token " + token.error().message, token.error().code};
    }
    access.token_ = std::move(*token);
  }
  return access;
}

std::string WebAccess::url(int port) const {
  return "http://" + seen_as_ + ":" + std::to_string(port) + "/" +
         (token_.empty() ? "" : "?token=" + token_);
}

bool WebAccess::is_token(std::string_view text) const {
  if (token_.empty() || text.size() != token_.size()) {
    return false;
  }
  unsigned differs = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    differs |= static_cast<unsigned char>(text[i]) ^ static_cast<unsigned char>(token_[i]);
  }
  return differs == 0;
}

bool WebAccess::lets_in(std::string_view host, std::string_view cookies) const {
  if (token_.empty()) {
    const std::string_view name = host.substr(0, host.rfind(':'));
    return name == "127.0.0.1" || name == "localhost";
  }
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    std::string_view cookie = cookies.substr(0, end);
    cookie.remove_prefix(std::min(cookie.find_first_not_of(' '), cookie.size()));
    if (cookie.starts_with(kCookie) && is_token(cookie.substr(kCookie.size()))) {
      return true;
    }
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
  }
  return false;
}

std::string WebAccess::cookie() const {
  return std::string(kCookie) + token_ + "; Path=/; HttpOnly; SameSite=Strict";
}

}  // namespace orthonav::tools
