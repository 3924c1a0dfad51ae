#include "hal/net/token.h"

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
#include <utility>

#include "base/file_code.h"

namespace orthonav::net {
namespace {

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

Result<std::string> made_at(const std::string& path) {
  auto token = token_at_random();
  if (!token) {
    return token;
  }
  if (const Status written = write_for_owner_alone(path, *token + "\n"); !written) {
    return written.error();
  }
  return token;
}

Result<std::string> read_from(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) {
    return Error{path + ": cannot be read (" + std::generic_category().message(errno) + ")",
                 file_code(errno)};
  }
  if (!S_ISREG(found.st_mode)) {
    return Error{path + ": is not a regular file"};
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

}  // namespace

Result<Token> Token::of(const std::string& path) {
  struct stat found {};
  auto text = ::stat(path.c_str(), &found) == 0 ? read_from(path) : made_at(path);
  return text ? Result<Token>(Token(*std::move(text))) : text.error();
}

bool Token::is(std::string_view text) const {
  if (text_.empty() || text.size() != text_.size()) {
    return false;
  }
  unsigned differs = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    differs |= static_cast<unsigned char>(text[i]) ^ static_cast<unsigned char>(text_[i]);
  }
  return differs == 0;
}

}  // namespace orthonav::net
