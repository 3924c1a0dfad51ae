#include "tools/event_log.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <vector>

#include "engine/session/part_wording.h"
#include "engine/session/saved_wording.h"

namespace orthonav::tools {

void EventLogArguments::add_to(CLI::App& command) {
  command.add_option("--log", file, "adds what happens to this file, line by line")
      ->type_name("FILE");
  command.add_flag("--verbose", verbose,
                   "also which tool was lost and found, and all of it on standard error");
}

EventLog::EventLog() = default;
EventLog::~EventLog() = default;

Status EventLog::open(const EventLogArguments& arguments) {
  std::vector<spdlog::sink_ptr> sinks;
  try {
    if (!arguments.file.empty()) {
      sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_mt>(arguments.file));
    }
  } catch (const spdlog::spdlog_ex& error) {
    return Error{"--log: " + arguments.file + ": " + error.what(), ErrorCode::kIo};
  }
  if (arguments.verbose) {
    sinks.push_back(std::make_shared<spdlog::sinks::stderr_sink_mt>());
  }
  if (sinks.empty()) {
    return {};
  }
  log_ = std::make_shared<spdlog::logger>("orthonav", sinks.begin(), sinks.end());
  log_->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v");
  log_->set_level(arguments.verbose ? spdlog::level::debug : spdlog::level::info);
  log_->flush_on(spdlog::level::debug);
  return {};
}

void EventLog::say(const std::string& line) {
  if (log_) {
    log_->info("{}", line);
  }
}

void EventLog::warn(const std::string& line) {
  if (log_) {
    log_->warn("{}", line);
  }
}

void EventLog::stepped(const StereoFrame& frame, const engine::Inputs& /*inputs*/,
                       const engine::Guidance& guidance) {
  if (!log_) {
    return;
  }
  const engine::StatusLine& status = guidance.status;
  changes_.look(frame.time, status);
  const double time_s = changes_.time_s();
  if (!changes_.new_step().empty()) {
    log_->info("{:.2f} s: step: {}", time_s, changes_.new_step());
  }
  if (!changes_.new_message().empty()) {
    log_->info("{:.2f} s: message: {}", time_s, changes_.new_message());
  }
  if (const bool fails =
          status.saved == engine::Saved::kNotSaved || status.saved == engine::Saved::kNotRecorded;
      fails && status.saved != not_kept_) {
    not_kept_ = status.saved;
    log_->warn("{:.2f} s: the status line says {}", time_s, engine::text_of(not_kept_));
  }
  if (status.tool_lost != lost_) {
    lost_ = status.tool_lost;
    log_->debug("{:.2f} s: {} {}", time_s, status.tool, lost_ ? "lost" : "found");
  }
  const std::string_view heard =
      status.heard != nullptr ? status.heard->phrase : std::string_view{};
  if (heard != heard_) {
    heard_ = heard;
    if (!heard_.empty()) {
      log_->debug("{:.2f} s: heard: {}{}", time_s, heard_, status.heard->sure ? "" : " (not sure)");
    }
  }
}

void EventLog::part_stalled(engine::Part part) { warn(std::string(engine::stalled_text(part))); }

void EventLog::ended(const engine::LoopReport& report) {
  if (!log_) {
    return;
  }
  if (report.failures + report.draw_failures > 0) {
    log_->warn("{} failures of devices, the last: {}", report.failures + report.draw_failures,
               report.last_failure);
  }
  log_->info("{} frames shown, {}", report.displayed,
             report.done ? "operation complete" : "operation incomplete");
  log_->flush();
}

}  // namespace orthonav::tools
