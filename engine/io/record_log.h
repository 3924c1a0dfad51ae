#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/io/env.h"
#include "engine/io/records.h"

namespace orthonav::engine {

/// A file of records that only grows. One thread at a time.
class RecordLog {
 public:
  /// An entry to be recorded; the log assigns its number.
  struct Entry {
    std::uint16_t type = 0;
    std::uint16_t version = 0;
    std::string payload;
  };
  /// What happens to an earlier file of the same name: it is renamed to PATH-1, PATH-2, ... (before
  /// the extension), or the new one replaces it.
  enum class Earlier : std::uint8_t { kKept, kReplaced };
  /// Creates a file that holds its first record before it gets its name. Callers of this and of
  /// `reopen` hold the folder's lock.
  static Result<std::unique_ptr<RecordLog>> create(Env& env, const std::string& path,
                                                   const Entry& first,
                                                   Earlier earlier = Earlier::kKept);

  struct Reopened;
  /// Continues a file that has at least one record. Bytes after its last whole record are copied to
  /// PATH.dropped, then cut off. `kNotFound` if there is no such file.
  static Result<Reopened> reopen(Env& env, const std::string& path);
  /// A log of `durable` records that is closed for writing because of `why`.
  static std::unique_ptr<RecordLog> closed(const std::string& path, std::uint64_t durable,
                                           const Error& why);

  /// The record is durable when this succeeds. The first Error is final: nothing is written after
  /// it, and every further call returns it. A failed sync is not retried, since a second one may
  /// succeed although the first one lost data.
  Status append(const Entry& entry);

  /// The number of the last record that is durable.
  [[nodiscard]] std::uint64_t durable() const { return durable_; }
  /// Why nothing is written any more; absent while the log works.
  [[nodiscard]] const std::optional<Error>& failure() const { return failure_; }
  [[nodiscard]] const std::string& path() const { return path_; }
  /// The new name of an earlier file; empty: there was none.
  [[nodiscard]] const std::string& earlier_kept_as() const { return earlier_kept_as_; }

 private:
  RecordLog(std::string path, std::unique_ptr<AppendFile> file, std::uint64_t durable,
            std::uint32_t check)
      : path_(std::move(path)), file_(std::move(file)), durable_(durable), check_(check) {}

  std::string path_;
  std::unique_ptr<AppendFile> file_;
  std::uint64_t durable_ = 0;
  std::uint32_t check_ = kFirstCheck;  ///< of the last record
  std::string earlier_kept_as_;
  std::optional<Error> failure_;
};

struct RecordLog::Reopened {
  std::unique_ptr<RecordLog> log;
  std::vector<Record> records;
  std::size_t dropped_bytes = 0;
};

/// The file that holds the last operation begun under this name: PATH, or the newest of PATH-1,
/// PATH-2, ... if a crash came before the new PATH was made. Nothing if there is none.
Result<std::optional<std::string>> newest_log(Env& env, const std::string& path);

/// Reads a log and changes nothing.
Result<RecordsRead> read_log(Env& env, const std::string& path);

}  // namespace orthonav::engine
