#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "base/result.h"
#include "engine/live/frame_loop.h"
#include "tools/status_changes.h"

namespace spdlog {
class logger;
}

namespace orthonav::tools {

struct EventLogArguments {
  std::string file;
  bool verbose = false;

  void add_to(CLI::App& command);
};

/// A log for people: steps, messages to the surgeon and what the headset failed to do, a line each
/// with the wall clock and the headset's. Verbose: also which tool was lost and found and what was
/// heard, and all of it on standard error too. What became of the patient is in the journal.
class EventLog : public engine::LoopObserver {
 public:
  EventLog();
  ~EventLog() override;
  /// A file that is there is continued. Nothing is asked for: nothing is opened.
  Status open(const EventLogArguments& arguments);
  void say(const std::string& line);
  void warn(const std::string& line);
  void stepped(const StereoFrame& frame, const engine::Inputs& inputs,
               const engine::Guidance& guidance) override;
  void part_stalled(engine::Part part) override;
  void ended(const engine::LoopReport& report);

 private:
  std::shared_ptr<spdlog::logger> log_;  ///< null: nobody reads it
  StatusChanges changes_;
  std::string heard_;
  bool lost_ = false;
  engine::Saved not_kept_ = engine::Saved::kNothingNew;  ///< as was told last
};

}  // namespace orthonav::tools
