#include "tests/hal/hl2ss/served_room.h"

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
  Next came = Next::kNone;
  static_cast<void>(wait_until([&] {
    const auto next = headset.cameras()->next(frame);
    if (!next && errors) {
      ++*errors;
    }
    came = next ? *next : Next::kNone;
    return came != Next::kNone;
  }));
  return came;
}

}  // namespace orthonav::test
