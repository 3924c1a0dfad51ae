#include "tests/tools/preview/window_bench.h"

namespace orthonav::preview::window_test {
namespace {

using ::testing::HasSubstr;

// The planned trajectory, over the drapes.
constexpr std::array<int, 3> kGreen = {64, 232, 96};

TEST_F(WindowTest, ShowsAnOperationFromStrokesToGuidanceAndHidesWhatIsUnchecked) {
  write("script", R"(key tab
first digitize L5
screenshot digitize.png
key p
first verify L5
screenshot verify.png
key 1
screenshot verify-without-path.png
key 1
key p
until landmark L5
first guide L5 left
screenshot guide.png
key 4
screenshot guide-without-trajectory.png
key 4
screenshot guide-again
key o
drag 30 10
screenshot orbit.png
key o
key tab
screenshot panel.png
key h
wait 2
screenshot help.png
)");
  ASSERT_EQ(shell("$preview --speed 0 --script script"), 0) << content("out");
  const RgbaImage guide = picture("guide.png");
  // The status line has green dots of its own.
  const RgbaImage without = picture("guide-without-trajectory.png");
  EXPECT_GT(coloured(guide, kGreen), coloured(without, kGreen) + 25u);
  EXPECT_LT(different(guide, without), 3000u);
  EXPECT_TRUE(guide == picture("guide-again.png"));
  // The path is dimmed while there are places to check.
  EXPECT_GT(different(picture("verify.png"), picture("verify-without-path.png")), 150u);
  EXPECT_GT(different(picture("digitize.png"), picture("verify.png")), 2000u);
  EXPECT_GT(different(guide, picture("orbit.png")), 20000u);
  EXPECT_GT(different(guide, picture("panel.png")), 20000u);
  EXPECT_GT(different(picture("panel.png"), picture("help.png")), 2000u);
}

TEST_F(WindowTest, KeepsAnOperationAndGoesOnWithIt) {
  write("begun", "until digitize L5\npairs 10\n");
  write("ten-pairs", "pairs 10\n");
  ASSERT_EQ(shell("$preview --speed 0 --keep kept --script begun &&"
                  "$preview --speed 0 --resume kept --script ten-pairs"),
            0)
      << content("out");
  EXPECT_THAT(content("out"),
              HasSubstr("resuming kept/operation.resume: case 'phantom', levels L5"));
  EXPECT_NE(shell("$preview --speed 0 --seed 2 --resume kept --script ten-pairs"), 0);
  EXPECT_THAT(content("out"), HasSubstr("is of the simulated patient 'seed 1', not of 'seed 2'"));
  EXPECT_NE(shell("$preview --speed 0 --resume other --script ten-pairs"), 0);
  EXPECT_THAT(content("out"), HasSubstr("--resume: other: cannot be opened"));
}

TEST_F(WindowTest, HearsWhatIsTypedInsteadOfTheSurgeon) {
  // The surgeon says "start" within a second; unheard, nothing begins.
  write("script", "key u\npairs 150\nuntil setup\nkey s\nuntil digitize L5\n");
  EXPECT_EQ(shell("$preview --speed 0 --script script"), 0) << content("out");
}

TEST_F(WindowTest, TakesRealKeys) {
  const std::string keys = std::string(kRealKeys) + R"(
begin $preview --paused
xdotool key Tab i; there preview-001.png
xdotool key F11 i; there preview-002.png
xdotool key k i; there preview-003.png
xdotool key Right p k; there preview-001.mp4
xdotool key q
wait $pid
)";
  ASSERT_EQ(shell(keys), 0) << content("out");
  // The status line alone.
  const std::size_t changed = different(picture("preview-001.png"), picture("preview-002.png"));
  EXPECT_GT(changed, 100u);
  EXPECT_LT(changed, 6000u);
}

TEST_F(WindowTest, SurvivesAStormOfSizesAndHavingNone) {
  const std::string storm = std::string(kRealKeys) + R"(
begin $preview --speed 0
for i in 1 2 3 4 5 6 7 8 9 10; do
  for size in '1 1' '1500 900' '3 700' '1500 2' '400 300' '331 200'; do
    xdotool windowsize $window $size
  done
done
xdotool windowunmap --sync $window
xdotool windowmap --sync $window windowsize --sync $window 1000 400
xdotool windowfocus --sync $window
xdotool key i; there preview-001.png
xdotool key Escape
wait $pid
)";
  ASSERT_EQ(shell(storm), 0) << content("out");
  const RgbaImage after = picture("preview-001.png");
  EXPECT_EQ(after.width_px, 1000);
  EXPECT_EQ(after.height_px, 400);
  EXPECT_EQ(content("out"), "");
}

TEST_F(WindowTest, SaysSoWhenTheDisplayGoesAndKeepsTheVideo) {
  const std::string commands = std::string(kRealKeys) + R"(
begin $preview
xdotool key k i; there preview-001.png
kill -9 $server
wait $pid
)";
  EXPECT_EQ(shell(commands), 2);
  EXPECT_THAT(content("out"), HasSubstr("orthonav: window: the display has gone\n"));
  EXPECT_TRUE(fs::exists(folder_ / "preview-001.mp4"));
}

TEST_F(WindowTest, NeedsADisplay) {
  EXPECT_EQ(shell("unset DISPLAY WAYLAND_DISPLAY\n$preview"), 2);
  EXPECT_THAT(content("out"), HasSubstr("orthonav: window: "));
}

TEST_F(WindowTest, ServesOpenIgtLinkAsARunDoes) {
  write("script", "pairs 60\n");
  const std::string commands = R"($preview --speed 0 --igtl 0 --script script & pid=$!
until port=$(sed -n 's/^OpenIGTLink at 127.0.0.1:\([0-9]*\)$/\1/p' out) && [ -n "$port" ]; do
  sleep 0.1
done
# Behind the version a message says its type.
bash -c "exec 5<>/dev/tcp/127.0.0.1/$port; dd bs=1 skip=2 count=5 <&5 2>/dev/null" >type
wait $pid
)";
  EXPECT_EQ(shell(commands), 0) << content("out");
  EXPECT_THAT(content("type"), ::testing::AnyOf("POINT", "TRANS", "STRIN", "STATU"));
  EXPECT_THAT(content("out"), HasSubstr("OpenIGTLink: 1 client, "));
}

TEST_F(WindowTest, ScrubsThroughARecording) {
  write("script", R"(key tab
scrub 20
screenshot early.png
scrub 70
screenshot late.png
scrub 20
screenshot early-again.png
key right
screenshot next.png
)");
  ASSERT_EQ(shell("'" ORTHONAV_COMMAND
                  "' run --levels L5 --headset 'sim:?perfect' --frames 80 --record recording "
                  ">/dev/null 2>&1\n"
                  "$preview --headset replay:recording --paused --script script"),
            0)
      << content("out");
  const RgbaImage early = picture("early.png");
  EXPECT_TRUE(early == picture("early-again.png"));
  EXPECT_GT(different(early, picture("late.png")), 1000u);
  EXPECT_FALSE(early == picture("next.png"));
}

}  // namespace
}  // namespace orthonav::preview::window_test
