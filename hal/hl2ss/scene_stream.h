#pragma once

#include <array>

#include "base/mutex.h"
#include "hal/api/object_display.h"
#include "hal/hl2ss/connection.h"
#include "hal/hl2ss/event_streams.h"
#include "hal/hl2ss/scene_client.h"

namespace orthonav::hl2ss {

/// The connection to the headset's scene: a `SceneClient` behind a socket. Lists come from any
/// thread; the rest is called by the thread that runs the connections.
class SceneStream final : public Protocol, public ObjectDisplay {
 public:
  SceneStream(ArrivalMeter& meter, const HeadsetTime& time, const net::WakeUp& wake_up)
      : meter_(meter), time_(time), wake_up_(wake_up) {}

  void show(const ObjectList& list) override ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] ObjectDisplayStatistics statistics() const override ORTHONAV_EXCLUDES(mutex_);

  [[nodiscard]] std::vector<std::uint8_t> opening() override ORTHONAV_EXCLUDES(mutex_);
  std::span<std::uint8_t> room() override { return std::span(answers_).subspan(have_); }
  Status received(std::size_t count, HostTime at) override ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] std::vector<std::uint8_t> more(HostTime now) override ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] Status overdue(HostTime now) override ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] std::vector<std::uint8_t> goodbye() override { return SceneClient::goodbye(); }
  void disconnected() override { have_ = 0; }

 private:
  [[nodiscard]] SceneMoment moment(HostTime host) const { return {host, time_.clock.now()}; }

  ArrivalMeter& meter_;
  const HeadsetTime& time_;
  const net::WakeUp& wake_up_;
  std::array<std::uint8_t, 4096> answers_{};
  std::size_t have_ = 0;
  mutable Mutex mutex_;
  SceneClient client_ ORTHONAV_GUARDED_BY(mutex_);
};

}  // namespace orthonav::hl2ss
