#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/records.h"
#include "engine/session/log/session_observer.h"

namespace orthonav::soak {

/// The kinds of events that an operation has to keep.
enum class Kind { kRegion, kRegistration, kAcceptance, kCheckPoint, kLandmark, kScrew, kRod };
inline constexpr std::array<std::string_view, 7> kKinds = {
    "regions", "registrations", "acceptances", "check_points", "landmarks", "screws", "rods"};
using Counts = std::array<std::int64_t, kKinds.size()>;

/// An event, distinguishable from all others.
struct KeptEvent {
  std::int64_t time_ns = 0;
  Kind kind = Kind::kRegion;
  std::string what;          ///< "L5 left"; for a region also a hash of its samples' places
  std::int64_t samples = 0;  ///< of a region

  auto operator<=>(const KeptEvent&) const = default;
};

/// Collects the events of a session, as its log should have them.
class ToldEvents : public engine::SessionObserver {
 public:
  [[nodiscard]] std::span<const KeptEvent> all() const { return events_; }
  /// Those that happened before "saved" was last shown.
  [[nodiscard]] std::span<const KeptEvent> shown_saved() const { return all().first(saved_); }
  /// Call when "saved" is in the status line.
  void saved_is_shown() { saved_ = events_.size(); }

  void region_saved(Timestamp time, const engine::LevelState& level,
                    const nav::Region& region) override;
  void registered(Timestamp time, const engine::LevelState& level,
                  const engine::RegistrationOutcome& outcome) override;
  void accepted(Timestamp time, const engine::LevelState& level, std::string_view shown) override;
  void check_point_recorded(Timestamp time, const engine::LevelState& level) override;
  void landmark_touched(Timestamp time, const engine::LevelState& level,
                        const engine::LandmarkTouch& touch) override;
  void screw_done(Timestamp time, const engine::LevelState& level, std::size_t screw,
                  const engine::ToolGuidance* at_depth) override;
  void rod_done(Timestamp time, const engine::RodState& rod) override;

 private:
  void add(Timestamp time, Kind kind, std::string what, std::size_t samples = 0);
  std::vector<KeptEvent> events_;
  std::size_t saved_ = 0;
};

/// The same from the records of a log. Records that can't be read are not among them.
std::vector<KeptEvent> kept_events(std::span<const engine::Record> records);

/// How the observed events differ from the kept ones.
struct Differences {
  Counts lost{};  ///< observed, not kept
  std::int64_t lost_samples = 0;
  std::int64_t doubled = 0;  ///< kept, but not observed, or not as often
};
Differences differences(std::span<const KeptEvent> told, std::span<const KeptEvent> kept);

/// Screws that were done again without a request to redo them.
std::int64_t screws_done_twice(std::span<const engine::Record> records);

Counts counts_of(std::span<const KeptEvent> events);
std::int64_t samples_of(std::span<const KeptEvent> events);

}  // namespace orthonav::soak
