#include "tools/kept_operation.h"

#include <cstdio>
#include <ctime>

namespace orthonav::tools {
namespace {

/// For people: "2026-11-25 10:04 UTC".
std::string wall_time() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return text;
}

engine::OperationIdentity identity_of(const engine::Session& session,
                                      const KeptOperation::About& about) {
  engine::OperationIdentity identity =
      engine::identity_of(about.case_name, session.levels(), session.tracker().tools(),
                          about.method, about.patient_reference);
  identity.room = about.room;
  identity.begun = wall_time();
  identity.common = about.common;
  return identity;
}

}  // namespace

Status KeptOperation::begin(engine::AssembledOperation& operation, const std::string& folder,
                            const About& about) {
  using engine::RecordLog;
  using engine::RecordWriter;
  auto log = engine::OperationLog::begin(
      env_, folder, identity_of(operation.session(), about), operation.session().levels(),
      about.time_stands_still ? RecordWriter::Waits::kUntilDurable : RecordWriter::Waits::kNot,
      about.replaces_earlier ? RecordLog::Earlier::kReplaced : RecordLog::Earlier::kKept);
  if (!log) {
    return log.error();
  }
  log_ = std::move(*log);
  if (!log_->earlier_kept_as().empty()) {
    std::fprintf(stderr, "orthonav: the log of an earlier operation is kept as %s\n",
                 log_->earlier_kept_as().c_str());
  }
  operation.observe(log_.get());
  operation.show_saving(log_.get());
  return {};
}

Status KeptOperation::finish(bool done, const std::string& reason) {
  return log_ ? log_->finish(done, reason) : Status{};
}

}  // namespace orthonav::tools
