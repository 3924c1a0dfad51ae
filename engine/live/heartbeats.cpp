#include "engine/live/heartbeats.h"

#include <algorithm>
#include <limits>

namespace orthonav::engine {
namespace {

constexpr std::int64_t kRests = std::numeric_limits<std::int64_t>::max();
/// The parts on the tracking thread, innermost first.
constexpr std::array kOfTracking = {Part::kCoach, Part::kVoice, Part::kCamera, Part::kTracker};

}  // namespace

Heartbeats::Heartbeats(const Clock& clock, Duration limit) : clock_(clock), limit_(limit) {
  for (auto& since_ns : since_ns_) {
    since_ns.store(kRests, std::memory_order_relaxed);
  }
}

void Heartbeats::begins(Part part) {
  since_ns_[static_cast<std::size_t>(part)].store(clock_.now().time_since_epoch().count(),
                                                  std::memory_order_release);
}

void Heartbeats::ends(Part part) {
  since_ns_[static_cast<std::size_t>(part)].store(kRests, std::memory_order_release);
}

bool Heartbeats::stalled(Part part, Timestamp now) const {
  const std::int64_t began = since(part);
  return began != kRests && now - Timestamp(Duration(began)) > limit_;
}

std::optional<Part> Heartbeats::tracking() const {
  const auto* busy = std::find_if(kOfTracking.begin(), kOfTracking.end(),
                                  [&](Part part) { return since(part) != kRests; });
  return busy == kOfTracking.end() ? std::nullopt : std::optional(*busy);
}

std::optional<Part> Heartbeats::tracking_stalled() const {
  const Timestamp now = clock_.now();
  const bool late = std::any_of(kOfTracking.begin(), kOfTracking.end(),
                                [&](Part part) { return stalled(part, now); });
  return late ? tracking() : std::nullopt;
}

}  // namespace orthonav::engine
