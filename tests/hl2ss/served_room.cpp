#include "tests/hl2ss/served_room.h"

#include <thread>

namespace orthonav::testing {

sim::RoomDescription bare_room() {
  sim::RoomDescription room;
  sim::RoomTool pointer;
  pointer.name = "pointer";
  pointer.id = 3;
  pointer.size_m = 0.05;
  pointer.tip_in_marker = {{0.0, -0.15, 0.0}};
  sim::RoomTool guide = pointer;
  guide.name = "guide";
  guide.kind = sim::ToolKind::kGuide;
  guide.id = 5;
  room.tools = {pointer, guide};
  return room;
}

ServedRoom::ServedRoom(const sim::SimOptions& sim, hl2ss::ServerOptions options,
                       sim::RoomDescription room)
    : standin_(options.standin) {
  options.first_port = 0;
  auto started = hl2ss::Server::start(options, [sim, room]() -> Result<std::unique_ptr<Headset>> {
    auto opened = sim::SimHeadset::open(room, sim);
    if (!opened) return opened.error();
    return std::unique_ptr<Headset>(std::move(*opened));
  });
  EXPECT_TRUE(started.ok()) << started.error().message;
  if (started) server_ = std::move(*started);
}

hl2ss::Hl2ssOptions ServedRoom::client_options() const {
  hl2ss::Hl2ssOptions options;
  options.host = "127.0.0.1";
  options.first_port = server_->first_port();
  if (standin_) options.standin_port = server_->standin_port();
  return options;
}

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
    if (!next && errors) ++*errors;
    if (next && *next != Next::kNone) return *next;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return Next::kNone;
}

}  // namespace orthonav::testing
