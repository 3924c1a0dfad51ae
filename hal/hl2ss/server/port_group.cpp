#include "hal/hl2ss/server/port_group.h"

#include "hal/hl2ss/door.h"

namespace orthonav::hl2ss {
namespace {

constexpr int kTurnMs = 5;
constexpr int kFirstFreePort = 20000;
constexpr int kLastFreePort = 60000;
constexpr int kPortStep = 25;

}  // namespace

PortGroup::PortGroup(std::vector<Member> members, net::Token token)
    : doorkeeper_(std::move(token)), members_(std::move(members)) {
  if (doorkeeper_.asks()) {
    members_.push_back({&doorkeeper_.port(), kDoorOffset});
  }
}

Result<int> PortGroup::listen(const net::Endpoint& host, int first, const net::Allowed& allowed) {
  for (int base = first > 0 ? first : kFirstFreePort;; base += kPortStep) {
    const Status listening = listen_from(host, base, allowed);
    if (listening) {
      return base;
    }
    if (first > 0 || base >= kLastFreePort) {
      return listening.error();
    }
  }
}

Status PortGroup::listen_from(const net::Endpoint& host, int first, const net::Allowed& allowed) {
  const Port::Admits named = [allowed](const net::Endpoint& peer) {
    return allowed.contains(peer);
  };
  const Port::Admits brought_token = [this](const net::Endpoint& peer) {
    return doorkeeper_.admits(peer, HostClock::now());
  };
  for (const Member& member : members_) {
    const bool asks = doorkeeper_.asks() && member.port != &doorkeeper_.port();
    const Status listening =
        member.port->listen(host, first + member.offset, asks ? brought_token : named);
    if (!listening) {
      return listening;
    }
  }
  return {};
}

void PortGroup::turn() {
  watched_.clear();
  for (const Member& member : members_) {
    const bool waits = !member.port->has_client() && !member.is_free();
    watched_.push_back({waits ? -1 : member.port->fd(), member.port->events(), 0});
  }
  net::wait_for_news(watched_, kTurnMs);
  const HostTime now = HostClock::now();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Port& port = *members_[i].port;
    port.step(watched_[i].revents, now);
    if (doorkeeper_.asks() && port.has_client()) {
      doorkeeper_.admits(port.peer(), now);  // for longer
    }
  }
  doorkeeper_.step(now);
}

}  // namespace orthonav::hl2ss
