#include "study/study_store.h"

#include <sqlite3.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/check.h"
#include "base/file_code.h"
#include "engine/io/bit_hash.h"
#include "engine/io/file_names.h"
#include "engine/io/posix_env.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;

/// "ONST": marks our files (PRAGMA application_id).
constexpr int kApplication = 0x4f4e5354;
constexpr int kLayout = 1;
constexpr int kBusy_ms = 10'000;

constexpr const char* kCreate =
    "CREATE TABLE study (hash TEXT PRIMARY KEY, definition TEXT NOT NULL) STRICT;"
    "CREATE TABLE operation (study TEXT NOT NULL REFERENCES study (hash), number INTEGER NOT NULL,"
    " case_name TEXT NOT NULL, seed TEXT NOT NULL, report TEXT, why TEXT,"
    " PRIMARY KEY (study, number)) STRICT;";

/// A file's entry is durable once its folder is.
Status sync_folder_of(const std::string& file) { return PosixEnv().sync_folder(folder_of(file)); }

class Statement {
 public:
  Statement(sqlite3* database, const std::string& text) {
    sqlite3_prepare_v2(database, text.c_str(), -1, &statement_, nullptr);
  }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement() { sqlite3_finalize(statement_); }

  void bind(int place, const std::string& text) {
    sqlite3_bind_text(statement_, place, text.data(), static_cast<int>(text.size()),
                      SQLITE_TRANSIENT);
  }
  void bind(int place, std::int64_t number) { sqlite3_bind_int64(statement_, place, number); }
  int step() { return statement_ ? sqlite3_step(statement_) : SQLITE_ERROR; }
  [[nodiscard]] std::string text(int column) const {
    const auto* found = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return found ? std::string(found,
                               static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)))
                 : std::string();
  }
  [[nodiscard]] std::int64_t number(int column) const {
    return sqlite3_column_int64(statement_, column);
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
};

std::optional<std::uint64_t> as_seed(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 20 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  return digits ? std::optional(std::stoull(text)) : std::nullopt;
}

}  // namespace

struct StudyStore::Database {
  sqlite3* handle = nullptr;
  ~Database() { sqlite3_close(handle); }

