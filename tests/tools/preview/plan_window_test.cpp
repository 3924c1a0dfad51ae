#include "tests/tools/preview/window_bench.h"

namespace orthonav::preview::plan_window_test {
namespace {

using ::testing::HasSubstr;

// A screw with room around it, and one that breaks through.
constexpr std::array<int, 3> kGreen = {64, 232, 96};
constexpr std::array<int, 3> kRed = {255, 68, 56};

class PlanWindowTest : public WindowTest {};

TEST_F(PlanWindowTest, EditsAPlanAndSavesItBesideTheOldOne) {
  write("script", R"(key right
screenshot before.png
drag sagittal target 0 9
screenshot breach.png
key z
screenshot undone.png
say longer
key v
)");
  const std::string check = "\"" ORTHONAV_COMMAND "\" plan check --case plan-001";
  ASSERT_EQ(shell("$plan --script script && " + check), 0) << content("out");
  EXPECT_THAT(content("out"), HasSubstr("wrote ./plan-001\n"));
  EXPECT_THAT(content("out"), HasSubstr("L5 right  6.0 x 50.0 mm"));
  const RgbaImage before = picture("before.png");
  const RgbaImage breach = picture("breach.png");
  EXPECT_GT(coloured(before, kGreen), 300u);
  EXPECT_GT(coloured(breach, kRed), 300u);
  EXPECT_LT(coloured(breach, kGreen), coloured(before, kGreen) / 2);
  EXPECT_LT(different(before, picture("undone.png")), 1500u) << "but for the panel";
  EXPECT_FALSE(fs::exists(folder_ / "plan-002")) << "nothing was changed since";
}

TEST_F(PlanWindowTest, WritesNothingWhenItIsLeftWithoutSaving) {
  write("script", "say longer\nkey x\nkey x\n");
  EXPECT_EQ(shell("$plan --script script"), 0) << content("out");
  EXPECT_FALSE(fs::exists(folder_ / "plan-001"));
}

TEST_F(PlanWindowTest, DragsAScrewWithARealMouse) {
  // The target of a screw lies at the top of the upper left pane.
  const std::string mouse = std::string(kRealKeys) + R"(
$plan & pid=$!
window=$(timeout 60 xdotool search --sync --onlyvisible --name 'orthonav plan' | head -1)
xdotool windowfocus --sync $window
xdotool key i; there preview-001.png
xdotool mousemove --window $window 160 20 mousedown 1
for x in 162 164 166 168; do xdotool mousemove --window $window $x 20; done
xdotool mouseup 1 key i; there preview-002.png
kill -HUP $pid
wait $pid
)";
  EXPECT_EQ(shell(mouse), 129) << content("out");
  EXPECT_THAT(content("out"), HasSubstr("wrote ./plan-001\n")) << "even when its terminal closes";
  EXPECT_GT(different(picture("preview-001.png"), picture("preview-002.png")), 1000u);
}

TEST_F(PlanWindowTest, RefusesWhatAPlanDoesNotHave) {
  EXPECT_NE(shell("$plan --paused"), 0);
  EXPECT_THAT(content("out"), HasSubstr("--paused excludes --plan"));
  EXPECT_NE(shell("$preview --volume ct.nii"), 0);
  EXPECT_THAT(content("out"), HasSubstr("--volume requires --plan"));
  EXPECT_EQ(shell("$plan --volume ct.nii"), 2);
  EXPECT_THAT(content("out"), HasSubstr("orthonav: --volume: ct.nii: "));
  EXPECT_EQ(shell("$plan --levels L9"), 2);
  write("settings.toml", "[rig]\nheadset = \"sim:\"\n");
  write("script", "key tab\n");
  EXPECT_EQ(shell("$plan --config settings.toml --script script"), 0) << "needs no headset";
}

}  // namespace
}  // namespace orthonav::preview::plan_window_test
