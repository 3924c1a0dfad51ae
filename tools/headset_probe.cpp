#include "tools/headset_probe.h"

#include "hal/hl2ss/probe.h"

namespace orthonav::tools {

Result<std::vector<Offer>> offers_of_headset(const std::string& uri) {
  const std::string scheme = "hl2ss:";
  if (!uri.starts_with(scheme))
    return Error{"--headset: \"" + uri + "\" has no ports to look at; known is hl2ss://HOST"};
  const auto options = hl2ss::options_of(std::string_view(uri).substr(scheme.size()));
  if (!options) return Error{"--headset: " + options.error().message};
  const auto ports = hl2ss::probe(*options);
  if (!ports) return Error{"--headset: " + ports.error().message};
  std::vector<Offer> offers;
  for (const hl2ss::ProbedPort& port : *ports) {
    const std::string where = options->host + ", port " + std::to_string(port.port);
    if (port.trouble.empty())
      offers.push_back({"HoloLens 2: " + port.name, Finding::kFound, where, ""});
    else
      offers.push_back({"HoloLens 2: " + port.name, Finding::kOptional, where + ": " + port.trouble,
                        "start hl2ss on the headset (docs/headsets.md)"});
  }
  return offers;
}

}  // namespace orthonav::tools
