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
#include "tools/orthonav/operation/event_log.h"

namespace orthonav::tools {

/// Requests of OpenIGTLink clients to an operation: a STRING `Command` with a spoken command, or a
/// STRING `Plan` with a plan's text, one screw of one level. Both are handled like speech, with the
/// same table and the same limits, and are logged with the client's address. Anything else is
/// refused, with a line in the log. Every request is answered.
class IgtlCommands : public igtl::TextListener,
                     public engine::Requests,
                     public engine::SessionObserver {
 public:
  /// Further requests are refused until these have been handled.
  static constexpr std::size_t kMostWaiting = 16;

  explicit IgtlCommands(EventLog& log) : log_(log) {}

  /// From now on requests go to this operation, which must outlive its run. Earlier requests are
  /// dropped.
  void watch(engine::AssembledOperation& operation) ORTHONAV_EXCLUDES(mutex_);
  /// Whether a request is unanswered. Called after each pair, on the tracking thread.
  [[nodiscard]] bool owe_answers() const ORTHONAV_EXCLUDES(mutex_);
  /// Answers to new requests, as whole messages; called on the same thread. `status` is the current
  /// status line.
  [[nodiscard]] std::vector<std::uint8_t> answers(const std::string& status, std::uint64_t stamp)
      ORTHONAV_EXCLUDES(mutex_);

  void said(const std::string& client, const std::string& device, const std::string& text) override
      ORTHONAV_EXCLUDES(mutex_);
  void take(Timestamp until, std::vector<engine::Request>& requests) override
      ORTHONAV_EXCLUDES(mutex_);
  void request_answered(const engine::Request& request, bool taken,
                        const engine::Message* why_not) override;

 private:
  struct Waiting {
    engine::Request request;
    Stopwatch since;
  };
  /// The outcome of a request.
  struct Outcome {
    std::string client;
    std::string asked;
    bool heard = false;   ///< it reached the session
    std::string why_not;  ///< why it had no effect; empty: it had
  };

  EventLog& log_;
  mutable Mutex mutex_;
  bool watching_ ORTHONAV_GUARDED_BY(mutex_) = false;  ///< whether there is an operation
  std::deque<Waiting> waiting_ ORTHONAV_GUARDED_BY(mutex_);
  std::optional<Timestamp> taken_until_ ORTHONAV_GUARDED_BY(mutex_);
  std::vector<Outcome> refused_ ORTHONAV_GUARDED_BY(mutex_);

  std::vector<Outcome> answered_;  ///< used by the tracking thread only
};

}  // namespace orthonav::tools
