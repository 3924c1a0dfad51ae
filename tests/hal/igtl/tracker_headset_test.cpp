#include "hal/igtl/tracker_headset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "base/stopwatch.h"
#include "hal/api/tool_pose_source.h"
#include "tests/support/pose_server.h"

namespace orthonav::igtl::tracker_headset_test {
namespace {

using orthonav::test::PoseServer;
using orthonav::test::wait_until;
using ::testing::AllOf;
using ::testing::HasSubstr;

Transform<World, Marker> moved(Vec3 by_m) { return {Mat3::identity(), by_m}; }

std::string refusal(const std::string& after_scheme) {
  const auto options = tracker_options_of(after_scheme);
  EXPECT_FALSE(options.ok()) << after_scheme;
  return options ? "" : options.error().message;
}

TEST(IgtlTrackerUri, NamesHostPortToolsAndWhatIsStatedOfThem) {
  const auto options = tracker_options_of(
      "//10.0.0.5?pointer=ProbeToTracker&reference=ReferenceToTracker&rms_mm=0.25&rms_deg=0.3"
      "&frozen_ms=0");
  ASSERT_TRUE(options.ok()) << options.error().message;
  EXPECT_EQ(options->host, "10.0.0.5");
  EXPECT_EQ(options->port, 18944);
  ASSERT_EQ(options->tools.size(), 2u);
  EXPECT_EQ(options->tools[1].tool, "reference");
  EXPECT_EQ(options->tools[1].transform, "ReferenceToTracker");
  EXPECT_NEAR(translation_sigma_m(options->covariance()), 0.00025, 1e-12);
  EXPECT_NEAR(rotation_sigma_rad(options->covariance()), 0.3 * kRadiansPerDegree, 1e-12);
  EXPECT_EQ(options->frozen_after, Duration::zero());
  EXPECT_EQ(tracker_options_of("//[::1]:7?a=AToB")->port, 7);
  EXPECT_EQ(tracker_options_of("//[::1]?a=AToB")->host, "::1");
  EXPECT_EQ(tracker_options_of("//h?port=18945&a=AToB")->port, 18945) << "which is no tool";
}

TEST(IgtlTrackerUri, RefusesWhatItCantMean) {
  EXPECT_THAT(refusal("10.0.0.5"), HasSubstr("is followed by //HOST"));
  EXPECT_THAT(refusal("//?a=AToB"), HasSubstr("names no host"));
  EXPECT_THAT(refusal("//h"), HasSubstr("names no tool"));
  EXPECT_THAT(refusal("//h?rms_mm=1"), HasSubstr("names no tool"));
  EXPECT_THAT(refusal("//h:0?a=AToB"), HasSubstr("port \"0\" must be"));
  EXPECT_THAT(refusal("//h:1x?a=AToB"), HasSubstr("port \"1x\" must be"));
  EXPECT_THAT(refusal("//h?a=AToB&port=0"), HasSubstr("port \"0\" must be"));
  EXPECT_THAT(refusal("//h:1?a=AToB&port=2"), HasSubstr("\"port\" is given twice"));
  EXPECT_THAT(refusal("//h?port=1&a=AToB&port=1"), HasSubstr("\"port\" is given twice"));
  EXPECT_THAT(refusal("//::1?a=AToB"), HasSubstr("in brackets"));
  EXPECT_THAT(refusal("//h?a"), HasSubstr("\"a\" must name a transform"));
  EXPECT_THAT(refusal("//h?a=AToB&a=CToB"), HasSubstr("given twice"));
  EXPECT_THAT(refusal("//h?a=AToB&b=AToB"), HasSubstr("a and b can't both be AToB"));
  EXPECT_THAT(refusal("//h?a=AToB&rms_mm=0"), HasSubstr("rms_mm \"0\" must be"));
  EXPECT_THAT(refusal("//h?a=AToB&rms_deg=nan"), HasSubstr("rms_deg \"nan\" must be"));
  EXPECT_THAT(refusal("//h?a=AToB&frozen_ms=-1"), HasSubstr("frozen_ms \"-1\" must lie"));
}

TEST(IgtlTrackerUri, TakesToolsThatAreInOneFrame) {
  for (const char* tools :
       {"a=StylusToTracker&b=ReferenceToTracker", "a=StylusToReference&b=GuideToReference",
        "a=Stylus&b=Guide&c=Tool", "a=Tracker0&b=Tracker1", "a=stylustotracker&b=reftotracker",
        "a=AToBToC", "a=ScrewdriverTipToTracker&b=RefToTracker"}) {
    const auto options = tracker_options_of(std::string("//h?") + tools);
    EXPECT_TRUE(options.ok()) << options.error().message;
  }
}

TEST(IgtlTrackerUri, RefusesToolsInDifferentFramesByName) {
  EXPECT_EQ(refusal("//h?pointer=StylusToReference&reference=ReferenceToTracker"),
            "the tools are in different frames: pointer=StylusToReference in \"Reference\", "
            "reference=ReferenceToTracker in \"Tracker\"; they must be in one, the tracker's own: "
            "name transforms to that frame, and have the sender send them (PlusServer: "
            "TransformNames)");
  for (const char* tools :
       {"a=StylusToTracker&b=TrackerToReference", "a=StylusToGuide&b=GuideToTracker",
        "a=AToB&b=CToB&c=DToE", "a=stylustoreference&b=referencetotracker",
        "a=stylustotracker&b=ReferenceToTracker", "a=StylusToTracker&b=ReferenceToTRACKER",
        "a=Stylus&b=ReferenceToTracker", "a=ScrewdriverTipToTrac&b=RefToTracker"}) {
    EXPECT_THAT(refusal(std::string("//h?") + tools), HasSubstr("are in different frames: a="));
  }
  EXPECT_THAT(refusal("//h?a=AToBToC&b=DToC"), HasSubstr("a=AToBToC says \"To\" more than once"));
  EXPECT_THAT(refusal("//h?a=StylusToReference&b=ReferenceToReference"),
              HasSubstr("b=ReferenceToReference is no pose: of a frame in itself"));
  EXPECT_THAT(refusal("//h?a=ScrewdriverHandleToTracker&b=ScrewdriverHandleToTool"),
              HasSubstr("a and b can't both be ScrewdriverHandleToT"));
}

/// A tracker that sends, and the headset that represents it.
class IgtlTracker : public ::testing::Test {
 protected:
  void open(const std::string& keys = "pointer=ProbeToTracker&reference=ReferenceToTracker") {
    const auto options = tracker_options_of(server_->uri(keys)).value();
    // Opening waits for the first pose.
    std::thread first([this] {
      if (server_->wait_for_client()) {
        send(0.001);
      }
    });
    auto opened = open_tracker(options);
    first.join();
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    headset_ = std::move(*opened);
    ASSERT_TRUE(take());
  }
  void send(double x_m) {
    stamp_s_ += 0.033;
    server_->add("ProbeToTracker", moved({x_m, 0.0, -1.0}), stamp_s_);
    server_->add("ReferenceToTracker", moved({0.5, x_m, -1.0}), stamp_s_);
    server_->send();
  }
  /// Waits for the next frame that holds tools.
  bool take() {
    return wait_until([this] {
      const auto next = headset_->tool_poses()->next(frame_);
      lost_ += next ? 0 : 1;
      return next && *next == Next::kFrame && sees_any();
    });
  }

