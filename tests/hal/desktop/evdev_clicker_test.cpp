#include "hal/desktop/evdev_clicker.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libevdev/libevdev-uinput.h>
#include <libevdev/libevdev.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <filesystem>
#include <utility>

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
  bytes.key(KEY_ENTER, 1, milliseconds(200)).key(KEY_ENTER, 0, milliseconds(250));
  EXPECT_EQ(all(bytes, 400).front(), (ClickerEvent{kPress, ms(200)}));
  options_.keys.codes = {KEY_A};
  EXPECT_EQ(all(bytes, 400).front(), (ClickerEvent{kPress, ms(100)}));
}

TEST_F(RecordedClicker, PlaysALongRecordingToItsEnd) {
  auto bytes = from_zero();
  constexpr int kClicks = 1500;
  for (int i = 0; i < kClicks; ++i) {
    bytes.key(KEY_ENTER, 1, milliseconds(1000 * i)).key(KEY_ENTER, 0, milliseconds(1000 * i + 60));
  }
  options_.device = folder_.with("events", bytes.bytes());
  auto clicker = EvdevClicker::open(options_, clock_);
  ASSERT_TRUE(clicker.ok()) << clicker.error().message;
  std::vector<ClickerEvent> events;
  for (int t = 0; t <= 1000 * kClicks; t += 500) {
    ASSERT_TRUE((*clicker)->poll(ms(10000 + t), events).ok());
  }
  EXPECT_EQ(events.size(), 3u * kClicks);
}

TEST_F(RecordedClicker, SaysAtOnceWhatIsWrongWithAFile) {
  const auto refusal_of = [&](const std::string& device) {
    options_.device = device;
    const auto clicker = EvdevClicker::open(options_, clock_);
    return clicker.ok() ? "taken" : clicker.error().message;
  };
  const auto refusal = [&](const std::string& bytes) {
    return refusal_of(folder_.with("events", bytes));
  };
  const auto pressed_at = [](std::chrono::microseconds at) {
    return from_zero().key(KEY_ENTER, 1, at);
  };
  EXPECT_EQ(refusal(pressed_at(milliseconds(10)).bytes()), "taken");
  EXPECT_THAT(refusal_of(folder_.file("nothing")), HasSubstr("nothing: No such file"));
  EXPECT_THAT(refusal_of("./nothing"), HasSubstr("./nothing: No such file"));
  EXPECT_THAT(refusal_of(folder_.path().string()), HasSubstr("neither an event device nor a file"));
  EXPECT_THAT(refusal(""), HasSubstr("holds 0 bytes, not input events of 24 bytes each"));
  EXPECT_THAT(refusal(pressed_at(milliseconds(10)).bytes() + "x"), HasSubstr("holds 97 bytes"));
  EXPECT_THAT(refusal(std::string(240, 'x')), HasSubstr("is not the time of an event"));
  EXPECT_THAT(refusal(EventBytes().key(KEY_ENTER, 1, milliseconds(-1)).bytes()),
              HasSubstr("is not the time of an event"));
  EXPECT_THAT(refusal(from_zero().key(KEY_A, 1, milliseconds(10)).bytes()),
              HasSubstr("none of the chosen keys is pressed in it"));
  // The recorder changed the device's clock, or the clock was set.
  EXPECT_EQ(refusal(pressed_at(std::chrono::hours(24)).bytes()), "taken");
  EXPECT_THAT(refusal(pressed_at(std::chrono::hours(24) + milliseconds(1)).bytes()),
              HasSubstr("event 3 is stamped 86400.001 s, the one before it 0.000 s: the clock"));
  EXPECT_THAT(refusal(pressed_at(milliseconds(10)).key(KEY_ENTER, 0, milliseconds(9)).bytes()),
              HasSubstr("event 5 is stamped 0.009 s, the one before it 0.010 s"));
}

TEST_F(RecordedClicker, IsFoundInTheWorkingFolderToo) {
  const auto before = std::filesystem::current_path();
  (void)folder_.with("events", from_zero().key(KEY_ENTER, 1, milliseconds(10)).bytes());
  std::filesystem::current_path(folder_.path());
  options_.device = "events";
  auto clicker = EvdevClicker::open(options_, clock_);
  std::filesystem::current_path(before);
  ASSERT_TRUE(clicker.ok()) << clicker.error().message;
  std::vector<ClickerEvent> events;
  ASSERT_TRUE((*clicker)->poll(ms(10400), events).ok());
  EXPECT_FALSE(events.empty());
}

TEST_F(RecordedClicker, SaysThatADeviceIsNotThere) {
  options_.folder = folder_.path().string();
  const auto why = [&](const std::string& device) {
    options_.device = device;
    auto clicker = EvdevClicker::open(options_, clock_);
    EXPECT_TRUE(clicker.ok()) << "it may be plugged in later: " << clicker.error().message;
    std::vector<ClickerEvent> events;
    for (int again = 0; again < 2; ++again) {
      const Status polled = (*clicker)->poll(clock_.now(), events);
      EXPECT_EQ(polled.error().code, ErrorCode::kUnavailable);
    }
    return (*clicker)->poll(clock_.now(), events).error().message;
  };
  EXPECT_THAT(why(""), HasSubstr("no device in " + options_.folder + " suits"));
  EXPECT_THAT(why("Pedal"), HasSubstr("no device in " + options_.folder + " is called \"Pedal\""));
  EXPECT_THAT(why("/dev/input/event999"), HasSubstr("/dev/input/event999: is not plugged in"));
  (void)folder_.with("event7", "no device");
  EXPECT_THAT(why(""), HasSubstr("event7: is not an event device"));
}

