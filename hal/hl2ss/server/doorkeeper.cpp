#include "hal/hl2ss/server/doorkeeper.h"

#include <algorithm>

#include "hal/hl2ss/door.h"

namespace orthonav::hl2ss {
namespace {

constexpr auto kTokenWithin = std::chrono::seconds(5);
constexpr auto kAdmittedFor = std::chrono::minutes(1);
constexpr std::size_t kLongestLine = 130;
constexpr std::size_t kMostGuests = 16;

}  // namespace

void Doorkeeper::step(HostTime now) {
  if (port_.has_client() && now - came_ > kTokenWithin) {
    port_.disconnect();
  }
}

bool Doorkeeper::admits(const net::Endpoint& peer, HostTime now) {
  std::erase_if(guests_, [&](const Guest& guest) { return guest.until < now; });
  const std::string address = text_of(peer);
  for (Guest& guest : guests_) {
    if (guest.address == address) {
      guest.until = now + kAdmittedFor;
      return true;
    }
  }
  return false;
}

Result<std::size_t> Doorkeeper::understand(Bytes said) {
  const auto end = std::find(said.begin(), said.end(), std::uint8_t{'\n'});
  const auto length = static_cast<std::size_t>(end - said.begin());
  if (end == said.end() && length <= kLongestLine) {
    return std::size_t{0};
  }
  if (!token_.is({reinterpret_cast<const char*>(said.data()), length})) {
    return Error{"not the token"};
  }
  const HostTime now = HostClock::now();
  const net::Endpoint peer = port_.peer();
  if (!admits(peer, now)) {
    if (guests_.size() == kMostGuests) {
      return Error{"too many addresses"};
    }
    guests_.push_back({text_of(peer), now + kAdmittedFor});
  }
  port_.send({{.bytes = {kWelcome.begin(), kWelcome.end()}, .close = true}});
  return length + 1;
}

}  // namespace orthonav::hl2ss
