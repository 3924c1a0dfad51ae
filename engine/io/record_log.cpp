#include "engine/io/record_log.h"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "engine/io/file_names.h"

namespace orthonav::engine {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxLogBytes = 1u << 30u;

std::string unnamed(const std::string& path) { return path + ".new"; }

bool has(const std::vector<std::string>& names, const std::string& path) {
  return std::binary_search(names.begin(), names.end(), fs::path(path).filename().string());
}

Status removed_if_there(Env& env, const std::string& path) {
  Status removed = env.remove(path);
  return !removed && removed.error().code == ErrorCode::kNotFound ? Status{} : removed;
}

/// Moves a file of that name aside; returns its new name, empty if there was none.
Result<std::string> moved_aside(Env& env, const std::string& path) {
  const auto names = env.list(folder_of(path));
  if (!names) {
    return names.error();
  }
  if (!has(*names, path)) {
    return std::string();
  }
  for (int number = 1; number <= kMaxEarlier; ++number) {
    const std::string name = earlier_name(path, number);
    if (has(*names, name)) {
      continue;
    }
    if (const Status moved = env.rename(path, name); !moved) {
      return moved.error();
    }
    // This must be durable before another file takes the name, otherwise a crash could leave only
    // the other one.
    const Status durable = env.sync_folder(folder_of(path));
    return durable ? Result<std::string>(name) : durable.error();
  }
  return too_many_earlier(path);
}

Status written(AppendFile& file, std::string_view bytes) {
  Status appended = file.append(bytes);
  return appended ? file.sync() : appended;
}

/// Bytes after the last whole record are saved in a file beside the log, then cut off.
Status cut_off(Env& env, const std::string& path, std::string_view dropped, std::size_t whole) {
  auto beside = env.open_append(path + ".dropped");
  if (!beside) {
    return beside.error();
  }
  if (Status kept = written(**beside, dropped); !kept) {
    return kept;
  }
  if (Status named = env.sync_folder(folder_of(path)); !named) {
    return named;
  }
  return env.truncate(path, whole);
}

}  // namespace

Result<std::unique_ptr<RecordLog>> RecordLog::create(Env& env, const std::string& path,
                                                     const Entry& first, Earlier earlier) {
  if (const Status gone = removed_if_there(env, unnamed(path)); !gone) {
    return gone.error();
  }
  auto file = env.open_append(unnamed(path));
  if (!file) {
    return file.error();
  }
  std::string bytes(kRecordsBegin);
  const std::uint32_t check =
      append_record(bytes, {1, first.type, first.version, first.payload}, kFirstCheck);
  if (const Status durable = written(**file, bytes); !durable) {
    std::ignore = env.remove(unnamed(path));
    return durable.error();
  }
  auto aside =
      earlier == Earlier::kKept ? moved_aside(env, path) : Result<std::string>(std::string());
  if (!aside) {
    return aside.error();
  }
  if (const Status named = env.rename(unnamed(path), path); !named) {
    return named.error();
  }
  if (const Status durable = env.sync_folder(folder_of(path)); !durable) {
    return durable.error();
  }
  // Reopened under its own name, which is what errors show.
  file = env.open_append(path);
  if (!file) {
    return file.error();
  }
  std::unique_ptr<RecordLog> log(new RecordLog(path, std::move(*file), 1, check));
  log->earlier_kept_as_ = std::move(*aside);
  return log;
}

Result<RecordLog::Reopened> RecordLog::reopen(Env& env, const std::string& path) {
  const auto bytes = env.read(path, kMaxLogBytes);
  if (!bytes) {
    return bytes.error();
  }
  auto read = read_records(*bytes, path);
  if (!read) {
    return read.error();
  }
  if (read->records.empty()) {
    return Error{path + ": holds no whole record"};
  }
  if (read->dropped_bytes > 0) {
    const std::string_view dropped = std::string_view(*bytes).substr(read->whole_bytes);
    if (const Status cut = cut_off(env, path, dropped, read->whole_bytes); !cut) {
      return cut.error();
    }
  }
  auto file = env.open_append(path);
  if (!file) {
    return file.error();
  }
  // A killed process may have written records without making them durable. They are read here and
  // will be built upon, so they must be made durable first.
  if (const Status durable = (*file)->sync(); !durable) {
    return durable.error();
  }
  if (const Status named = env.sync_folder(folder_of(path)); !named) {
    return named.error();
  }
  std::unique_ptr<RecordLog> log(
      new RecordLog(path, std::move(*file), read->records.size(), read->check));
  return Reopened{std::move(log), std::move(read->records), read->dropped_bytes};
}

std::unique_ptr<RecordLog> RecordLog::closed(const std::string& path, std::uint64_t durable,
                                             const Error& why) {
  std::unique_ptr<RecordLog> log(new RecordLog(path, nullptr, durable, kFirstCheck));
  log->failure_ = why;
  return log;
}

Status RecordLog::append(const Entry& entry) {
  if (failure_) {
    return *failure_;
  }
  std::string bytes;
  const std::uint32_t check =
      append_record(bytes, {durable_ + 1, entry.type, entry.version, entry.payload}, check_);
  if (const Status durable = written(*file_, bytes); !durable) {
    failure_ = durable.error();
    return durable;
  }
  ++durable_;
  check_ = check;
  return {};
}

Result<std::optional<std::string>> newest_log(Env& env, const std::string& path) {
  const auto names = env.list(folder_of(path));
  if (!names) {
    return names.error();
  }
  if (has(*names, path)) {
    return std::optional(path);
  }
  std::optional<std::string> newest;
  for (int number = 1; number <= kMaxEarlier && has(*names, earlier_name(path, number)); ++number) {
    newest = earlier_name(path, number);
  }
  return newest;
}

Result<RecordsRead> read_log(Env& env, const std::string& path) {
  const auto bytes = env.read(path, kMaxLogBytes);
  return bytes ? read_records(*bytes, path) : bytes.error();
}

}  // namespace orthonav::engine
