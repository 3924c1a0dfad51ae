#include "hal/hl2ss/server/port_group.h"

namespace orthonav::hl2ss {
namespace {

constexpr int kTurnMs = 5;
constexpr int kFirstFreePort = 20000;
constexpr int kLastFreePort = 60000;
constexpr int kPortStep = 25;

}  // namespace

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
  for (const Member& member : members_) {
    if (const Status listening = member.port->listen(host, first + member.offset, allowed);
        !listening) {
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
    members_[i].port->step(watched_[i].revents, now);
  }
}

}  // namespace orthonav::hl2ss