  [[nodiscard]] Error failed(const std::string& path) const {
    return Error{path + ": " + (handle ? sqlite3_errmsg(handle) : "out of memory"), code(path)};
  }
  [[nodiscard]] ErrorCode code(const std::string& path) const {
    switch (handle ? sqlite3_errcode(handle) & 0xff : SQLITE_NOMEM) {
      case SQLITE_CANTOPEN:
        return code_of_unopened(path);
      case SQLITE_FULL:
      case SQLITE_IOERR:
      case SQLITE_READONLY:
        return ErrorCode::kIo;
      case SQLITE_BUSY:
        return ErrorCode::kUnavailable;
      default:
        return ErrorCode::kInvalid;
    }
  }
  Status execute(const std::string& path, const std::string& text) const {
    return sqlite3_exec(handle, text.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK
               ? Status()
               : Status(failed(path));
  }
  [[nodiscard]] std::int64_t pragma(const std::string& text) const {
    Statement asked(handle, text);
    return asked.step() == SQLITE_ROW ? asked.number(0) : 0;
  }
  /// Makes the tables of a new file.
  Status begin(const std::string& path, const std::string& definition) const {
    const std::string tables =
        "BEGIN IMMEDIATE; PRAGMA application_id = " + std::to_string(kApplication) +
        "; PRAGMA user_version = " + std::to_string(kLayout) + ";" + kCreate;
    if (Status made = execute(path, tables); !made) {
      return made;
    }
    {
      Statement add(handle, "INSERT INTO study VALUES (?, ?)");
      add.bind(1, study_hash(definition));
      add.bind(2, definition);
      if (add.step() != SQLITE_DONE) {
        return failed(path);
      }
    }
    return execute(path, "COMMIT");
  }
  /// Takes over what another file holds.
  Status join(const std::string& path, const std::string& definition_here) const {
    Statement attach(handle, "ATTACH ? AS shard");
    attach.bind(1, path);
    if (attach.step() != SQLITE_DONE) {
      return Error{path + ": " + sqlite3_errstr(sqlite3_errcode(handle)), code(path)};
    }
    const auto found = definition(path, "shard");
    if (!found) {
      return found.error();
    }
    if (*found != definition_here) {
      return Error{path + ": holds study " + study_hash(*found) + ", the others hold " +
                   study_hash(definition_here)};
    }
    {
      Statement differing(handle,
                          "SELECT number FROM main.operation AS known JOIN shard.operation AS more "
                          "USING (study, number) WHERE known.report IS NOT more.report LIMIT 1");
      const int answer = differing.step();
      if (answer == SQLITE_ROW) {
        return Error{path + ": operation " + differing.text(0) +
                     " has another result than in the other files"};
      }
      if (answer != SQLITE_DONE) {
        return failed(path);
      }
    }
    return execute(path,
                   "INSERT OR IGNORE INTO main.operation SELECT * FROM shard.operation;"
                   "DETACH shard");
  }
  /// The definition of the study in the file that is attached as `file`.
  [[nodiscard]] Result<std::string> definition(const std::string& path,
                                               const std::string& file = "main") const {
    if (pragma("PRAGMA " + file + ".application_id") != kApplication) {
      return Error{path + ": is not a study of orthonav"};
    }
    if (const auto layout = pragma("PRAGMA " + file + ".user_version"); layout != kLayout) {
      return Error{path + ": layout " + std::to_string(layout) + ", this version reads " +
                   std::to_string(kLayout)};
    }
    Statement asked(handle, "SELECT hash, definition FROM " + file + ".study");
    if (asked.step() != SQLITE_ROW) {
      return Error{path + ": holds no study"};
    }
    std::string found = asked.text(1);
    if (study_hash(found) != asked.text(0)) {
      return Error{path + ": its definition does not belong to its hash; the file is damaged"};
    }
    return found;
  }
};

StudyStore::StudyStore(std::unique_ptr<Database> database, std::string path, std::string definition,
                       bool growing)
    : database_(std::move(database)),
      path_(std::move(path)),
      definition_(std::move(definition)),
      hash_(study_hash(definition_)),
      growing_(growing) {}
StudyStore::StudyStore(StudyStore&&) noexcept = default;
StudyStore& StudyStore::operator=(StudyStore&&) noexcept = default;
StudyStore::~StudyStore() = default;

std::string study_hash(const std::string& definition) { return hash_text(fnv1a(definition)); }

Result<StudyStore> StudyStore::open(const std::string& path, const std::string& definition) {
  std::error_code code;
  const bool lasting = !path.empty();
  const bool growing = lasting && !fs::exists(path, code);
  const std::string file = growing ? path + ".part" : path;
  const bool there = fs::exists(file, code);
  auto database = std::make_unique<Database>();
  // What is joined to a temporary one is opened likewise: an absent file is not made.
  const int flags =
      SQLITE_OPEN_READWRITE | SQLITE_OPEN_FULLMUTEX | (lasting ? SQLITE_OPEN_CREATE : 0);
  if (sqlite3_open_v2(file.c_str(), &database->handle, flags, nullptr) != SQLITE_OK) {
    return database->failed(file);
  }
  sqlite3_busy_timeout(database->handle, kBusy_ms);
  if (!there || database->pragma("PRAGMA page_count") == 0) {
    if (Status begun = database->begin(file, definition); !begun) {
      return begun.error();
    }
    if (Status synced = lasting ? sync_folder_of(file) : Status(); !synced) {
      return synced.error();
    }
  }
  const auto found = database->definition(file);
  if (!found) {
    return found.error();
  }
  if (*found != definition) {
    return Error{file + ": holds study " + study_hash(*found) + ", this is " +
                 study_hash(definition) + "; another version, or other settings"};
  }
  return StudyStore(std::move(database), lasting ? path : "the study's temporary file", definition,
                    growing);
}

Result<StudyStore> StudyStore::joined(std::span<const std::string> paths) {
  ORTHONAV_CHECK(!paths.empty());
  Database first;
  if (sqlite3_open_v2(paths.front().c_str(), &first.handle, SQLITE_OPEN_READWRITE, nullptr) !=
      SQLITE_OK) {
    return first.failed(paths.front());
  }
  const auto definition = first.definition(paths.front());
  if (!definition) {
    return definition.error();
  }
  auto store = open("", *definition);
  if (!store) {
    return store.error();
  }
  for (const std::string& path : paths) {
    if (Status joined = store->database_->join(path, *definition); !joined) {
      return joined.error();
    }
  }
  store->path_ = paths.front() + (paths.size() > 1 ? " and the others" : "");
  return store;
}

Status StudyStore::for_each(const std::function<Status(const StoredOperation&)>& take) const {
  Statement asked(database_->handle,
                  "SELECT number, case_name, seed, report, why FROM operation ORDER BY number");
  int answer = asked.step();
  for (; answer == SQLITE_ROW; answer = asked.step()) {
    const std::string named = path_ + ": operation " + asked.text(0);
    const auto seed = as_seed(asked.text(2));
    if (!seed) {
      return Error{named + ": seed is '" + asked.text(2) + "', must be a whole number"};
    }
    const StoredOperation operation{static_cast<int>(asked.number(0)), asked.text(1), *seed,
                                    asked.text(3), asked.text(4)};
    if (!operation.report.empty() && !nlohmann::json::accept(operation.report)) {
      return Error{named + ": report is not JSON"};
    }
    if (Status taken = take(operation); !taken) {
      return taken;
    }
  }
  return answer == SQLITE_DONE ? Status() : Status(database_->failed(path_));
}

Status StudyStore::add(const StoredOperation& operation) {
  Statement add(database_->handle, "INSERT OR IGNORE INTO operation VALUES (?, ?, ?, ?, ?, ?)");
  add.bind(1, hash_);
  add.bind(2, operation.index);
  add.bind(3, operation.case_name);
  add.bind(4, std::to_string(operation.seed));
  add.bind(5, operation.report);
  add.bind(6, operation.why);
  return add.step() == SQLITE_DONE ? Status() : Status(database_->failed(path_));
}

Status StudyStore::finish() {
  if (!growing_) {
    return {};
  }
  database_.reset();
  std::error_code code;
  fs::rename(path_ + ".part", path_, code);
  if (code) {
    return Error{path_ + ": " + code.message(), file_code(code)};
  }
  growing_ = false;
  return sync_folder_of(path_);
}

}  // namespace orthonav::engine