/// A FIFO that a test writes to.
class PipedClicker : public RecordedClicker {
 protected:
  PipedClicker() {
    options_.device = folder_.file("fifo");
    EXPECT_EQ(::mkfifo(options_.device.c_str(), 0600), 0);
    auto clicker = EvdevClicker::open(options_, clock_);
    EXPECT_TRUE(clicker.ok()) << clicker.error().message;
    clicker_ = *std::move(clicker);
    writer_ = ::open(options_.device.c_str(), O_WRONLY | O_NONBLOCK);
    EXPECT_GE(writer_, 0);
  }
  ~PipedClicker() override { close(); }
  void close() {
    if (writer_ >= 0) {
      ::close(std::exchange(writer_, -1));
    }
  }
  void write(const std::string& bytes) {
    ASSERT_EQ(::write(writer_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  /// Until the newest event has lasted.
  Status poll() { return clicker_->poll(clock_.now() + milliseconds(100), events_); }
  static std::chrono::microseconds now(clockid_t id) {
    timespec now{};
    ::clock_gettime(id, &now);
    return std::chrono::seconds(now.tv_sec) + std::chrono::microseconds(now.tv_nsec / 1000);
  }

  std::unique_ptr<EvdevClicker> clicker_;
  int writer_ = -1;
  std::vector<ClickerEvent> events_;
};

TEST_F(PipedClicker, WaitsForTheRestOfAnEvent) {
  const std::string bytes = EventBytes().key(KEY_ENTER, 1, now(CLOCK_MONOTONIC)).bytes();
  write(bytes.substr(0, 10));
  ASSERT_TRUE(poll().ok());
  EXPECT_THAT(events_, IsEmpty());
  write(bytes.substr(10));
  ASSERT_TRUE(poll().ok());
  EXPECT_EQ(events_.front().action, kPress);
}

TEST_F(PipedClicker, IsAsOldOnTheHeadsetsClockByWhicheverClockItIsStamped) {
  for (const clockid_t id : {CLOCK_REALTIME, CLOCK_MONOTONIC, CLOCK_BOOTTIME}) {
    const auto at = now(id) - milliseconds(100);
    write(EventBytes().key(KEY_ENTER, 1, at).key(KEY_ENTER, 0, at + milliseconds(60)).bytes());
    events_.clear();
    ASSERT_TRUE(poll().ok());
    ASSERT_EQ(events_.size(), 3u) << id;
    EXPECT_LE(events_[0].time, clock_.now() - milliseconds(100));
    EXPECT_GT(events_[0].time, clock_.now() - std::chrono::seconds(5));
    clock_.advance(std::chrono::seconds(5));
  }
}

TEST_F(PipedClicker, NamesAnEventOfNoClockHere) {
  for (const clockid_t id : {CLOCK_REALTIME, CLOCK_MONOTONIC}) {
    write(EventBytes().key(KEY_ENTER, 1, now(id) - std::chrono::seconds(11)).bytes());
    const Status late = poll();
    ASSERT_FALSE(late.ok());
    EXPECT_THAT(late.error().message,
                HasSubstr("is not of the last 10 s, neither by the realtime"));
    write(EventBytes().key(KEY_ENTER, 1, now(id) + std::chrono::seconds(5)).bytes());
    EXPECT_THAT(poll().error().message, HasSubstr("is not of the last 10 s"));
    EXPECT_TRUE(poll().ok()) << "the next may be right";
    EXPECT_THAT(events_, IsEmpty());
  }
  write(EventBytes().key(KEY_ENTER, 1, now(CLOCK_REALTIME) - std::chrono::seconds(5)).bytes());
  EXPECT_TRUE(poll().ok());
  EXPECT_EQ(events_.front().action, kPress);
}

TEST_F(PipedClicker, ReleasesAKeyBeforeItNamesAnEventThatIsRefused) {
  write(EventBytes().key(KEY_ENTER, 1, now(CLOCK_REALTIME)).bytes());
  ASSERT_TRUE(poll().ok());
  write(EventBytes().key(KEY_ENTER, 0, milliseconds(0)).bytes());
  ASSERT_TRUE(poll().ok());
  EXPECT_EQ(events_.back().action, kClick) << "let go";
  EXPECT_THAT(poll().error().message,
              HasSubstr("an event stamped 0.000 s is not of the last 10 s"));
  EXPECT_TRUE(poll().ok());
}

TEST_F(PipedClicker, SaysThatNobodyWritesUntilSomebodyDoes) {
  EXPECT_TRUE(poll().ok());
  close();
  EXPECT_EQ(poll().error().code, ErrorCode::kUnavailable);
  EXPECT_THAT(poll().error().message, HasSubstr("fifo: nobody writes to it"));
  writer_ = ::open(options_.device.c_str(), O_WRONLY | O_NONBLOCK);
  EXPECT_TRUE(poll().ok());
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
    GTEST_SKIP() << "needs /dev/uinput, writable";
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
  Status found = Error{"not polled"};
  const auto polled_until = [&](const auto& done) {
    return orthonav::test::wait_until([&] {
      found = (*clicker)->poll(Timestamp(std::chrono::hours(1)), events);
      return done();
    });
  };
  EXPECT_TRUE(polled_until([&] { return found.ok(); }));
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
