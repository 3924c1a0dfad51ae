#include "engine/live/status_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/holograms/scene_builder.h"
#include "engine/holograms/shapes/hologram_status.h"
#include "tests/support/allocation_count.h"

namespace orthonav::engine::status_panel_test {
namespace {

using ::testing::HasSubstr;

const Error kNo{"not now"};

/// A display of which only the panel works.
class PanelDisplay : public PixelDisplay {
 public:
  Result<GraphicsNeeds> open() override { return kNo; }
  Result<void*> create_instance(VulkanFunction, const void*) override { return kNo; }
  Result<void*> physical_device(void*) override { return kNo; }
  Result<void*> create_device(void*, VulkanFunction, const void*) override { return kNo; }
  Result<EyeImages> start(const VulkanObjects&, const FormatPreference&) override { return kNo; }
  DisplayFrame begin_frame() override { return {}; }
  Result<std::vector<std::uint32_t>> acquire() override { return kNo; }
  EyeViews views() override { return {}; }
  Status end_frame(const SubmittedContent&) override { return {}; }
  Result<std::uint32_t> acquire_panel() override {
    ++acquired;
    return acquires ? Result<std::uint32_t>(1u) : kNo;
  }
  Status release_panel() override {
    ++released;
    return releases ? Status{} : kNo;
  }
  void ask_to_end() override {}
  void close() override {}

  bool acquires = true;
  bool releases = true;
  int acquired = 0;
  int released = 0;
};

/// A renderer that keeps the texts of the panel instead of drawing them.
class PanelRenderer : public render::Renderer {
 public:
  Status draw(const render::Scene&, const std::vector<render::View>&,
              const std::vector<const RgbaImage*>&, std::vector<RgbaImage>&) override {
    return {};
  }
  Status draw_labels(const render::Scene&, const std::vector<render::View>&,
                     std::vector<LabelImage>&) override {
    return {};
  }
  [[nodiscard]] VulkanObjects objects() const override { return {}; }
  [[nodiscard]] int format_score(std::int64_t) const override { return 0; }
  [[nodiscard]] int depth_format_score(std::int64_t) const override { return 0; }
  Status use(const EyeImages&) override { return {}; }
  Status prepare(const render::Scene&) override { return {}; }
  Status draw(const render::Scene&, const std::vector<render::View>&,
              std::span<const std::uint32_t>, render::HeadTexts) override {
    return {};
  }
  Status draw_panel(const render::Scene& scene, const render::View&, std::uint32_t) override {
    ++drawn;
    if (draws) {
      texts = scene.texts;
    }
    return draws ? Status{} : kNo;
  }
  Status finish() override { return {}; }
  [[nodiscard]] bool lost() const override { return false; }
  [[nodiscard]] const render::DeviceInfo& device() const override { return info_; }
  [[nodiscard]] render::FrameTiming last_timing() const override { return {}; }
  [[nodiscard]] const std::vector<std::string>& validation_messages() const override {
    return none_;
  }
  [[nodiscard]] const std::vector<std::string>& notes() const override { return none_; }

  bool draws = true;
  int drawn = 0;
  render::ItemList<render::TextItem> texts;

 private:
  render::DeviceInfo info_;
  std::vector<std::string> none_;
};

render::Scene saying(const std::string& text) {
  render::Scene scene;
  render::TextItem& label = scene.texts.emplace_back();
  label.label = 301;
  label.runs.push_back({"in the world", {}});
  const std::vector<ToolDot> tools = {{ToolState::kMeasured}};
  add_status_line(scene, text, tools, 1101);
  return scene;
}

class StatusPanelOfADisplay : public ::testing::Test {
 protected:
  /// Runs a frame with that scene; returns whether the panel shows it.
  bool frame(const render::Scene& scene, bool ends_well = true) {
    const bool on_panel = panel_.show(scene);
    EXPECT_EQ(panel_.shown().has_value(), on_panel);
    panel_.ended(ends_well);
    EXPECT_FALSE(panel_.shown().has_value());
    return on_panel;
  }

