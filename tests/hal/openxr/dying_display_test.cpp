// A runtime whose call throws on the presenting thread.
#include <stdexcept>

#include "hal/api/pixel_display.h"
#include "tests/hal/openxr/runtime_test.h"

namespace orthonav::test::dying_display_test {
namespace {

/// The runtime's display, until its n-th frame throws.
class DyingDisplay : public PixelDisplay {
 public:
  DyingDisplay(PixelDisplay& inner, int frames) : inner_(inner), frames_(frames) {}
  Result<GraphicsNeeds> open() override { return inner_.open(); }
  Result<void*> create_instance(VulkanFunction function, const void* info) override {
    return inner_.create_instance(function, info);
  }
  Result<void*> physical_device(void* instance) override {
    return inner_.physical_device(instance);
  }
  Result<void*> create_device(void* physical, VulkanFunction function, const void* info) override {
    return inner_.create_device(physical, function, info);
  }
  Result<EyeImages> start(const VulkanObjects& objects,
                          const FormatPreference& preference) override {
    return inner_.start(objects, preference);
  }
  DisplayFrame begin_frame() override {
    if (frames_-- == 0) {
      throw std::runtime_error("runtime");
    }
    return inner_.begin_frame();
  }
  Result<std::vector<std::uint32_t>> acquire() override { return inner_.acquire(); }
  EyeViews views() override { return inner_.views(); }
  Status end_frame(const SubmittedContent& content) override { return inner_.end_frame(content); }
  Result<std::uint32_t> acquire_panel() override { return inner_.acquire_panel(); }
  Status release_panel() override { return inner_.release_panel(); }
  void ask_to_end() override { inner_.ask_to_end(); }
  void close() override { inner_.close(); }

 private:
  PixelDisplay& inner_;
  int frames_;
};

TEST_F(RuntimeTest, APresenterThatDiesSaysSoToWhoeverDrawsAndEndsItsSession) {
  DyingDisplay display(*open().pixels(), 5);
  engine::PresenterOptions options;
  options.renderer.cache_folder.emplace();
  auto presenter = engine::Presenter::start(display, options);
  ASSERT_TRUE(presenter.ok()) << presenter.error().message;
  engine::Snapshot snapshot;
  ASSERT_TRUE(eventually([&] { return !(*presenter)->draw(snapshot).ok(); }));
  for (int call = 0; call < 3; ++call) {
    const Status drawn = (*presenter)->draw(snapshot);
    ASSERT_FALSE(drawn.ok()) << "until the frame loop gives up";
    EXPECT_EQ(drawn.error().message, "renderer: ended by an exception: runtime");
  }
  (*presenter)->stop();
}

}  // namespace
}  // namespace orthonav::test::dying_display_test
