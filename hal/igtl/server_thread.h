#pragma once

#include <atomic>
#include <list>
#include <optional>
#include <thread>

#include "base/mutex.h"
#include "hal/igtl/client.h"
#include "hal/igtl/server.h"
#include "hal/net/allowed.h"

namespace orthonav::igtl {

/// The thread of a `Server`, and the data it shares with publishers.
class ServerThread {
 public:
  ServerThread(const ServerOptions& options, net::Allowed allowed, net::Socket socket,
               TextListener* listener = nullptr);
  ~ServerThread();
  ServerThread(const ServerThread&) = delete;
  ServerThread& operator=(const ServerThread&) = delete;

  [[nodiscard]] int port() const { return net::port_of(listener_); }
  void publish(std::vector<std::uint8_t> frame) ORTHONAV_EXCLUDES(mutex_);
  void set_standing(std::vector<std::uint8_t> standing) ORTHONAV_EXCLUDES(mutex_);
  void tell(std::span<const std::uint8_t> bytes) ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] Server::Counts counts() const ORTHONAV_EXCLUDES(mutex_);

 private:
  void run();
  void wait(HostTime now);
  void accept_clients(HostTime now) ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] bool may_call(HostTime now) const;
  void give_out(HostTime now) ORTHONAV_EXCLUDES(mutex_);
  void give_frame(std::span<const std::uint8_t> frame, HostTime now);
  void serve_clients(HostTime now);
  void drop(std::list<Client>::iterator client, const Error& why) ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] bool has_frame() const ORTHONAV_EXCLUDES(mutex_);

  const ServerOptions options_;
  const net::Allowed allowed_;
  const net::Socket listener_;
  TextListener* const hears_;  ///< receives clients' texts; may be null
  const net::WakeUp wake_up_;
  std::atomic<bool> stop_ = false;

  mutable Mutex mutex_;
  std::optional<std::vector<std::uint8_t>> frame_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<std::vector<std::uint8_t>> new_standing_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<std::uint8_t> to_tell_ ORTHONAV_GUARDED_BY(mutex_);
  Server::Counts counts_ ORTHONAV_GUARDED_BY(mutex_);

  // Used by the thread only.
  std::list<Client> clients_;
  HostTime calls_since_{};
  int calls_ = 0;  ///< since that time
  std::vector<std::uint8_t> standing_;
  HostTime next_frame_{};
  HostTime last_frame_{};
  std::thread thread_;
};

}  // namespace orthonav::igtl
