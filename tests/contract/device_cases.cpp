#include "tests/contract/device_cases.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <map>
#include <set>
#include <thread>

#include "base/stopwatch.h"
#include "hal/api/forwarding_headset.h"
#include "hal/fake/failing.h"
#include "hal/hl2ss/server/server.h"
#include "hal/open/joined_headset.h"
#include "hal/open/open.h"
#include "hal/open/open_parts.h"
#include "hal/openxr/openxr_headset.h"
#include "hal/replay/recorder.h"
#include "hal/replay/replay_headset.h"
#include "study/surgeon/scripted_surgeon.h"
#include "study/surgeon/written_frame.h"
#include "tests/support/bare_room.h"
#include "tests/support/camera_scene.h"
#include "tests/support/depth_scene.h"
#include "tests/support/event_file.h"
#include "tests/support/pose_server.h"
#include "tests/support/scripted_session.h"
#include "tests/support/session_log.h"
#include "tests/support/stream_recorder_folder.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace orthonav::test {

namespace {

/// A headset and the objects that must outlive it.
template <class Kept>
class Keeping : public ForwardingHeadset {
 public:
  Keeping(Kept kept, std::unique_ptr<Headset> headset)
      : ForwardingHeadset(*headset), kept_(std::move(kept)), headset_(std::move(headset)) {}

 private:
  Kept kept_;
  std::unique_ptr<Headset> headset_;
};

template <class Kept>
std::unique_ptr<Headset> keeping(Kept kept, std::unique_ptr<Headset> headset) {
  return std::make_unique<Keeping<Kept>>(std::move(kept), std::move(headset));
}

/// Shows a step of the workflow with each pair.
class Prompting : public ForwardingHeadset {
 public:
  Prompting(std::unique_ptr<Headset> inner, engine::StepOnDisplay step)
      : ForwardingHeadset(*inner), inner_(std::move(inner)), cameras_(*inner_, std::move(step)) {}
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }

 private:
  class Cameras : public ForwardingCamera {
   public:
    Cameras(Headset& inner, engine::StepOnDisplay step)
        : ForwardingCamera(*inner.cameras()), inner_(inner), step_(std::move(step)) {}

   private:
    Result<Next> do_next(StereoFrame& frame) override {
      auto answer = ForwardingCamera::do_next(frame);
      if (!answer || *answer != Next::kFrame) {
        return answer;
      }
      engine::ShownFrame shown;
      shown.display_time = inner_.clock().now() + inner_.display_latency();
      shown.status = engine::ShownStatus{.at = step_};
      inner_.wearer()->see(sim::written(shown));
      return answer;
    }
    Headset& inner_;
    engine::StepOnDisplay step_;
  };
  std::unique_ptr<Headset> inner_;
  Cameras cameras_;
};

template <class T>
std::unique_ptr<Headset> checked(Result<std::unique_ptr<T>> opened) {
  EXPECT_TRUE(opened.ok()) << opened.error().message;
  return opened ? std::unique_ptr<Headset>(*std::move(opened)) : nullptr;
}

std::unique_ptr<Headset> open_fake() {
  return std::make_unique<fake::FakeHeadset>(scripted_session());
}

/// The failing doubles without a fault must keep every promise too.
std::unique_ptr<Headset> open_faultless() {
  auto inner = open_fake();
  auto failing = std::make_unique<fake::FailingHeadset>(*inner, fake::Faults{});
  return keeping(std::move(inner), std::move(failing));
}

/// Faults that a device may have without breaking its promises: pairs that are lost, late,
/// unlocated or spoiled, a head that is lost for a moment, a phrase that was not heard.
std::unique_ptr<Headset> open_with_allowed_faults() {
  auto inner = open_fake();
  fake::Faults faults;
  faults.camera = {{1, fake::CameraFault::kNoPose},
                   {2, fake::CameraFault::kDrop},
                   {4, fake::CameraFault::kDelay},
                   {6, fake::CameraFault::kNoise}};
  faults.head = {{1, fake::HeadFault::kLost}};  // the call for the display time
  faults.voice = {{1, fake::EventFault::kDrop}};
  auto failing = std::make_unique<fake::FailingHeadset>(*inner, std::move(faults));
  return keeping(std::move(inner), std::move(failing));
}

std::unique_ptr<Headset> open_recorder() {
  auto folder = std::make_unique<TemporaryFolder>();
  auto recorder = checked(replay::RecordingHeadset::create(open_fake(), *folder / "session"));
  return keeping(std::move(folder), std::move(recorder));
}

/// Another headset's cameras beside a display that is not open.
std::unique_ptr<Headset> open_openxr() {
  return openxr::OpenxrHeadset::around(open_fake(), openxr::RigOnHead{});
}

