#include "tools/orthonav/operation/event_log.h"

#include <fcntl.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <utility>
#include <vector>

#include "base/how_many.h"
#include "engine/session/text/wording.h"
#include "engine/session/work_watch.h"

namespace orthonav::tools {
namespace {

class UnblockedSink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit UnblockedSink(UnblockedOutput& output) : output_(output) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    output_.add({line.data(), line.size()});
  }
  void flush_() override {}

  UnblockedOutput& output_;
};

}  // namespace

EventLog::EventLog() = default;
EventLog::~EventLog() { tell_losses(); }

Status EventLog::open(const EventLogArguments& arguments) {
  std::vector<spdlog::sink_ptr> sinks;
  if (!arguments.file.empty()) {
    std::error_code told_by_open;
    std::filesystem::create_directories(std::filesystem::path(arguments.file).parent_path(),
                                        told_by_open);
    const int file = ::open(arguments.file.c_str(),
                            O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0666);
    if (file < 0) {
      return Error{"--log: " + arguments.file +
                       ": cannot be written: " + std::generic_category().message(errno),
                   ErrorCode::kIo};
    }
    file_ = arguments.file;
    output_ = std::make_unique<UnblockedOutput>(file, UnblockedOutput::Closes::kAtTheEnd);
    sinks.push_back(std::make_shared<UnblockedSink>(*output_));
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

void EventLog::stepped(const FrameHeader& frame, const engine::Inputs& /*inputs*/,
                       const engine::Guidance& guidance) {
  if (!log_) {
    return;
  }
  const engine::StatusLine& status = guidance.status;
  changes_.look(frame.time, status);
  const double time_s = changes_.time_s();
  tell_untold();
  if (!changes_.new_step().empty()) {
    log_->info("{:.2f} s: step: {}", time_s, changes_.new_step());
  }
  if (!changes_.new_message().empty()) {
    log_->info("{:.2f} s: message: {}", time_s, changes_.new_message());
  }
  if (engine::not_kept_text(status.saved) != nullptr && status.saved != not_kept_) {
    not_kept_ = status.saved;
    log_->warn("{:.2f} s: the status line says {}", time_s, engine::not_kept_text(not_kept_));
  }
  if (!std::exchange(pictures_apart_, status.pictures_apart) && pictures_apart_) {
    log_->warn("{:.2f} s: the two cameras' pictures do not belong together: nothing is measured",
               time_s);
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

void EventLog::tell_untold() {
  if (changes_.untold() > 0) {
    log_->info("{:.2f} s: the message above came back {}", changes_.time_s(),
               how_many(changes_.untold(), "time"));
  }
}

void EventLog::cameras_failed(const std::string& why) { warn(why); }

void EventLog::withdrawn(const engine::Guidance& guidance) {
  if (!log_ || guidance.blank) {
    return;
  }
  changes_.look(guidance.display_time, guidance.status);
  tell_untold();
  if (!changes_.new_message().empty()) {
    log_->warn("{:.2f} s: message: {}", changes_.time_s(), changes_.new_message());
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
  if (report.repeated > 0) {
    log_->warn("{} not used, since a picture or the head's pose repeats",
               how_many(report.repeated, "pair"));
  }
  if (!report.ended) {
    log_->error("{}", report.ended.error().message);
  }
  log_->info("{} frames shown, {}", report.displayed,
             report.done ? "operation complete" : "operation incomplete");
}

void EventLog::tell_losses() {
  if (!output_) {
    return;
  }
  const bool settled = output_->settle();
  if (settled && output_->lost() == 0) {
    return;
  }
  const int problem = output_->error_number();
  std::fprintf(
      stderr, "orthonav: --log: %s: %s missing%s: %s\n", file_.c_str(),
      how_many(output_->lost(), "line").c_str(), settled ? "" : " and its end",
      problem == 0 ? "the disk is too slow" : std::generic_category().message(problem).c_str());
}

}  // namespace orthonav::tools
