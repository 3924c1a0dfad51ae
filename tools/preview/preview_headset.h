#pragma once

#include <optional>

#include "hal/api/forwarding_headset.h"
#include "tools/preview/gate.h"
#include "tools/preview/keyboard.h"

namespace orthonav::preview {

/// A headset whose pairs, or poses of tools, come through a gate and whose button and voice are
/// shared with the keyboard; everything else is the headset's own.
class PreviewHeadset : public ForwardingHeadset {
 public:
  /// All three must outlive it.
  PreviewHeadset(Headset& inner, Gate& gate, Keyboard& keyboard)
      : ForwardingHeadset(inner),
        passage_(gate),
        clicker_(inner.clicker(), keyboard),
        voice_(inner.voice(), keyboard) {
    if (StereoCamera* cameras = inner.cameras()) {
      cameras_.emplace(*cameras, passage_);
    }
    if (ToolPoseSource* poses = inner.tool_poses()) {
      tool_poses_.emplace(*poses, passage_);
    }
  }

  [[nodiscard]] StereoCamera* cameras() override { return cameras_ ? &*cameras_ : nullptr; }
  [[nodiscard]] ToolPoseSource* tool_poses() override {
    return tool_poses_ ? &*tool_poses_ : nullptr;
  }
  [[nodiscard]] Clicker& clicker() override { return clicker_; }
  [[nodiscard]] Voice& voice() override { return voice_; }
  /// Wall time that the newest pair took to be rendered, or read from a recording.
  [[nodiscard]] double camera_ms() const { return passage_.camera_ms; }
  /// Wall time since that pair was delivered.
  [[nodiscard]] double since_pair_ms() const;

 private:
  /// The way through the gate.
  struct Passage {
    explicit Passage(Gate& way) : gate(way) {}
    Gate& gate;
    double camera_ms = 0.0;
    Timestamp there{};  ///< of the delivery, in wall time
  };
  template <class Forwarding, class Frame>
  class Gated : public Forwarding {
   public:
    template <class Inner>
    Gated(Inner& inner, Passage& passage) : Forwarding(inner), passage_(passage) {}

   private:
    Result<Next> do_next(Frame& frame) override;

    Passage& passage_;
  };

  Passage passage_;
  std::optional<Gated<ForwardingCamera, StereoFrame>> cameras_;
  std::optional<Gated<ForwardingToolPoses, ToolPoses>> tool_poses_;
  SharedClicker clicker_;
  SharedVoice voice_;
};

}  // namespace orthonav::preview