  [[nodiscard]] bool sees_any() const {
    return std::any_of(frame_.tools.begin(), frame_.tools.end(),
                       [](const auto& tool) { return tool.status == PoseStatus::kMeasured; });
  }

  std::unique_ptr<PoseServer> server_ = std::make_unique<PoseServer>();
  std::unique_ptr<Headset> headset_;
  ToolPoses frame_;
  double stamp_s_ = 1.7e9;
  int lost_ = 0;  ///< times that it said so
};

TEST_F(IgtlTracker, IsAHeadsetWithoutCamerasThatMeasuresTools) {
  open("pointer=ProbeToTracker&reference=ReferenceToTracker&rms_mm=0.25");
  EXPECT_EQ(headset_->cameras(), nullptr);
  EXPECT_EQ(headset_->pixels(), nullptr);
  const auto names = headset_->tool_poses()->names();
  ASSERT_EQ(names.size(), 2u);
  EXPECT_EQ(names[0], "pointer");
  const Timestamp first = frame_.time;
  send(0.002);
  ASSERT_TRUE(take());
  EXPECT_GT(frame_.time, first);
  EXPECT_LE(frame_.time, headset_->clock().now());
  EXPECT_EQ(frame_.map_epoch, 0);
  EXPECT_EQ(frame_.world_from_rig, (Transform<World, Rig>{})) << "the tracker stands still";
  ASSERT_EQ(frame_.tools.size(), 2u);
  EXPECT_NEAR(frame_.tools[0].value.translation().x, 0.002, 1e-8);
  EXPECT_NEAR(frame_.tools[1].value.translation().y, 0.002, 1e-8);
  EXPECT_NEAR(translation_sigma_m(frame_.tools[0].covariance), 0.00025, 1e-9) << "as stated";
  EXPECT_EQ(headset_->head().world_from_rig(frame_.time).status, PoseStatus::kMeasured);
}

TEST_F(IgtlTracker, SkipsAMessageThatIsNoPoseAndCountsIt) {
  open();
  TransformValues mirrored = {-1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  server_->add(packed({"ProbeToTracker", 0}, mirrored));
  server_->add(packed_text({"Note", 0}, "what else it may send"));
  send(0.003);
  ASSERT_TRUE(take());
  EXPECT_EQ(frame_.tools.size(), 2u);
  const auto stream = headset_->connection()->streams.front();
  EXPECT_EQ(stream.damaged, 1);
  EXPECT_THAT(stream.last_trouble, HasSubstr("mirrors"));
}

TEST_F(IgtlTracker, SaysOnceThatItsConnectionIsLostAndGoesOnInAnotherMap) {
  open();
  const int port = server_->port();
  server_.reset();
  ASSERT_TRUE(wait_until([this] { return !headset_->tool_poses()->next(frame_); }));
  const auto next = headset_->tool_poses()->next(frame_);
  ASSERT_TRUE(next.ok()) << "told once";
  EXPECT_EQ(*next, Next::kNone);
  server_ = std::make_unique<PoseServer>(port);
  ASSERT_TRUE(server_->wait_for_client());
  stamp_s_ -= 1e6;  // another machine's clock
  send(0.004);
  ASSERT_TRUE(take());
  EXPECT_EQ(frame_.map_epoch, 1) << "nobody knows whether the tracker stands where it stood";
  EXPECT_EQ(lost_, 0);
}

TEST_F(IgtlTracker, HangsUpOnWhatIsNoOpenIgtLinkAndCallsAgain) {
  open();
  const std::string http =
      "HTTP/1.1 400 Bad Request\r\nContent-Type: text/html\r\nmore than 58\r\n";
  server_->add(std::vector<std::uint8_t>(http.begin(), http.end()));
  server_->send();
  ASSERT_TRUE(
      wait_until([this] { return headset_->connection()->streams.front().connections == 2; }));
  send(0.005);
  ASSERT_TRUE(take());
  EXPECT_EQ(lost_, 1);
}

TEST_F(IgtlTracker, SaysThatTheSendersClockWasSetAndGoesOnOnceItIsKnown) {
  open();
  const Stopwatch since;
  const double begun_s = stamp_s_;
  std::string said;
  ASSERT_TRUE(wait_until([&] {
    // Each message that came is followed by the next; the clock is set back by 3.5 s.
    stamp_s_ = begun_s - 3.5 + 1e-3 * since.elapsed_ms();
    const std::int64_t had = headset_->connection()->streams.front().packets;
    send(1e-6 * since.elapsed_ms());
    (void)wait_until([&] { return headset_->connection()->streams.front().packets >= had + 2; });
    const auto next = headset_->tool_poses()->next(frame_);
    EXPECT_TRUE(!next || *next != Next::kFrame || !sees_any()) << "its age is not known";
    said = next ? "" : next.error().message;
    return !next;
  }));
  EXPECT_THAT(said, AllOf(HasSubstr("igtl: 127.0.0.1: the sender's clock was set back by 3."),
                          HasSubstr("its poses were not used until it was known again")));
  EXPECT_EQ(headset_->connection()->clock_restarts, 1);
  stamp_s_ = begun_s - 3.5 + 1e-3 * since.elapsed_ms();
  send(0.006);
  ASSERT_TRUE(take());
  EXPECT_EQ(frame_.map_epoch, 0) << "the tracker stands where it stood";
}

/// The final result of opening; it is tried again if the machine was too busy.
bool is_refused_with(TrackerOptions options, const std::string& why) {
  options.open_within = std::chrono::milliseconds(100);
  return wait_until([&] {
    const auto opened = open_tracker(options);
    return !opened && opened.error().message.find(why) != std::string::npos;
  });
}

TEST_F(IgtlTracker, ThatSendsOthersIsRefusedWithTheirNames) {
  const auto options = tracker_options_of(server_->uri("pointer=StylusToTracker")).value();
  std::atomic<bool> over = false;
  std::thread sender([&] {
    while (!over) {
      send(0.001);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  EXPECT_TRUE(is_refused_with(options,
                              "no pose of StylusToTracker within 0 s: it sends ProbeToTracker, "
                              "ReferenceToTracker"));
  over = true;
  sender.join();
}

TEST_F(IgtlTracker, ThatNobodyRunsIsRefusedWithTheReason) {
  const auto options = tracker_options_of(server_->uri("pointer=ProbeToTracker")).value();
  server_.reset();
  EXPECT_TRUE(is_refused_with(options, "refused"));
}

}  // namespace
}  // namespace orthonav::igtl::tracker_headset_test
