#include "hal/hl2ss/probe.h"

#include <array>
#include <utility>

#include "hal/net/socket.h"

namespace orthonav::hl2ss {
namespace {

constexpr std::array<std::pair<const char*, Service>, 7> kServices = {{
    {"left camera", Service::kLeftFront},
    {"right camera", Service::kRightFront},
    {"depth ahat", Service::kAhat},
    {"depth long-throw", Service::kLongThrow},
    {"remote configuration", Service::kConfiguration},
    {"microphone", Service::kMicrophone},
    {"voice", Service::kVoice},
}};
constexpr auto kPatience = std::chrono::seconds(1);

}  // namespace

Result<std::vector<ProbedPort>> probe(const Hl2ssOptions& options) {
  const auto host = net::resolve(options.host);
  if (!host) {
    return host.error();
  }
  std::vector<ProbedPort> ports;
  for (const auto& [name, service] : kServices) {
    ProbedPort& each = ports.emplace_back();
    each.name = name;
    each.service = service;
    each.port = options.first_port + offset_of(service);
    if (const Status reached = reach(*host, each.port, HostClock::now() + kPatience); !reached) {
      each.trouble = reached.error().message;
    }
  }
  return ports;
}

}  // namespace orthonav::hl2ss
