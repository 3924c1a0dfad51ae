#pragma once

#include <optional>

#include "hal/api/connection_statistics.h"
#include "hal/net/socket.h"

namespace orthonav::hl2ss {

/// Counts a stream's packets, and measures their jitter and gaps.
class ArrivalMeter {
 public:
  ArrivalMeter(std::string name, Duration interval) : interval_(interval) {
    statistics_.name = std::move(name);
  }
  void heard(Timestamp stamp, HostTime at);
  /// A packet of a stream without a regular interval.
  void counted() { ++statistics_.packets; }
  void connected() {
    ++statistics_.connections;
    last_.reset();
  }
  void trouble(std::string what) { statistics_.last_trouble = std::move(what); }
  void damaged(std::string what) {
    ++statistics_.damaged;
    trouble(std::move(what));
  }
  /// Counts damage, including a complete packet with an implausible time.
  void refused(const std::string& why) {
    ++refused_;
    damaged(std::to_string(refused_) + " packets refused, the last one: " + why);
  }
  void received(std::size_t bytes) { statistics_.bytes += static_cast<std::int64_t>(bytes); }
  [[nodiscard]] const StreamStatistics& statistics() const { return statistics_; }

 private:
  struct Arrival {
    Timestamp stamp{};
    HostTime at{};
  };
  Duration interval_;
  std::optional<Arrival> last_;
  std::int64_t refused_ = 0;
  StreamStatistics statistics_;
};

}  // namespace orthonav::hl2ss
