#pragma once

#include <memory>
#include <string>

#include "base/result.h"
#include "engine/live/frame_loop.h"
#include "tools/orthonav/dashboard/status_changes.h"
#include "tools/orthonav/shared/unblocked_output.h"

namespace spdlog {
class logger;
}

namespace orthonav::tools {

struct EventLogArguments {
  std::string file;
  bool verbose = false;
};

/// A log for people: steps, messages to the surgeon and failures of the headset, one line each with
/// wall time and headset time. Verbose: also which tools were lost and found and which commands
/// were heard, and everything on standard error too. No line waits for the disk; those that a slow
/// disk could not take are counted and told at the end. The clinical record is the operation's log.
class EventLog : public engine::LoopObserver {
 public:
  EventLog();
  ~EventLog() override;
  /// Appends to an existing file. Opens nothing if no log is requested.
  Status open(const EventLogArguments& arguments);
  void say(const std::string& line);
  void warn(const std::string& line);
  void stepped(const FrameHeader& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;
  void cameras_failed(const std::string& why) override;
  void withdrawn(const engine::Guidance& guidance) override;
  void part_stalled(engine::Part part) override;
  void input_failed(const std::string& why) override { warn(why); }
  void ended(const engine::LoopReport& report);

 private:
  void tell_untold();
  /// On standard error, if the file lacks lines.
  void tell_losses();

  std::string file_;
  std::unique_ptr<UnblockedOutput> output_;  ///< the file; null: none
  std::shared_ptr<spdlog::logger> log_;      ///< null: no log is requested
  StatusChanges changes_;
  std::string heard_;
  bool lost_ = false;
  bool pictures_apart_ = false;
  engine::Saved not_kept_ = engine::Saved::kNothingNew;  ///< as last reported
};

}  // namespace orthonav::tools
