#include "tests/hal/hl2ss/served_room.h"

#include <thread>

#include "hal/api/as_headset.h"

namespace orthonav::test {

ServedRoom::ServedRoom(const sim::SimOptions& sim, hl2ss::ServerOptions options,
                       sim::RoomDescription room) {
  options.first_port = 0;
  auto started = hl2ss::Server::start(
      options, [sim, room] { return as_headset(sim::SimHeadset::open(room, sim)); });
  EXPECT_TRUE(started.ok()) << started.error().message;
  if (started) {
    server_ = std::move(*started);
  }
}

hl2ss::Hl2ssOptions ServedRoom::client_options() const { return server_->client_options(); }

std::unique_ptr<hl2ss::Hl2ssHeadset> ServedRoom::connect(hl2ss::VideoProfile profile) const {
  hl2ss::Hl2ssOptions options = client_options();
  options.profile = profile;
  auto opened = hl2ss::Hl2ssHeadset::open(options);
  EXPECT_TRUE(opened.ok()) << opened.error().message;
  return opened ? std::move(*opened) : nullptr;
}

Next next_pair(Headset& headset, StereoFrame& frame, int* errors) {
  const auto deadline = std::chrono::steady_clock::now() + kLongest;
  while (std::chrono::steady_clock::now() < deadline) {
    const auto next = headset.cameras().next(frame);
    if (!next && errors) {
      ++*errors;
    }
    if (next && *next != Next::kNone) {
      return *next;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return Next::kNone;
}

}  // namespace orthonav::test
