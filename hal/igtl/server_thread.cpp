#include "hal/igtl/server_thread.h"

#include <poll.h>

#include <algorithm>

#include "base/guarded.h"
#include "hal/igtl/message.h"
#include "hal/net/socket.h"

namespace orthonav::igtl {
namespace {

using std::chrono::milliseconds;

/// Bytes that the kernel buffers for a client before it shows that the client does not read.
constexpr int kSendBuffer = 64 << 10;

}  // namespace

ServerThread::ServerThread(const ServerOptions& options, net::Allowed allowed, net::Socket socket,
                           TextListener* listener)
    : options_(options),
      allowed_(std::move(allowed)),
      listener_(std::move(socket)),
      hears_(listener) {
  thread_ = std::thread([this] {
    const Status died = guarded("server", [this] { run(); });
    if (!died) {
      const MutexLock lock(mutex_);
      ++counts_.dropped;
      counts_.last_drop = died.error().message;
    }
  });
}

ServerThread::~ServerThread() {
  stop_ = true;
  wake_up_.wake();
  thread_.join();
}

void ServerThread::publish(std::vector<std::uint8_t> frame) {
  {
    const MutexLock lock(mutex_);
    frame_ = std::move(frame);
  }
  wake_up_.wake();
}

void ServerThread::set_standing(std::vector<std::uint8_t> standing) {
  {
    const MutexLock lock(mutex_);
    new_standing_ = std::move(standing);
  }
  wake_up_.wake();
}

void ServerThread::tell(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) {
    return;
  }
  {
    const MutexLock lock(mutex_);
    to_tell_.insert(to_tell_.end(), bytes.begin(), bytes.end());
  }
  wake_up_.wake();
}

Server::Counts ServerThread::counts() const {
  const MutexLock lock(mutex_);
  return counts_;
}

bool ServerThread::has_frame() const {
  const MutexLock lock(mutex_);
  return frame_.has_value();
}

void ServerThread::run() {
  last_frame_ = HostClock::now();
  while (!stop_) {
    wait(HostClock::now());
    const HostTime now = HostClock::now();
    accept_clients(now);
    give_out(now);
    serve_clients(now);
  }
}

/// Waits until a client sends or can take bytes, or a frame is due.
void ServerThread::wait(HostTime now) {
  const bool may = may_call(now);
  std::vector<pollfd> watched = {{wake_up_.fd(), POLLIN, 0},
                                 {may ? listener_.fd() : -1, POLLIN, 0}};
  HostTime until = last_frame_ + options_.longest_silence;
  if (!may) {
    until = std::min(until, calls_since_ + options_.calls_counted_for);
  }
  if (has_frame()) {
    until = std::min(until, next_frame_);
  }
  for (const Client& client : clients_) {
    const auto events = static_cast<short>(client.idle() ? POLLIN : POLLIN | POLLOUT);
    watched.push_back({client.fd(), events, 0});
    if (!client.idle()) {
      until = std::min(until, client.taken() + options_.longest_block);
    } else if (!client.let_in()) {
      until = std::min(until, client.taken() + options_.longest_without_token);
    }
  }
  const auto left = std::chrono::ceil<milliseconds>(until - now).count();
  const int timeout = static_cast<int>(std::clamp<std::int64_t>(left, 0, 1000));
  net::wait_for_news(watched, timeout);
  if ((watched[0].revents & POLLIN) != 0) {
    wake_up_.clear();
  }
}

bool ServerThread::may_call(HostTime now) const {
  return calls_ < options_.most_calls || now - calls_since_ >= options_.calls_counted_for;
}

void ServerThread::accept_clients(HostTime now) {
  while (may_call(now)) {
    auto socket = net::accept_one(listener_);
    if (!socket) {
      return;
    }
    if (now - calls_since_ >= options_.calls_counted_for) {
      calls_since_ = now;
      calls_ = 0;
    }
    ++calls_;
    if (clients_.size() >= options_.most_clients || !allowed_.contains(net::peer_of(*socket))) {
      const MutexLock lock(mutex_);
      ++counts_.refused;
      continue;
    }
    (void)::setsockopt(socket->fd(), SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
    clients_.emplace_back(std::move(*socket), now, hears_, options_.token);
    if (clients_.back().let_in()) {
      clients_.back().add(standing_, now);
    }
    const MutexLock lock(mutex_);
    ++counts_.served;
    counts_.clients = clients_.size();
  }
}

/// Sends the newest frame, no more often than allowed; standing messages when they change; or a
/// notice that there are no frames.
void ServerThread::give_out(HostTime now) {
  std::optional<std::vector<std::uint8_t>> frame;
  bool stands_anew = false;
  std::vector<std::uint8_t> to_tell;
  {
    const MutexLock lock(mutex_);
    to_tell.swap(to_tell_);
    if (new_standing_) {
      standing_ = std::move(*new_standing_);
      new_standing_.reset();
      stands_anew = true;
    }
    if (frame_ && now >= next_frame_) {
      frame.swap(frame_);
      ++counts_.frames;
    }
  }
  for (Client& client : clients_) {
    if (!client.let_in()) {
      continue;
    }
    if (stands_anew) {
      client.add(standing_, now);
    }
    if (!to_tell.empty()) {
      client.add(to_tell, now);
    }
  }
  if (frame) {
    // The limit applies on average: a slightly early frame does not wait for its slot.
    const auto period = std::chrono::duration_cast<HostClock::duration>(
        std::chrono::duration<double>(1.0 / options_.most_hz));
    next_frame_ = std::max(next_frame_ + period, now + period / 2);
    last_frame_ = now;
    give_frame(*frame, now);
  } else if (now - last_frame_ >= options_.longest_silence) {
    last_frame_ = now;
    give_frame(packed({"orthonav", 0}, StatusValues{kStatusTimeout, 0, "NO_FRAME",
                                                    "no stereo pair for a while: poses are old"}),
               now);
  }
}

/// A client that has not taken the last frame misses this one.
void ServerThread::give_frame(std::span<const std::uint8_t> frame, HostTime now) {
  for (Client& client : clients_) {
    if (client.let_in() && client.idle()) {
      client.add(frame, now);
    }
  }
}

void ServerThread::serve_clients(HostTime now) {
  for (auto client = clients_.begin(); client != clients_.end();) {
    const auto here = client++;
    const bool was_in = here->let_in();
    Status s = here->read(now, options_.most_bytes_per_s);
    if (s && !was_in && here->let_in()) {
      here->add(standing_, now);
    }
    s = s ? here->write(now) : s;
    if (s && !here->idle() && now - here->taken() > options_.longest_block) {
      s = Error{"does not read"};
    }
    if (s && !here->let_in() && now - here->taken() > options_.longest_without_token) {
      s = Error{"sent no token"};
    }
    if (!s) {
      drop(here, s.error());
    }
  }
}

void ServerThread::drop(std::list<Client>::iterator client, const Error& why) {
  clients_.erase(client);
  const MutexLock lock(mutex_);
  counts_.clients = clients_.size();
  if (why.code != ErrorCode::kLost) {
    ++counts_.dropped;
    counts_.last_drop = why.message;
  }
}

}  // namespace orthonav::igtl
