#include "hal/desktop/evdev_clicker.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libevdev/libevdev-uinput.h>
#include <libevdev/libevdev.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>

#include "hal/fake/scripted.h"
#include "tests/support/event_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace orthonav::desktop {
namespace {

using enum ClickerAction;
using orthonav::test::EventBytes;
using orthonav::test::TemporaryFolder;
using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Timestamp ms(int t) { return Timestamp(milliseconds(t)); }

/// A recorded file on a clock that stands at 10 s when it is opened; times are those after it.
class RecordedClicker : public ::testing::Test {
 protected:
  std::vector<ClickerEvent> all(const EventBytes& bytes, int until_ms) {
    options_.device = folder_.with("events", bytes.bytes());
    auto clicker = EvdevClicker::open(options_, clock_);
    EXPECT_TRUE(clicker.ok()) << clicker.error().message;
    std::vector<ClickerEvent> events;
    // Polled as a frame loop does; the answers must not depend on it.
    for (int t = 0; clicker && t <= until_ms; t += 7) {
      EXPECT_TRUE((*clicker)->poll(ms(10000 + t), events).ok());
    }
    for (ClickerEvent& event : events) {
      event.time -= milliseconds(10000);
    }
    return events;
  }
  static EventBytes from_zero() { return EventBytes().key(KEY_F24, 0, milliseconds(0)); }

  TemporaryFolder folder_;
  fake::ManualClock clock_{Timestamp(std::chrono::seconds(10))};
  ClickerOptions options_;
};

TEST_F(RecordedClicker, MakesAClickOfAKeyThatGoesDownAndUp) {
  auto bytes = from_zero();
  bytes.key(KEY_VOLUMEUP, 1, milliseconds(100)).key(KEY_VOLUMEUP, 0, milliseconds(180));
  EXPECT_THAT(all(bytes, 300),
              ElementsAre(ClickerEvent{kPress, ms(100)}, ClickerEvent{kRelease, ms(180)},
                          ClickerEvent{kClick, ms(180)}));
}

TEST_F(RecordedClicker, MakesADoubleClickWithinTheTimeChosen) {
  auto bytes = from_zero();
  for (const int t : {100, 350}) {
    bytes.key(KEY_ENTER, 1, milliseconds(t)).key(KEY_ENTER, 0, milliseconds(t + 60));
  }
  EXPECT_EQ(all(bytes, 600).back().action, kDoubleClick);
  options_.double_within = milliseconds(200);
  EXPECT_EQ(all(bytes, 600).back().action, kClick);
}

TEST_F(RecordedClicker, HoldsAKeyThatRepeats) {
  auto bytes = from_zero();
  bytes.key(BTN_0, 1, milliseconds(100));
  for (int t = 150; t < 800; t += 50) {
    bytes.key(BTN_0, 2, milliseconds(t));
  }
  bytes.key(BTN_0, 0, milliseconds(800));
  EXPECT_THAT(all(bytes, 900),
              ElementsAre(ClickerEvent{kPress, ms(100)}, ClickerEvent{kHold, ms(600)},
                          ClickerEvent{kRelease, ms(800)}));
}

TEST_F(RecordedClicker, SwallowsTheBounceOfAContact) {
  auto bytes = from_zero();
  for (const int t : {100, 104, 109}) {
    bytes.key(KEY_SPACE, 1, milliseconds(t)).key(KEY_SPACE, 0, milliseconds(t + 2));
  }
  bytes.key(KEY_SPACE, 1, milliseconds(115)).key(KEY_SPACE, 0, milliseconds(200));
  EXPECT_THAT(all(bytes, 400),
              ElementsAre(ClickerEvent{kPress, ms(100)}, ClickerEvent{kRelease, ms(200)},
                          ClickerEvent{kClick, ms(200)}));
  options_.debounce = Duration::zero();
  EXPECT_GT(all(bytes, 400).size(), 3u);
}

TEST_F(RecordedClicker, TakesSeveralKeysForOneButton) {
  auto bytes = from_zero();
  bytes.key(KEY_VOLUMEUP, 1, milliseconds(100)).key(KEY_ENTER, 1, milliseconds(110));
  bytes.key(KEY_VOLUMEUP, 0, milliseconds(150)).key(KEY_ENTER, 0, milliseconds(190));
  EXPECT_THAT(all(bytes, 400),
              ElementsAre(ClickerEvent{kPress, ms(100)}, ClickerEvent{kRelease, ms(190)},
                          ClickerEvent{kClick, ms(190)}));
}

TEST_F(RecordedClicker, IgnoresKeysThatWereNotChosen) {
  auto bytes = from_zero();
  bytes.key(KEY_A, 1, milliseconds(100)).key(KEY_A, 0, milliseconds(150));
  EXPECT_THAT(all(bytes, 400), IsEmpty());
  options_.keys.codes = {KEY_A};
  EXPECT_EQ(all(bytes, 400).size(), 3u);
}

TEST_F(RecordedClicker, RefusesATimeThatCannotBe) {
  options_.device = folder_.with("events", EventBytes().key(KEY_A, 1, milliseconds(-1)).bytes());
  auto clicker = EvdevClicker::open(options_, clock_);
  ASSERT_TRUE(clicker.ok());
  std::vector<ClickerEvent> events;
  const Status polled = (*clicker)->poll(clock_.now(), events);
  ASSERT_FALSE(polled.ok());
  EXPECT_THAT(polled.error().message, HasSubstr("is not the time of an event"));
}

TEST_F(RecordedClicker, WaitsForTheRestOfAnEvent) {
  const std::string path = folder_.file("fifo");
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  options_.device = path;
  auto clicker = EvdevClicker::open(options_, clock_);
  ASSERT_TRUE(clicker.ok()) << clicker.error().message;
  const int writer = ::open(path.c_str(), O_WRONLY | O_NONBLOCK);
  ASSERT_GE(writer, 0);
  const auto now = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now().time_since_epoch());
  const std::string bytes = EventBytes().key(KEY_ENTER, 1, now).bytes();
  std::vector<ClickerEvent> events;
  ASSERT_EQ(::write(writer, bytes.data(), 10), 10);
  ASSERT_TRUE((*clicker)->poll(ms(20000), events).ok());
  EXPECT_THAT(events, IsEmpty());
  const auto rest = static_cast<ssize_t>(bytes.size() - 10);
  ASSERT_EQ(::write(writer, bytes.data() + 10, bytes.size() - 10), rest);
  ASSERT_TRUE((*clicker)->poll(ms(20000), events).ok());
  ::close(writer);
  ASSERT_FALSE(events.empty());
  // On the headset's clock it is as old as on the kernel's.
  EXPECT_LE(events.front().time, clock_.now());
  EXPECT_GT(events.front().time, clock_.now() - std::chrono::seconds(5));
}