std::unique_ptr<Headset> open_stream_recorder() {
  const std::vector<std::int64_t> ticks = {0, 333'333, 666'667, 4'000'000, 4'333'333};
  auto folder = std::make_unique<StreamRecorderFolder>(ticks, ticks);
  DepthScene scene;
  scene.pictures = DepthScene::located({-100'000, 5'000, 700'000, 4'100'000, 5'000'000});
  scene.write_stream_recorder(folder->path(), "Depth AHaT", 4090);
  scene.write_stream_recorder(folder->path(), "Depth Long Throw", 0, false);
  auto headset = checked(open_headset("replay:" + folder->path().string()));
  return keeping(std::move(folder), std::move(headset));
}

/// A table with its tools for a third of a second.
std::unique_ptr<Headset> open_sim() {
  OpenOptions options;
  options.room = bare_room();
  options.sim.limit_s = 0.34;
  return checked(open_headset("sim:?seed=11", options));
}

/// With both depth cameras, for as long as it takes to have two pictures of the slower one.
std::unique_ptr<Headset> open_sim_with_depth() {
  OpenOptions options;
  options.room = bare_room();
  options.sim.limit_s = 0.45;
  return checked(open_headset("sim:?seed=11&depth", options));
}

/// Waits for the next frame, since frames over a network arrive with delay.
class Waiting : public ForwardingHeadset {
 public:
  explicit Waiting(std::unique_ptr<Headset> inner)
      : ForwardingHeadset(*inner), inner_(std::move(inner)), cameras_(*inner_->cameras()) {}
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }

 private:
  class Cameras : public ForwardingCamera {
   public:
    using ForwardingCamera::ForwardingCamera;

   private:
    Result<Next> do_next(StereoFrame& frame) override {
      Result<Next> answer = Next::kNone;
      static_cast<void>(wait_until([&] {
        answer = ForwardingCamera::do_next(frame);
        return !answer || *answer != Next::kNone;
      }));
      return answer;
    }
  };
  std::unique_ptr<Headset> inner_;
  Cameras cameras_;
};

/// The table with its tools, seen over the network through a server of our own.
std::unique_ptr<Headset> open_served_sim(const std::string& profile) {
  hl2ss::ServerOptions options;
  options.first_port = 0;
  options.paced = true;
  auto server =
      hl2ss::Server::start(options, [] { return Result<std::unique_ptr<Headset>>(open_sim()); });
  EXPECT_TRUE(server.ok()) << server.error().message;
  if (!server) {
    return nullptr;
  }
  auto headset = checked(open_headset(
      "hl2ss://127.0.0.1?port=" + std::to_string((*server)->first_port()) +
      "&standin=" + std::to_string((*server)->standin_port()) + "&profile=" + profile));
  if (!headset) {
    return nullptr;
  }
  return keeping(std::move(*server), std::make_unique<Waiting>(std::move(headset)));
}

/// The scripted surgeon, told by the display to digitize: presses, clicks and speaks.
std::unique_ptr<Headset> open_surgeon() {
  OpenOptions options;
  options.room = sim::scene::operating_room(12);
  options.sim.render = false;
  options.sim.frame_rate_hz = 10.0;
  options.sim.limit_s = 14.0;
  options.sim.error_model.pace = 4.0;
  options.sim.surgeon = sim::ScriptedSurgeon::bring;
  return std::make_unique<Prompting>(checked(open_headset("sim:?seed=11", options)),
                                     engine::StepOnDisplay{engine::Step::kDigitize, "L3", {}});
}

/// The scripted headset with a clicker from elsewhere: recorded events that begin with its clock.
std::unique_ptr<Headset> open_joined() {
  auto folder = std::make_unique<TemporaryFolder>();
  EventBytes bytes;
  for (const int t : {0, 40, 80}) {
    bytes.key(KEY_ENTER, 1, std::chrono::milliseconds(t));
    bytes.key(KEY_ENTER, 0, std::chrono::milliseconds(t + 20));
  }
  auto inner = open_fake();
  auto clicker = open_clicker("evdev:" + folder->with("events", bytes.bytes()), inner->clock());
  EXPECT_TRUE(clicker.ok()) << clicker.error().message;
  auto joined = std::make_unique<JoinedHeadset>(*inner, OtherParts{*std::move(clicker), nullptr});
  return keeping(std::make_pair(std::move(folder), std::move(inner)), std::move(joined));
}

/// The scripted headset and its wrappers have two, and so has StreamRecorder's folder.
std::size_t depth_cameras_of(const std::string& name) {
  const std::set<std::string> with_depth = {"fake",     "faultless",       "allowed_faults",
                                            "recorder", "joined",          "openxr",
                                            "replay",   "stream_recorder", "sim_depth"};
  return with_depth.count(name) == 0 ? 0 : 2;
}

/// Two tools, of which the second is out of sight now and then.
std::unique_ptr<Headset> open_scripted_tools() {
  fake::Script script;
  script.tools = {"pointer", "reference"};
  for (int i = 0; i < 12; ++i) {
    ToolPoses poses;
    poses.sequence = i;
    poses.time = scripted_time(i);
    poses.world_from_rig = Transform<World, Rig>{};
    poses.tools.resize(2);
    for (std::size_t tool = 0; tool < (i % 4 == 3 ? 1u : 2u); ++tool) {
      poses.tools[tool] = {{Mat3::identity(), {0.001 * i, 0.1 * static_cast<double>(tool), 1.0}},
                           poses.time,
                           PoseStatus::kMeasured,
                           {}};
      poses.tools[tool].covariance[0] = 1e-8;
    }
    script.tool_poses.emplace_back(poses);
    if (i == 5) {
      script.tool_poses.emplace_back(Next::kNone);
    }
  }
  return std::make_unique<fake::FakeHeadset>(std::move(script));
}

std::unique_ptr<Headset> open_tools_with_allowed_faults() {
  auto inner = open_scripted_tools();
  fake::Faults faults;
  faults.tool_poses = {{1, fake::ToolPoseFault::kLost},
                       {2, fake::ToolPoseFault::kDrop},
                       {4, fake::ToolPoseFault::kDelay}};
  auto failing = std::make_unique<fake::FailingHeadset>(*inner, std::move(faults));
  return keeping(std::move(inner), std::move(failing));
}

/// Sends two tools until it ends.
class Sender {
 public:
  Sender()
      : thread_([this] {
          double stamp_s = 1.7e9;
          const Stopwatch watch;
          while (!over_) {
            stamp_s = 1.7e9 + 1e-3 * watch.elapsed_ms();
            for (const char* tool : {"ProbeToTracker", "ReferenceToTracker"}) {
              server_.add(tool, {Mat3::identity(), {1e-6 * watch.elapsed_ms(), 0.1, 1.0}}, stamp_s);
            }
            server_.send();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
          }
        }) {}
  ~Sender() {
    over_ = true;
    thread_.join();
  }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;
  [[nodiscard]] std::string uri() const {
    return "igtl:" + server_.uri("pointer=ProbeToTracker&reference=ReferenceToTracker");
  }

 private:
  PoseServer server_;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

std::unique_ptr<Headset> open_igtl() {
  auto sender = std::make_unique<Sender>();
  auto headset = checked(open_headset(sender->uri()));
  return headset ? keeping(std::move(sender), std::move(headset)) : nullptr;
}

/// Opens what was recorded of a headset to its end, which is recorded once for all tests.
std::unique_ptr<Headset> open_replayed(const std::string& name,
                                       const std::function<std::unique_ptr<Headset>()>& open) {
  static std::map<std::string, TemporaryFolder> recordings;
  const auto [recording, is_new] = recordings.try_emplace(name);
  const auto session = recording->second / "session";
  if (is_new) {
    auto recorder = replay::RecordingHeadset::create(open(), session);
    EXPECT_TRUE(recorder.ok());
    play(**recorder);
    EXPECT_TRUE((*recorder)->close().ok());
  }
  return checked(open_headset("replay:" + session.string()));
}

}  // namespace

std::vector<DeviceCase> device_cases() {
  std::vector<DeviceCase> cases = {
      {"fake", open_fake},
      {"faultless", open_faultless},
      {"allowed_faults", open_with_allowed_faults},
      {"recorder", open_recorder},
      {"joined", open_joined},
      {"openxr", open_openxr},
      {"replay", [] { return open_replayed("fake", open_fake); }},
      {"stream_recorder", open_stream_recorder, false},
      {"sim", open_sim, false},
      {"sim_depth", open_sim_with_depth, false},
      {"replayed_sim", [] { return open_replayed("sim", open_sim); }, false},
      {"hl2ss_raw", [] { return open_served_sim("raw"); }, false},
      {"hl2ss_h264", [] { return open_served_sim("h264"); }, false},
      {"replayed_hl2ss",
       [] { return open_replayed("hl2ss", [] { return open_served_sim("raw"); }); }, false},
      {"surgeon", open_surgeon, true, false},
      {"replayed_surgeon", [] { return open_replayed("surgeon", open_surgeon); }, true, false}};
  const std::pair<const char*, std::unique_ptr<Headset> (*)()> measuring[] = {
      {"scripted_tools", open_scripted_tools},
      {"tools_with_allowed_faults", open_tools_with_allowed_faults},
      {"igtl", open_igtl}};
  for (const auto& [name, open] : measuring) {
    DeviceCase& device = cases.emplace_back(DeviceCase{name, open, false});
    device.measures_tools = true;
  }
  for (DeviceCase& device : cases) {
    device.depth_cameras = depth_cameras_of(device.name);
  }
  return cases;
}

}  // namespace orthonav::test
