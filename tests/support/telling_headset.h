#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/api/forwarding_headset.h"
#include "hal/api/wearer.h"
#include "tests/support/scripted_session.h"

namespace orthonav::test {

/// A headset with an answer to every optional query, of its cameras too.
class TellingHeadset : public fake::FakeHeadset {
 public:
  explicit TellingHeadset(fake::Script script = scripted_session())
      : FakeHeadset(std::move(script)) {}
  /// Its optional `tool_poses` too.
  void measure_tools() { measures_tools_ = true; }
  [[nodiscard]] ToolPoseSource* tool_poses() override {
    return measures_tools_ ? &tools_ : nullptr;
  }
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }
  [[nodiscard]] DescribedTools described_tools() const override {
    return ToolsFile{"a file", "its text"};
  }
  [[nodiscard]] std::optional<ConnectionStatistics> connection() const override {
    ConnectionStatistics told;
    told.pairs = 42;
    return told;
  }
  [[nodiscard]] Wearer* wearer() override { return &wearer_; }
  /// What the wearer saw.
  [[nodiscard]] const std::vector<WornFrame>& seen() const { return wearer_.seen; }
  [[nodiscard]] bool is_tapped() const { return cameras_.tap != nullptr; }

 private:
  struct Cameras : ForwardingCamera {
    using ForwardingCamera::ForwardingCamera;
    PairTap* tap = nullptr;

   private:
    [[nodiscard]] MayRepeat do_may_repeat() const override { return {true, false}; }
    bool do_tap(PairTap* given) override {
      tap = given;
      return true;
    }
  };
  struct Remembering : Wearer {
    void see(const WornFrame& frame) override { seen.push_back(frame); }
    std::vector<WornFrame> seen;
  };
  Cameras cameras_{*FakeHeadset::cameras()};
  Remembering wearer_;
  fake::ScriptedToolPoses tools_{{"pointer", "guide"}, {}, manual_clock()};
  bool measures_tools_ = false;
};

/// `taps`: the wrapper lets others see pairs before it returns them; one that changes pairs only
/// then must not.
inline void expect_passed_on(TellingHeadset& inner, Headset& wrapper, bool taps) {
  SCOPED_TRACE(wrapper.name());
  const DescribedTools tools = wrapper.described_tools();
  ASSERT_TRUE(std::holds_alternative<ToolsFile>(tools));
  EXPECT_EQ(std::get<ToolsFile>(tools).text, "its text");
  ASSERT_TRUE(wrapper.connection());
  EXPECT_EQ(wrapper.connection()->pairs, 42);
  EXPECT_EQ(wrapper.display_latency(), inner.display_latency());
  const std::size_t seen = inner.seen().size();
  ASSERT_NE(wrapper.wearer(), nullptr);
  wrapper.wearer()->see({});
  EXPECT_EQ(inner.seen().size(), seen + 1);
  ASSERT_EQ(wrapper.tool_poses() != nullptr, inner.tool_poses() != nullptr);
  if (inner.tool_poses() != nullptr) {
    EXPECT_THAT(wrapper.tool_poses()->names(), ::testing::ElementsAre("pointer", "guide"));
  }
  EXPECT_EQ(wrapper.cameras()->may_repeat(), (MayRepeat{true, false}));
  struct Unused : PairTap {
    void received(const StereoFrame& /*pair*/) override {}
  } tap;
  const bool was_tapped = inner.is_tapped();
  EXPECT_EQ(wrapper.cameras()->tap(&tap), taps);
  EXPECT_EQ(inner.is_tapped(), taps || was_tapped);
  EXPECT_EQ(wrapper.cameras()->tap(nullptr), taps);
  EXPECT_EQ(inner.is_tapped(), was_tapped);
}

}  // namespace orthonav::test