  PanelDisplay display_;
  PanelRenderer renderer_;
  StatusPanel panel_{display_, renderer_, true};
};

TEST_F(StatusPanelOfADisplay, IsDrawnOnceForEachTextWithWhatHangsOnTheHead) {
  EXPECT_TRUE(frame(saying("digitize L4 | stroke")));
  EXPECT_TRUE(frame(saying("digitize L4 | stroke")));
  EXPECT_EQ(renderer_.drawn, 1);
  EXPECT_EQ(display_.acquired, 1);
  EXPECT_EQ(display_.released, 1);
  EXPECT_EQ(renderer_.texts.size(), saying("digitize L4 | stroke").texts.size() - 1);
  EXPECT_TRUE(frame(saying("digitize L4 | save")));
  EXPECT_EQ(renderer_.drawn, 2);
  EXPECT_EQ(panel_.drawn(), 2);
  EXPECT_EQ(panel_.problem(), "");
}

TEST_F(StatusPanelOfADisplay, LeavesAllOfItToTheEyesWhereACallFails) {
  EXPECT_TRUE(frame(saying("one")));
  display_.acquires = false;
  EXPECT_TRUE(frame(saying("one"))) << "it says so already";
  EXPECT_FALSE(frame(saying("two")));
  EXPECT_EQ(panel_.problem(), "not now");
  EXPECT_TRUE(frame(saying("one"))) << "it still does";
  display_.acquires = true;
  renderer_.draws = false;
  EXPECT_FALSE(frame(saying("two")));
  renderer_.draws = true;
  display_.releases = false;
  EXPECT_FALSE(frame(saying("two")));
  display_.releases = true;
  EXPECT_TRUE(frame(saying("one"))) << "drawn anew: what the display has is not known";
  EXPECT_EQ(renderer_.drawn, 4);
}

TEST_F(StatusPanelOfADisplay, IsDrawnAnewAfterAFrameThatFailed) {
  EXPECT_TRUE(frame(saying("one"), false));
  EXPECT_TRUE(frame(saying("one")));
  EXPECT_EQ(renderer_.drawn, 2);
}

TEST_F(StatusPanelOfADisplay, GoesWithTheStatusLineWithoutBeingDrawnAnew) {
  render::Scene aside = saying("one");
  ASSERT_TRUE(frame(aside));
  constexpr render::Float3 kAhead{0, 0, -0.50913f};  // as far from the eyes
  for (render::TextItem& text : aside.texts) {
    if (text.place == render::TextPlace::kView) {
      text.position = kAhead;
    }
  }
  ASSERT_TRUE(panel_.show(aside));
  EXPECT_EQ(panel_.shown()->middle_m.y, 0.0);
  EXPECT_EQ(renderer_.drawn, 1);
  render::Scene lost;
  write_head_lost(aside, lost);
  EXPECT_TRUE(panel_.show(lost)) << "the notice goes with it";
  EXPECT_EQ(panel_.shown()->middle_m.y, 0.0);
}

TEST_F(StatusPanelOfADisplay, TakesAllOrNothing) {
  render::Scene elsewhere = saying("one");
  elsewhere.texts.back().position.y += 0.01f;
  EXPECT_FALSE(frame(elsewhere));
  render::Scene wide = saying("one");
  wide.texts.back().runs.front().text.assign(200, 'W');
  EXPECT_FALSE(frame(wide));
  render::Scene high = saying("one");
  high.texts.back().offset_up = 6.0f;
  EXPECT_FALSE(frame(high));
  EXPECT_EQ(renderer_.drawn, 0);
}

TEST_F(StatusPanelOfADisplay, IsNotSeenWhereNothingHangsOnTheHead) {
  EXPECT_TRUE(panel_.show({}));
  EXPECT_FALSE(panel_.shown().has_value());
  EXPECT_EQ(display_.acquired, 0);
}

TEST_F(StatusPanelOfADisplay, HoldsAllRowsThatThereCanBe) {
  render::Scene scene = saying("guide L4 left | " + std::string(400, 'm'));
  add_next_act(scene, std::string(200, 'm'), 2, 1302);
  add_stop_row(scene, std::string(200, 'm'), 1305);
  EXPECT_TRUE(frame(scene));
  render::Scene lost;
  write_head_lost(saying("guide L4 left | stroke"), lost);
  EXPECT_TRUE(frame(lost));
}

TEST(StatusPanelOfNoDisplay, LeavesAllOfItToTheEyes) {
  PanelDisplay display;
  PanelRenderer renderer;
  StatusPanel panel(display, renderer, false);
  EXPECT_FALSE(panel.show(saying("one")));
  EXPECT_FALSE(panel.shown().has_value());
  EXPECT_EQ(display.acquired, 0);
}

TEST_F(StatusPanelOfADisplay, AllocatesNothing) {
  const render::Scene one = saying("digitize L4 | stroke the vertebra with the pointer");
  const render::Scene two = saying("digitize L4 | say save, then stroke another region");
  for (int i = 0; i < 10; ++i) {
    frame(i % 2 == 0 ? one : two);
  }
  const std::size_t before = test::allocation_count();
  for (int i = 0; i < 10; ++i) {
    frame(i % 2 == 0 ? one : two);
    frame(i % 2 == 0 ? one : two);
  }
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace orthonav::engine::status_panel_test
