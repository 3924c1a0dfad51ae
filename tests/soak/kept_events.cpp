#include "tests/soak/kept_events.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "engine/io/json_document.h"
#include "engine/session/log/logged_operation.h"
#include "engine/session/log/operation_json.h"
#include "engine/session/steps/digitizing.h"

namespace orthonav::soak {
namespace {

using engine::OperationRecord;

std::string place_of(const nav::Region& region) {
  std::vector<Point<World>> tips;
  for (const nav::Sample& sample : region.samples) {
    tips.push_back(sample.tip_in_world);
  }
  return engine::hash_of(tips);
}

std::optional<Kind> kind_of(const engine::Record& record) {
  switch (static_cast<OperationRecord>(record.type)) {
    case OperationRecord::kRegion:
      return Kind::kRegion;
    case OperationRecord::kRegistration:
      return Kind::kRegistration;
    case OperationRecord::kAccepted:
      return Kind::kAcceptance;
    case OperationRecord::kCheckPoint:
      return Kind::kCheckPoint;
    case OperationRecord::kLandmark:
      return Kind::kLandmark;
    case OperationRecord::kScrew:
      return Kind::kScrew;
    case OperationRecord::kRod:
      return Kind::kRod;
    default:
      return std::nullopt;
  }
}

std::string screw_name(const std::string& label, const std::string& side) {
  return label + " " + side;
}

/// Sorted: those of `a` that are not in `b`, each as often as it is missing.
std::vector<KeptEvent> missing(std::span<const KeptEvent> a, std::span<const KeptEvent> b) {
  std::vector<KeptEvent> left(a.begin(), a.end());
  std::vector<KeptEvent> right(b.begin(), b.end());
  std::sort(left.begin(), left.end());
  std::sort(right.begin(), right.end());
  std::vector<KeptEvent> out;
  std::set_difference(left.begin(), left.end(), right.begin(), right.end(),
                      std::back_inserter(out));
  return out;
}

}  // namespace

void ToldEvents::add(Timestamp time, Kind kind, std::string what, std::size_t samples) {
  events_.push_back(
      {time.time_since_epoch().count(), kind, std::move(what), static_cast<std::int64_t>(samples)});
}

void ToldEvents::region_saved(Timestamp time, const engine::LevelState& level,
                              const nav::Region& region) {
  add(time, Kind::kRegion, level.plan.label + " " + place_of(region), region.samples.size());
}

void ToldEvents::registered(Timestamp time, const engine::LevelState& level,
                            const engine::RegistrationOutcome& /*outcome*/) {
  add(time, Kind::kRegistration, level.plan.label);
}

void ToldEvents::accepted(Timestamp time, const engine::LevelState& level,
                          std::string_view /*shown*/) {
  add(time, Kind::kAcceptance, level.plan.label);
}

void ToldEvents::check_point_recorded(Timestamp time, const engine::LevelState& level) {
  add(time, Kind::kCheckPoint, level.plan.label);
}

void ToldEvents::landmark_touched(Timestamp time, const engine::LevelState& level,
                                  const engine::LandmarkTouch& /*touch*/) {
  add(time, Kind::kLandmark, level.plan.label);
}

void ToldEvents::screw_done(Timestamp time, const engine::LevelState& level, std::size_t screw,
                            const engine::ToolGuidance* /*at_depth*/) {
  const std::string side(name_of(level.plan.screws[screw].side));
  add(time, Kind::kScrew, screw_name(level.plan.label, side));
}

void ToldEvents::rod_done(Timestamp time, const engine::RodState& rod) {
  add(time, Kind::kRod, std::string(name_of(rod.side)));
}

std::vector<KeptEvent> kept_events(std::span<const engine::Record> records) {
  std::vector<KeptEvent> events;
  for (const engine::Record& record : records) {
    const std::optional<Kind> kind = kind_of(record);
    const auto document = engine::JsonDocument::parse(record.payload, "record");
    if (!kind || !document) {
      continue;
    }
    const engine::JsonNode root = document->root();
    KeptEvent event{static_cast<std::int64_t>(root.unsigned_integer("time_ns")), *kind,
                    *kind == Kind::kRod ? root.text("side") : root.text("label")};
    if (*kind == Kind::kRegion) {
      const nav::Region region = engine::region_from(root.child("region"));
      event.samples = static_cast<std::int64_t>(region.samples.size());
      event.what += " " + place_of(region);
    } else if (*kind == Kind::kScrew) {
      event.what = screw_name(event.what, root.text("side"));
    }
    if (document->status()) {
      events.push_back(std::move(event));
    }
  }
  return events;
}

Differences differences(std::span<const KeptEvent> told, std::span<const KeptEvent> kept) {
  Differences found;
  const std::vector<KeptEvent> lost = missing(told, kept);
  found.lost = counts_of(lost);
  found.lost_samples = samples_of(lost);
  found.doubled = static_cast<std::int64_t>(missing(kept, told).size());
  return found;
}

std::int64_t screws_done_twice(std::span<const engine::Record> records) {
  std::set<std::string> done;
  std::map<std::string, int> redone;
  std::int64_t twice = 0;
  for (const engine::Record& record : records) {
    const auto document = engine::JsonDocument::parse(record.payload, "record");
    if (!document) {
      continue;
    }
    const engine::JsonNode root = document->root();
    if (kind_of(record) == Kind::kScrew) {
      twice += done.insert(screw_name(root.text("label"), root.text("side"))).second ? 0 : 1;
    } else if (static_cast<OperationRecord>(record.type) == OperationRecord::kPlan) {
      for (const engine::JsonNode& screw : root.list("screws")) {
        const std::string name = screw_name(root.text("label"), screw.text("side"));
        const int times = screw.integer("redone");
        if (times > std::exchange(redone[name], times)) {
          done.erase(name);
        }
      }
    }
  }
  return twice;
}

Counts counts_of(std::span<const KeptEvent> events) {
  Counts counts{};
  for (const KeptEvent& event : events) {
    ++counts[static_cast<std::size_t>(event.kind)];
  }
  return counts;
}

std::int64_t samples_of(std::span<const KeptEvent> events) {
  std::int64_t samples = 0;
  for (const KeptEvent& event : events) {
    samples += event.samples;
  }
  return samples;
}

}  // namespace orthonav::soak
