#include "nav/registration/digitizer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace orthonav::nav {
namespace {

/// Two minutes at 30 Hz: recording does not allocate.
constexpr std::size_t kReservedSamples = 3600;

/// The tip moves by the translation, and by the rotation times the lever arm.
double tip_sd_m(const TrackedPose& pose, Point<Marker> tip_in_marker) {
  const Vec3 lever_arm = pose.value.rotation() * tip_in_marker.v;
  double variance = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along{};
    along[axis] = 1.0;
    const Vec3 by_rotation = lever_arm.cross(along);
    const std::array<double, 6> slope{along.x,       along.y,       along.z,
                                      by_rotation.x, by_rotation.y, by_rotation.z};
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t k = 0; k < 6; ++k) {
        variance += slope[i] * pose.covariance[6 * i + k] * slope[k];
      }
    }
  }
  return variance > 0.0 && std::isfinite(variance) ? std::sqrt(variance / 3.0) : 0.0;
}

/// One field of every saved sample, in order.
template <class T>
std::vector<T> of_saved(std::span<const Region> regions, T Sample::*thing) {
  std::vector<T> out;
  for (const Region& region : regions) {
    if (region.saved) {
      for (const Sample& sample : region.samples) {
        out.push_back(sample.*thing);
      }
    }
  }
  return out;
}

}  // namespace

Region& Digitizer::current() {
  if (regions_.empty() || regions_.back().saved) {
    regions_.emplace_back();
    regions_.back().samples.reserve(kReservedSamples);
  }
  return regions_.back();
}

void Digitizer::press(Timestamp time) {
  if (recording_) {
    return;
  }
  recording_ = true;
  pressed_at_ = time;
  current();
}

void Digitizer::release(Timestamp /*time*/) { recording_ = false; }

bool Digitizer::add(const TrackedPose& world_from_marker, Point<Marker> tip_in_marker,
                    Direction<Marker> axis_in_marker) {
  if (!recording_ || world_from_marker.status != PoseStatus::kMeasured) {
    return false;
  }
  if (world_from_marker.time < pressed_at_ || world_from_marker.time <= newest_) {
    return false;
  }
  const Point<World> tip_in_world = world_from_marker.value * tip_in_marker;
  if (!tip_in_world.v.is_finite()) {
    return false;
  }
  const Vec3 shaft = (world_from_marker.value * axis_in_marker).v;
  current().samples.push_back({tip_in_world, world_from_marker.time, shaft.normalized(),
                               tip_sd_m(world_from_marker, tip_in_marker)});
  newest_ = world_from_marker.time;
  return true;
}

void Digitizer::save() {
  if (regions_.empty() || regions_.back().samples.empty()) {
    return;
  }
  regions_.back().saved = true;
  if (recording_) {
    current();
  }
}

std::optional<Region> Digitizer::drop() {
  if (regions_.empty() || regions_.back().saved) {
    return std::nullopt;
  }
  Region dropped = std::move(regions_.back());
  regions_.pop_back();
  if (recording_) {
    current();
  }
  if (dropped.samples.empty()) {
    return std::nullopt;
  }
  return dropped;
}

std::optional<Region> Digitizer::drop_saved() {
  const auto last =
      std::find_if(regions_.rbegin(), regions_.rend(), [](const Region& r) { return r.saved; });
  if (last == regions_.rend()) {
    return std::nullopt;
  }
  Region dropped = std::move(*last);
  regions_.erase(std::next(last).base());
  return dropped;
}

void Digitizer::restore(std::vector<Region> saved) {
  clear();
  regions_ = std::move(saved);
}

void Digitizer::clear() {
  regions_.clear();
  recording_ = false;
  newest_ = Timestamp::min();
}

std::vector<Point<World>> Digitizer::saved_points() const {
  return of_saved(regions_, &Sample::tip_in_world);
}

std::vector<Vec3> Digitizer::saved_shafts() const {
  return of_saved(regions_, &Sample::shaft_in_world);
}

std::vector<Timestamp> Digitizer::saved_times() const { return of_saved(regions_, &Sample::time); }

std::size_t Digitizer::saved_count() const {
  std::size_t count = 0;
  for (const Region& region : regions_) {
    if (region.saved) {
      count += region.samples.size();
    }
  }
  return count;
}

}  // namespace orthonav::nav
