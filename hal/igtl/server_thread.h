#pragma once

#include <atomic>
#include <list>
#include <optional>

#include "hal/igtl/client.h"
#include "hal/igtl/server.h"

namespace orthonav::igtl {

/// The thread of a `Server`, and what it shares with those who publish.
class ServerThread {
 public:
  /// Takes both descriptors: a listening socket and an eventfd.
  ServerThread(const ServerOptions& options, int listener, int wake_up, int port);
  ~ServerThread();
  ServerThread(const ServerThread&) = delete;
  ServerThread& operator=(const ServerThread&) = delete;

  [[nodiscard]] int port() const { return port_; }
  void publish(std::vector<std::uint8_t> frame) ORTHONAV_EXCLUDES(mutex_);
  void stand(std::vector<std::uint8_t> standing) ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] Server::Counts counts() const ORTHONAV_EXCLUDES(mutex_);

 private:
  void run();
  void wake() const;
  void wait(HostTime now);
  void accept_clients(HostTime now);
  void give_out(HostTime now) ORTHONAV_EXCLUDES(mutex_);
  void give_frame(std::span<const std::uint8_t> frame, HostTime now);
  void serve_clients(HostTime now);
  void drop(std::list<Client>::iterator client, const std::string& why) ORTHONAV_EXCLUDES(mutex_);
  [[nodiscard]] bool has_frame() const ORTHONAV_EXCLUDES(mutex_);

  const ServerOptions options_;
  const int listener_;
  const int wake_up_;
  const int port_;
  std::atomic<bool> stop_ = false;

  mutable Mutex mutex_;
  std::optional<std::vector<std::uint8_t>> frame_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<std::vector<std::uint8_t>> new_standing_ ORTHONAV_GUARDED_BY(mutex_);
  Server::Counts counts_ ORTHONAV_GUARDED_BY(mutex_);

  // The thread's own.
  std::list<Client> clients_;
  std::vector<std::uint8_t> standing_;
  HostTime next_frame_{};
  HostTime last_frame_{};
  std::thread thread_;
};

}  // namespace orthonav::igtl
