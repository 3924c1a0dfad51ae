#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "engine/case/case.h"
#include "engine/holograms/labels/label_layout.h"
#include "engine/live/assembled_operation.h"
#include "hal/open/open.h"
#include "study/surgeon/written_frame.h"
#include "tools/preview/preview_headset.h"
#include "tools/preview/timeline.h"

namespace orthonav::preview {

/// The previewed operation; made once, used for every start.
struct OperationSource {
  std::string headset = "sim:";
  engine::Case source;
  engine::Method method;
  engine::Operation operation;  ///< its models are shared by all starts
  engine::ScrewSizes screw_sizes = engine::ScrewSizes::built_in();
  bool use_reference = false;
  /// Where references lie in the World of an operation to be resumed; null: none is.
  std::function<std::vector<nav::ReferencePlace>()> reference_places;
  std::string tools_file;  ///< empty: the headset's own description of its tools
  /// Called with the operation of every start before it runs, and with the simulated room, if there
  /// is one; an Error refuses the start. May be null.
  std::function<Status(engine::AssembledOperation&, const sim::SimHeadset*)> assembled;
  /// Called with the outcome of each operation, on its thread, while it still exists.
  std::function<void(const engine::LoopReport&)> ended;
};

/// An operation that runs in its own thread: pairs come through the gate, moments go into the
/// timeline. Only these and the keyboard connect to it.
class LiveOperation : private engine::LoopObserver, private engine::SnapshotSink {
 public:
  /// `room`: the options of a simulated one. Gate, keyboard and timeline must outlive it.
  static Result<std::unique_ptr<LiveOperation>> open(const OperationSource& source,
                                                     const sim::SimOptions& room, Gate& gate,
                                                     Keyboard& keyboard, Timeline& timeline);
  ~LiveOperation() override;
  LiveOperation(const LiveOperation&) = delete;
  LiveOperation& operator=(const LiveOperation&) = delete;

  void start();
  /// Whether it has ended.
  [[nodiscard]] bool ended() const { return ended_; }
  /// How it ended; valid once it has.
  [[nodiscard]] const Status& outcome() const { return outcome_; }
  [[nodiscard]] std::string name() const { return headset_->name(); }
  /// Null unless the headset is simulated.
  [[nodiscard]] const sim::SimHeadset* room() const { return room_; }

 private:
  LiveOperation(OpenedHeadset opened, Gate& gate, Keyboard& keyboard, Timeline& timeline);
  Status prepare(const OperationSource& source);
  void run();
  void stepped(const FrameHeader& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;
  void captured(const engine::Snapshot& snapshot) override;
  void lay_out_labels(const engine::Snapshot& snapshot);
  Status draw(const engine::Snapshot& /*snapshot*/) override { return {}; }

  std::unique_ptr<Headset> headset_;
  const sim::SimHeadset* room_ = nullptr;  ///< the headset, where it is the simulated one
  Gate& gate_;
  PreviewHeadset gated_;
  sim::ShownToWearer to_wearer_;
  Timeline& timeline_;
  std::unique_ptr<engine::AssembledOperation> operation_;
  Moment moment_;  ///< of the pair being worked on
  /// Kept here rather than with the drawing, since moments may be viewed in any order.
  engine::LabelLayout labels_;
  std::vector<render::View> eye_;
  std::function<void(const engine::LoopReport&)> tell_end_;
  std::atomic<bool> ended_ = false;
  Status outcome_;
  std::thread thread_;
};

}  // namespace orthonav::preview
