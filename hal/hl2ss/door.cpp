#include "hal/hl2ss/door.h"

#include <algorithm>

#include "hal/net/token.h"

namespace orthonav::hl2ss {
namespace {

/// A wrong token is answered by hanging up at once.
constexpr auto kAnswerWithin = std::chrono::seconds(1);

}  // namespace

Status open_door(const net::Endpoint& host, const Hl2ssOptions& options, HostTime deadline) {
  if (options.token_file.empty()) {
    return {};
  }
  const auto token = net::Token::existing(options.token_file);
  if (!token) {
    return Error{"token " + token.error().message, token.error().code};
  }
  const std::string line = token->text() + "\n";
  const auto answer = ask(host, options.first_port + kDoorOffset,
                          Bytes(reinterpret_cast<const std::uint8_t*>(line.data()), line.size()),
                          kWelcome.size(), std::min(deadline, HostClock::now() + kAnswerWithin));
  if (!answer) {
    return Error{"the token of " + options.token_file + " is not taken: " + answer.error().message,
                 answer.error().code};
  }
  return {};
}

}  // namespace orthonav::hl2ss
