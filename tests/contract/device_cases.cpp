#include "tests/contract/device_cases.h"

#include <gtest/gtest.h>

#include "hal/fake/failing.h"
#include "hal/open/open.h"
#include "hal/replay/recorder.h"
#include "hal/replay/replay_headset.h"
#include "tests/support/scripted_session.h"
#include "tests/support/session_log.h"
#include "tests/support/stream_recorder_folder.h"
#include "tests/support/temporary_folder.h"

namespace orthonav::testing {

namespace {

/// A headset and what must outlive it.
template <class Kept>
class Keeping : public Headset {
 public:
  Keeping(Kept kept, std::unique_ptr<Headset> headset)
      : kept_(std::move(kept)), headset_(std::move(headset)) {}
  [[nodiscard]] std::string name() const override { return headset_->name(); }
  [[nodiscard]] const Clock& clock() const override { return headset_->clock(); }
  [[nodiscard]] StereoCamera& cameras() override { return headset_->cameras(); }
  [[nodiscard]] HeadTracker& head() override { return headset_->head(); }
  [[nodiscard]] Clicker& clicker() override { return headset_->clicker(); }
  [[nodiscard]] Voice& voice() override { return headset_->voice(); }
  [[nodiscard]] Display& display() override { return headset_->display(); }

 private:
  Kept kept_;
  std::unique_ptr<Headset> headset_;
};

template <class Kept>
std::unique_ptr<Headset> keeping(Kept kept, std::unique_ptr<Headset> headset) {
  return std::make_unique<Keeping<Kept>>(std::move(kept), std::move(headset));
}

template <class T>
std::unique_ptr<Headset> checked(Result<std::unique_ptr<T>> opened) {
  EXPECT_TRUE(opened.ok()) << opened.error().message;
  return opened ? std::unique_ptr<Headset>(*std::move(opened)) : nullptr;
}

std::unique_ptr<Headset> open_fake() {
  return std::make_unique<fake::FakeHeadset>(scripted_session());
}

/// A pass through the failing doubles without a fault must keep every promise too.
std::unique_ptr<Headset> open_faultless() {
  auto inner = open_fake();
  auto failing = std::make_unique<fake::FailingHeadset>(*inner, fake::Faults{});
  return keeping(std::move(inner), std::move(failing));
}

std::unique_ptr<Headset> open_recorder() {
  auto folder = std::make_unique<TemporaryFolder>();
  auto recorder = checked(replay::RecordingHeadset::create(open_fake(), *folder / "session"));
  return keeping(std::move(folder), std::move(recorder));
}

std::unique_ptr<Headset> open_replay() {
  auto folder = std::make_unique<TemporaryFolder>();
  {
    auto recorder = replay::RecordingHeadset::create(open_fake(), *folder / "session");
    EXPECT_TRUE(recorder.ok());
    play(**recorder);
    EXPECT_TRUE((*recorder)->close().ok());
  }
  auto headset = checked(open_headset("replay:" + (*folder / "session").string()));
  return keeping(std::move(folder), std::move(headset));
}

std::unique_ptr<Headset> open_stream_recorder() {
  const std::vector<std::int64_t> ticks = {0, 333'333, 666'667, 4'000'000, 4'333'333};
  auto folder = std::make_unique<StreamRecorderFolder>(ticks, ticks);
  auto headset = checked(open_headset("replay:" + folder->path().string()));
  return keeping(std::move(folder), std::move(headset));
}

/// A table with two tools hovering over it, for a third of a second.
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

std::unique_ptr<Headset> open_sim() {
  OpenOptions options;
  options.room = bare_room();
  options.sim.surgeon = false;
  options.sim.limit_s = 0.34;
  return checked(open_headset("sim:?seed=11", options));
}

std::unique_ptr<Headset> open_replayed_sim() {
  auto folder = std::make_unique<TemporaryFolder>();
  {
    auto recorder = replay::RecordingHeadset::create(open_sim(), *folder / "session");
    EXPECT_TRUE(recorder.ok());
    play(**recorder);
    EXPECT_TRUE((*recorder)->close().ok());
  }
  auto headset = checked(open_headset("replay:" + (*folder / "session").string()));
  return keeping(std::move(folder), std::move(headset));
}

}  // namespace

std::vector<DeviceCase> device_cases() {
  return {{"fake", open_fake},
          {"faultless", open_faultless},
          {"recorder", open_recorder},
          {"replay", open_replay},
          {"stream_recorder", open_stream_recorder, false},
          {"sim", open_sim, false},
          {"replayed_sim", open_replayed_sim, false}};
}

}  // namespace orthonav::testing
