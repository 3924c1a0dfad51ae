#pragma once

#include <memory>

#include "engine/live/assembled_operation.h"
#include "engine/live/object_presenter.h"
#include "engine/live/presenter.h"

namespace orthonav::tools {

/// Shows an operation on the headset's own display, if it takes pixels or objects.
class Presenting {
 public:
  /// Whether the headset has such a display.
  [[nodiscard]] static bool is_possible(Headset& headset) {
    return headset.pixels() != nullptr || headset.objects() != nullptr;
  }
  /// Before `operation` runs; both must outlive this.
  Status begin(Headset& headset, engine::AssembledOperation& operation);
  /// Where the operation draws; null: nowhere.
  [[nodiscard]] engine::SnapshotSink* sink() const { return sink_; }
  /// Reports problems and, if requested, frame times on standard error.
  void end(bool stats);

 private:
  std::unique_ptr<engine::Presenter> presenter_;
  std::unique_ptr<engine::ObjectPresenter> objects_;
  engine::SnapshotSink* sink_ = nullptr;
  ObjectDisplay* display_ = nullptr;
};

}  // namespace orthonav::tools
