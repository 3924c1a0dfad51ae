#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/mutex.h"
#include "engine/session/work_watch.h"
#include "hal/api/forwarding_headset.h"
#include "hal/fake/scripted.h"
#include "tests/engine/live/guiding_loop.h"
#include "tests/support/wait_until.h"

namespace orthonav::engine {

/// The part whose stall is drawn, if one is.
inline std::optional<Part> stall_in(const render::Scene& scene) {
  std::string text;
  for (const render::TextItem& item : scene.texts) {
    for (const render::TextRun& run : item.runs) {
      text += run.text + " ";
    }
  }
  for (std::size_t k = 0; k < kPartCount; ++k) {
    if (const Part part{static_cast<std::uint8_t>(k)};
        text.find(stalled_text(part)) != std::string::npos) {
      return part;
    }
  }
  return std::nullopt;
}

/// What happens just before a certain pair comes; by default nothing.
struct AtPair {
  std::int64_t pair = 0;
  std::function<void()> happens = [] {};
};

class EventfulCamera : public ForwardingCamera {
 public:
  EventfulCamera(StereoCamera& inner, AtPair at) : ForwardingCamera(inner), at_(std::move(at)) {}

 private:
  AtPair at_;
  std::int64_t pair_ = 0;
  Result<Next> do_next(StereoFrame& frame) override {
    if (pair_++ == at_.pair) {
      at_.happens();
    }
    return ForwardingCamera::do_next(frame);
  }
};

/// A voice without commands; a function decides how each poll ends.
class ToldVoice : public Voice {
 public:
  explicit ToldVoice(std::function<Status(Timestamp)> answer) : answer_(std::move(answer)) {}

 private:
  std::function<Status(Timestamp)> answer_;
  Status do_poll(Timestamp until, std::vector<Phrase>&) override { return answer_(until); }
};

class EventfulHeadset : public ForwardingHeadset {
 public:
  EventfulHeadset(
      Headset& inner, AtPair camera,
      std::function<Status(Timestamp)> voice = [](Timestamp) { return Status{}; })
      : ForwardingHeadset(inner), cameras_(*inner.cameras(), std::move(camera)), voice_(voice) {}
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }
  [[nodiscard]] Voice& voice() override { return voice_; }

 private:
  EventfulCamera cameras_;
  ToldVoice voice_;
};

/// Keeps what it was given to draw, and can hang or throw from a snapshot on.
class WatchedSink : public SnapshotSink {
 public:
  Status draw(const Snapshot& snapshot) override {
    const std::optional<Part> stalled = stall_in(snapshot.scene);
    {
      const MutexLock lock(mutex_);
      guided_ = guided_ || (snapshot.step.step == Step::kGuide && !stalled);
      if (stalled) {
        stalls_.insert(*stalled);
      }
    }
    if (stalled && !warns) {
      return Error{"no warnings"};
    }
    // In real time any snapshot may be skipped.
    if (hangs_at >= 0 && snapshot.frame >= hangs_at) {
      hanging = true;
      EXPECT_TRUE(test::wait_until([&] { return let_go.load(); }));
    }
    if (dies_at >= 0 && snapshot.frame >= dies_at) {
      throw std::runtime_error("driver");
    }
    return {};
  }
  [[nodiscard]] bool stalled() const override { return hangs_by_itself; }
  [[nodiscard]] bool drew_guidance() const {
    const MutexLock lock(mutex_);
    return guided_;
  }
  [[nodiscard]] std::set<Part> stalls() const {
    const MutexLock lock(mutex_);
    return stalls_;
  }
  [[nodiscard]] bool drew_stall_of(Part part) const { return stalls().contains(part); }
  bool warns = true;  ///< false: a notice of a stall can't be drawn
  std::int64_t hangs_at = -1;
  std::int64_t dies_at = -1;
  std::atomic<bool> hanging = false;
  std::atomic<bool> let_go = false;
  std::atomic<bool> hangs_by_itself = false;

 private:
  mutable Mutex mutex_;
  bool guided_ ORTHONAV_GUARDED_BY(mutex_) = false;
  std::set<Part> stalls_ ORTHONAV_GUARDED_BY(mutex_);
};

/// Calls something once the guidance of a pair is known.
class Stepped : public LoopObserver {
 public:
  explicit Stepped(std::function<void(const Guidance&)> then) : then_(std::move(then)) {}
  void stepped(const FrameHeader&, const Inputs&, const Guidance& guidance) override {
    then_(guidance);
  }

 private:
  std::function<void(const Guidance&)> then_;
};

/// Guidance in real time, drawn into a sink that is watched.
class WatchedLoop : public GuidingLoop {
 protected:
  WatchedLoop() { options.real_time = true; }
  LoopReport run(Headset& headset, LoopObserver* observer = nullptr) {
    return GuidingLoop::run(headset, observer, &sink);
  }
  /// Hangs the part that calls it: from when guidance is drawn, for longer than a part may take,
  /// until its stall is drawn.
  void hang_until_drawn(fake::FakeHeadset& headset, Part part) {
    EXPECT_TRUE(test::wait_until([&] { return sink.drew_guidance(); }));
    headset.manual_clock().advance(kStallAfter + Duration(1));
    EXPECT_TRUE(test::wait_until([&] { return sink.drew_stall_of(part); }));
  }
  WatchedSink sink;
};

}  // namespace orthonav::engine
