#include "tools/orthonav/operation/kept_operation.h"

#include <cstdio>
#include <ctime>
#include <utility>

#include "engine/session/text/resume_wording.h"
#include "engine/session/text/wording.h"

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
  identity.room = about.seed ? "seed " + std::to_string(*about.seed) : "";
  identity.begun = wall_time();
  identity.orthonav = ORTHONAV_VERSION;
  identity.device = about.device;
  identity.seed = about.seed.value_or(0);
  identity.epoch_100ns = about.epoch_100ns;
  return identity;
}

}  // namespace

Status KeptOperation::find(const std::string& folder) {
  auto found = engine::OperationLog::find(env_, folder);
  if (!found) {
    return found.error();
  }
  if (found->operation.done) {
    return Error{found->path + ": that operation was done, there is nothing to resume"};
  }
  found_ = std::move(*found);
  return {};
}

Status KeptOperation::check_free(const std::string& folder) {
  if (found_) {
    return {};  // it holds the lock
  }
  const auto lock = env_.lock(folder);
  return lock ? Status{} : lock.error();
}

std::vector<nav::ReferencePlace> KeptOperation::reference_places() const {
  return found_ ? found_->operation.references : std::vector<nav::ReferencePlace>();
}

Status KeptOperation::check(const engine::Session& session, const About& about) const {
  return found_ ? engine::check_same(found_->operation.identity, identity_of(session, about),
                                     found_->path)
                : Status{};
}

Status KeptOperation::resume(engine::AssembledOperation& operation, const About& about,
                             engine::RecordWriter::Waits waits) {
  const std::vector<std::string> lines = engine::resume_lines(*found_);
  engine::LoggedOperation logged = found_->operation;
  logged.reopen();
  begun_ = logged.identity.begun;
  if (const Status restored = operation.resume(logged); !restored) {
    return Error{found_->path + ": " + restored.error().message};
  }
  log_ = engine::OperationLog::reopen(env_, *std::exchange(found_, std::nullopt), waits,
                                      about.epoch_100ns);
  for (const std::string& line : lines) {
    std::fprintf(stderr, "orthonav: %s\n", line.c_str());
  }
  if (const Status written = log_->written(); !written) {
    std::fprintf(stderr, "orthonav: %s from here on: %s\n",
                 engine::not_kept_text(engine::Saved::kNotSaved), written.error().message.c_str());
  }
  return {};
}

Status KeptOperation::begin_anew(const engine::AssembledOperation& operation,
                                 const std::string& folder, const About& about,
                                 engine::RecordWriter::Waits waits) {
  using engine::RecordLog;
  engine::OperationIdentity identity = identity_of(operation.session(), about);
  identity.errors = operation.errors();
  begun_ = identity.begun;
  auto log = engine::OperationLog::begin(
      env_, folder, identity, operation.session().levels(), waits,
      about.replaces_earlier ? RecordLog::Earlier::kReplaced : RecordLog::Earlier::kKept);
  if (!log) {
    return log.error();
  }
  log_ = std::move(*log);
  if (!log_->earlier_kept_as().empty()) {
    std::fprintf(stderr, "orthonav: the log of an earlier operation is kept as %s\n",
                 log_->earlier_kept_as().c_str());
  }
  return {};
}

Status KeptOperation::begin(engine::AssembledOperation& operation, const std::string& folder,
                            const About& about) {
  using Waits = engine::RecordWriter::Waits;
  const Waits waits = about.seed ? Waits::kUntilDurable : Waits::kNot;
  if (Status same = check(operation.session(), about); !same) {
    return same;
  }
  if (Status begun =
          found_ ? resume(operation, about, waits) : begin_anew(operation, folder, about, waits);
      !begun) {
    return begun;
  }
  operation.observe(log_.get());
  operation.show_saving(log_.get());
  return {};
}

Status KeptOperation::finish(bool done, const std::string& reason,
                             std::optional<Timestamp> last_pair) {
  return log_ ? log_->finish(done, reason, last_pair) : Status{};
}

}  // namespace orthonav::tools
