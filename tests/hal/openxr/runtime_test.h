#pragma once

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "engine/live/presenter.h"
#include "hal/fake/scripted.h"
#include "hal/openxr/openxr_headset.h"
#include "tests/render/silent_validation.h"
#include "tests/support/openxr_runtime/runtime_double.h"
#include "tests/support/scripted_session.h"
#include "tests/support/wait_until.h"

namespace orthonav::test {

/// The runtime that this process is given by the real loader.
inline RuntimeDouble& runtime_double() {
  static RuntimeDouble* const kRuntime = [] {
    ::setenv("XR_RUNTIME_JSON", ORTHONAV_XR_MANIFEST, 1);
    void* library = ::dlopen(ORTHONAV_XR_RUNTIME, RTLD_NOW);
    auto* get = reinterpret_cast<RuntimeDouble* (*)()>(::dlsym(library, "orthonav_runtime_double"));
    return get();
  }();
  return *kRuntime;
}

/// A scene as it was drawn, and its views.
struct DrawnScene {
  render::Scene scene;
  std::vector<render::View> views;
};

/// Whether no part of the scene has a place in the world.
inline bool hangs_on_head(const render::Scene& scene) {
  return scene.meshes.empty() && scene.lines.empty() && scene.triangles.empty() &&
         std::all_of(scene.texts.begin(), scene.texts.end(), [](const render::TextItem& text) {
           return text.place == render::TextPlace::kView;
         });
}

/// Presents on the double with validation layers listening; a test fails when they, or the runtime,
/// find anything.
class RuntimeTest : public ::testing::Test {
 protected:
  RuntimeTest() { runtime().reset({}); }
  ~RuntimeTest() override {
    hold_ = false;
    presenter_.reset();
    headset_.reset();
    EXPECT_THAT(runtime().violations(), ::testing::IsEmpty());
  }

  static RuntimeDouble& runtime() { return runtime_double(); }

  /// A headset whose cameras are a scripted one's, standing still at `pose`.
  Headset& open(const Transform<World, Rig>& pose = {}, const openxr::RigOnHead& rig = {false, {}},
                fake::Script script = {}) {
    script.calibration = scripted_calibration();
    script.clock_start = kStart;
    script.head = {{kStart, pose}};
    auto cameras = std::make_unique<fake::FakeHeadset>(std::move(script));
    cameras_ = cameras.get();
    headset_ = openxr::OpenxrHeadset::around(std::move(cameras), rig);
    return *headset_;
  }

  Status present() {
    engine::PresenterOptions options;
    options.renderer.validation = true;
    options.renderer.messages = validation_.sink();
    options.renderer.cache_folder = "";
    options.look_again_after = std::chrono::milliseconds(5);
    options.on_over = [this] { over_ = true; };
    options.on_drawn = [this](const render::Scene& scene, const std::vector<render::View>& views) {
      {
        const std::lock_guard lock(mutex_);
        drawn_.push_back({scene, views});
      }
      while (hold_) {
        held_ = true;
        std::this_thread::yield();
      }
    };
    options.clock = &watch_;
    auto presenter = engine::Presenter::start(*headset_->pixels(), options);
    if (!presenter) {
      return presenter.error();
    }
    presenter_ = std::move(*presenter);
    return {};
  }

  Status show(const render::Scene& scene) {
    engine::Snapshot snapshot;
    snapshot.scene = scene;
    return presenter_->draw(snapshot);
  }

  [[nodiscard]] std::vector<DrawnScene> drawn() const {
    const std::lock_guard lock(mutex_);
    return drawn_;
  }
  [[nodiscard]] std::size_t count_drawn() const {
    const std::lock_guard lock(mutex_);
    return drawn_.size();
  }

  /// True once the condition holds; false if that takes too long.
  static bool eventually(const std::function<bool()>& so) { return wait_until(so); }
  /// True once this many more frames were ended.
  static bool frames_pass(std::int64_t count) {
    const std::int64_t until = runtime().ended_frames() + count;
    return eventually([&] { return runtime().ended_frames() >= until; });
  }

  static constexpr Timestamp kStart{std::chrono::seconds(100)};
  render::SilentValidation validation_;
  fake::FakeHeadset* cameras_ = nullptr;
  std::unique_ptr<Headset> headset_;
  std::unique_ptr<engine::Presenter> presenter_;
  std::atomic<bool> over_ = false;
  /// While this is set, the presenting thread hangs in its next frame.
  std::atomic<bool> hold_ = false;
  std::atomic<bool> held_ = false;
  fake::ManualClock watch_;  ///< by which that is noticed

 private:
  mutable std::mutex mutex_;
  std::vector<DrawnScene> drawn_;
};

}  // namespace orthonav::test
