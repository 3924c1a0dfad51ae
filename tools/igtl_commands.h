#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/mutex.h"
#include "base/stopwatch.h"
#include "engine/live/assembled_operation.h"
#include "hal/igtl/text_message.h"
#include "tools/event_log.h"

namespace orthonav::tools {

/// What clients of OpenIGTLink ask of an operation: a STRING `Command` with what one would say, or
/// a STRING `Plan` with a plan's text, one screw of one level. Both go the way of what is said, to
/// the same table and the same limits, and are journalled with the client's address. What is
/// neither is refused, with a line in the log. Everything is answered.
class IgtlCommands : public igtl::TextListener,
                     public engine::Requests,
                     public engine::SessionObserver {
 public:
  /// Further ones are refused until these were heard.
  static constexpr std::size_t kMostWaiting = 16;

  explicit IgtlCommands(EventLog& log) : log_(log) {}

  /// From now on they are asked of this operation, which must outlive its run. Those that came
  /// before were not meant for it.
  void watch(engine::AssembledOperation& operation) ORTHONAV_EXCLUDES(mutex_);
  /// Whether something was asked that was not answered yet. After each pair, on the tracking
  /// thread.
  [[nodiscard]] bool owe_answers() const ORTHONAV_EXCLUDES(mutex_);
  /// Answers to what was asked since, as whole messages; on the same thread.
  /// `status` is what the surgeon is told by now.
  [[nodiscard]] std::vector<std::uint8_t> answers(const std::string& status, std::uint64_t stamp)
      ORTHONAV_EXCLUDES(mutex_);

  void said(const std::string& client, const std::string& device, const std::string& text) override
      ORTHONAV_EXCLUDES(mutex_);
  void take(Timestamp until, std::vector<engine::Request>& requests) override
      ORTHONAV_EXCLUDES(mutex_);
  void asked_from_outside(const engine::Request& request) override;
  void happened(Timestamp time, engine::Step from, engine::Event event,
                engine::Cell answer) override;
  void not_understood(const Phrase& phrase) override;
  void replanned(Timestamp time, const engine::LevelState& level, const engine::Replan& asked,
                 const engine::ScrewReplanned& done) override;

 private:
  struct Waiting {
    engine::Request request;
    Stopwatch since;
  };
  /// What became of one that was asked.
  struct Outcome {
    std::string client;
    std::string asked;
    bool taken = false;
    std::string why;  ///< where it did not get to the session
  };
  void finish();

  EventLog& log_;
  mutable Mutex mutex_;
  bool watching_ ORTHONAV_GUARDED_BY(mutex_) = false;  ///< there is an operation
  std::deque<Waiting> waiting_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Timestamp> taken_until_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<Outcome> refused_ ORTHONAV_GUARDED_BY(mutex_);

  // Of the tracking thread.
  std::optional<Outcome> asking_;  ///< what happens next comes of it
  bool decided_ = false;           ///< and has happened
  std::vector<Outcome> heard_;
};

}  // namespace orthonav::tools