TEST(ClickerOptionsCheck, TellsEveryProblemAtOnce) {
  ClickerOptions options;
  options.keys.codes.clear();
  options.debounce = milliseconds(500);
  options.double_within = Duration::zero();
  EXPECT_EQ(options.check().size(), 3u);
  EXPECT_THAT(ClickerOptions().check(), IsEmpty());
}

TEST(KeyCode, KnowsKeysByTheirNames) {
  EXPECT_EQ(key_code("enter"), KEY_ENTER);
  EXPECT_EQ(key_code("KEY_VOLUMEUP"), KEY_VOLUMEUP);
  EXPECT_EQ(key_code("btn_0"), BTN_0);
  EXPECT_LT(key_code("nothing"), 0);
}

TEST(EvdevKeys, RefusesWhatIsNoEventDevice) {
  const auto keys = open_evdev_keys("/dev/null", {clicker_keys(), true});
  ASSERT_FALSE(keys.ok());
  EXPECT_THAT(keys.error().message, HasSubstr("/dev/null: is not an event device"));
}

/// A device that appears after the clicker was opened, and disappears again.
TEST(EvdevClicker, TakesUpADeviceThatIsPluggedIn) {
  if (::access("/dev/uinput", W_OK) != 0) {
    GTEST_SKIP() << "no /dev/uinput that may be written";
  }
  const fake::ManualClock clock;
  ClickerOptions options;
  options.device = "orthonav test clicker";
  auto clicker = EvdevClicker::open(options, clock);
  ASSERT_TRUE(clicker.ok()) << clicker.error().message;
  libevdev* description = libevdev_new();
  libevdev_set_name(description, options.device.c_str());
  libevdev_enable_event_code(description, EV_KEY, KEY_VOLUMEUP, nullptr);
  libevdev_uinput* device = nullptr;
  ASSERT_EQ(libevdev_uinput_create_from_device(description, LIBEVDEV_UINPUT_OPEN_MANAGED, &device),
            0);
  std::vector<ClickerEvent> events;
  const auto polled_until = [&](const auto& done) {
    return orthonav::test::wait_until([&] {
      (void)(*clicker)->poll(Timestamp(std::chrono::hours(1)), events);
      return done();
    });
  };
  EXPECT_TRUE(polled_until([&] { return !(*clicker)->device_name().empty(); }));
  EXPECT_EQ((*clicker)->device_name(), options.device);
  libevdev_uinput_write_event(device, EV_KEY, KEY_VOLUMEUP, 1);
  libevdev_uinput_write_event(device, EV_SYN, SYN_REPORT, 0);
  EXPECT_TRUE(polled_until([&] { return !events.empty(); }));
  libevdev_uinput_destroy(device);
  libevdev_free(description);
  ASSERT_TRUE(polled_until([&] { return events.size() >= 2; }));
  EXPECT_EQ(events[0].action, kPress);
  EXPECT_EQ(events[1].action, kRelease);
}

}  // namespace
}  // namespace orthonav::desktop
