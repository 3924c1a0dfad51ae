#include "tools/orthonav/doctor/headset_probe.h"

#include <string_view>

#include "base/how_many.h"
#include "base/printed.h"
#include "hal/hl2ss/probe.h"
#include "hal/replay/replay_headset.h"
#include "tools/orthonav/shared/depth_listing.h"

namespace orthonav::tools {

namespace {

constexpr std::string_view kHl2ss = "hl2ss:";
constexpr std::string_view kReplay = "replay:";

Result<std::vector<Offer>> offers_of_ports(std::string_view address) {
  const auto options = hl2ss::options_of(address);
  if (!options) {
    return Error{"--headset: " + options.error().message};
  }
  const auto ports = hl2ss::probe(*options);
  if (!ports) {
    return Error{"--headset: " + ports.error().message, ports.error().code};
  }
  std::vector<Offer> offers;
  for (const hl2ss::ProbedPort& port : *ports) {
    const std::string where = options->host + ", port " + std::to_string(port.port);
    if (port.trouble.empty()) {
      offers.push_back({"HoloLens 2: " + port.name, Finding::kFound, where, ""});
    } else {
      // Without its cameras there is nothing to run on.
      const bool needed =
          port.service == hl2ss::Service::kLeftFront || port.service == hl2ss::Service::kRightFront;
      offers.push_back({"HoloLens 2: " + port.name, needed ? Finding::kMissing : Finding::kOptional,
                        where + ": " + port.trouble,
                        "start hl2ss on the headset (docs/headsets.md)"});
    }
  }
  return offers;
}

/// "from 0.1 s to 12.3 s after the first pair"
std::string span_after(std::int64_t start_100ns, std::int64_t first_100ns,
                       std::int64_t last_100ns) {
  const auto after_s = [&](std::int64_t ticks) {
    constexpr double kSecondsATick = 1e-7;
    return kSecondsATick * static_cast<double>(ticks - start_100ns);
  };
  return printed("from %.1f s to %.1f s after the first pair", after_s(first_100ns),
                 after_s(last_100ns));
}

Result<std::vector<Offer>> offers_of_recording(const std::string& folder) {
  const auto recording = replay::ReplayHeadset::open(folder);
  if (!recording) {
    return recording.error();
  }
  const replay::RecordingSummary& summary = (*recording)->summary();
  const std::int64_t start = summary.first_ticks_100ns;
  std::vector<Offer> offers = {
      {"Recording: stereo pairs", Finding::kFound,
       how_many(summary.pairs, "pair") + ", " + std::to_string(summary.pairs_without_pose) +
           " without a pose, " +
           (summary.missing > 0 ? std::to_string(summary.missing) + " missing by their numbers, "
                                : "") +
           (summary.map_jumps > 0 ? "its map jumps " + how_many(summary.map_jumps, "time") + ", "
                                  : "") +
           span_after(start, start, summary.last_ticks_100ns),
       ""}};
  if (!summary.cut.empty()) {
    offers.push_back({"Recording: cut off", Finding::kOptional, summary.cut,
                      "orthonav recording repair closes it"});
  }
  for (const replay::DepthSummary& depth : summary.depth) {
    const bool read = depth.trouble.empty();
    offers.push_back({std::string("Recording: depth ") + name_of(depth.stream),
                      read ? Finding::kFound : Finding::kOptional,
                      in_words(depth) + (read ? ", " + span_after(start, depth.first_ticks_100ns,
                                                                  depth.last_ticks_100ns)
                                              : ""),
                      ""});
  }
  return offers;
}

}  // namespace

Result<std::vector<Offer>> offers_of_headset(const std::string& uri) {
  const std::string_view text(uri);
  if (text.starts_with(kHl2ss)) {
    return offers_of_ports(text.substr(kHl2ss.size()));
  }
  if (text.starts_with(kReplay)) {
    return offers_of_recording(
        std::string(text.substr(kReplay.size(), text.find('?') - kReplay.size())));
  }
  return Error{"--headset: \"" + uri +
               "\" can't be looked at; known are hl2ss://HOST and replay:PATH"};
}

}  // namespace orthonav::tools
