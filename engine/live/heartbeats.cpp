#include "engine/live/heartbeats.h"

#include <algorithm>
#include <limits>

namespace orthonav::engine {
namespace {

constexpr std::int64_t kRests = std::numeric_limits<std::int64_t>::max();
/// The parts on the tracking thread, innermost first.
constexpr std::array kOfTracking = {Part::kRegistration, Part::kCoach, Part::kVoice, Part::kCamera,
                                    Part::kTracker};

}  // namespace

Heartbeats::Heartbeats(const Clock& clock, Duration limit) : clock_(clock), limit_(limit) {
  for (Beats* beats : {&at_work_, &beside_}) {
    for (auto& since_ns : *beats) {
      since_ns.store(kRests, std::memory_order_relaxed);
    }
  }
}

void Heartbeats::begin(Beats& beats, Part part) const {
  beats[static_cast<std::size_t>(part)].store(clock_.now().time_since_epoch().count(),
                                              std::memory_order_release);
}

void Heartbeats::begins(Part part) { begin(at_work_, part); }

void Heartbeats::ends(Part part) {
  at_work_[static_cast<std::size_t>(part)].store(kRests, std::memory_order_release);
}

void Heartbeats::begins_beside(Part part) { begin(beside_, part); }

void Heartbeats::ends_beside(Part part) {
  beside_[static_cast<std::size_t>(part)].store(kRests, std::memory_order_release);
}

bool Heartbeats::late(std::int64_t since_ns, Timestamp now, Duration limit) {
  return since_ns != kRests && now - Timestamp(Duration(since_ns)) > limit;
}

std::optional<Part> Heartbeats::stalled_beside() const {
  const Timestamp now = clock_.now();
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if (late(beside_[part].load(std::memory_order_acquire), now, kTaskStallsAfter)) {
      return Part{static_cast<std::uint8_t>(part)};
    }
  }
  return std::nullopt;
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
