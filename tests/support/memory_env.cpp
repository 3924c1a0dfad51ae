#include "tests/support/memory_env.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include "engine/io/file_names.h"

namespace orthonav::test {
namespace {

using engine::file_error;
using What = EnvCall::What;

constexpr const char* kReading = "cannot be read";
constexpr const char* kWriting = "cannot be written";

class MemoryLock : public engine::FolderLock {
 public:
  MemoryLock(std::shared_ptr<std::set<std::string>> locked, std::string folder)
      : locked_(std::move(locked)), folder_(std::move(folder)) {}
  ~MemoryLock() override { locked_->erase(folder_); }

 private:
  std::shared_ptr<std::set<std::string>> locked_;
  std::string folder_;
};

}  // namespace

class MemoryFile : public engine::AppendFile {
 public:
  MemoryFile(MemoryEnv& env, std::string path, std::shared_ptr<std::string> content)
      : env_(env), path_(std::move(path)), content_(std::move(content)) {}

  Status append(std::string_view bytes) override {
    EnvCall made{What::kAppend, path(), "", std::string(bytes)};
    const int problem = env_.call(made);
    if (problem != 0) {
      env_.calls_.back().bytes.resize(bytes.size() / 2);
    }
    *content_ += env_.calls_.back().bytes;
    return problem == 0 ? Status{} : file_error(path_, kWriting, problem);
  }

  Status sync() override {
    const int problem = env_.call({What::kSync, path(), "", ""});
    return problem == 0 ? Status{} : file_error(path_, kWriting, problem);
  }

 private:
  /// Its present name: an open file follows a rename.
  [[nodiscard]] std::string path() const {
    for (const auto& [name, content] : env_.files_) {
      if (content == content_) {
        return name;
      }
    }
    return "(no name)";
  }

  MemoryEnv& env_;
  std::string path_;
  std::shared_ptr<std::string> content_;
};

MemoryEnv::MemoryEnv(Files files) : locked_(std::make_shared<std::set<std::string>>()) {
  for (auto& [name, content] : files) {
    files_[name] = std::make_shared<std::string>(std::move(content));
  }
}

void MemoryEnv::fail_at(std::size_t n, int error_number, bool from_then_on) {
  fail_at_ = n;
  error_number_ = error_number;
  from_then_on_ = from_then_on;
}

int MemoryEnv::call(EnvCall call) {
  const std::size_t n = calls_.size();
  const bool fails = fail_at_ && (n == *fail_at_ || (from_then_on_ && n > *fail_at_));
  call.failed = fails;
  calls_.push_back(std::move(call));
  return fails ? error_number_ : 0;
}

void MemoryEnv::fail_look_at(std::size_t n, int error_number) {
  fail_look_at_ = n;
  look_error_number_ = error_number;
}

int MemoryEnv::look() { return looks_++ == fail_look_at_ ? look_error_number_ : 0; }

Files MemoryEnv::files() const {
  Files files;
  for (const auto& [name, content] : files_) {
    files[name] = *content;
  }
  return files;
}

Result<std::unique_ptr<engine::AppendFile>> MemoryEnv::open_append(const std::string& path) {
  if (const int problem = call({What::kOpen, path, "", ""}); problem != 0) {
    return file_error(path, kWriting, problem);
  }
  Content& content = files_[path];
  if (!content) {
    content = std::make_shared<std::string>();
  }
  return std::unique_ptr<engine::AppendFile>(std::make_unique<MemoryFile>(*this, path, content));
}

Result<std::string> MemoryEnv::read(const std::string& path, std::size_t most_bytes) {
  int problem = look();
  const auto file = files_.find(path);
  problem = problem == 0 && file == files_.end() ? ENOENT : problem;
  problem = problem == 0 && file->second->size() > most_bytes ? EFBIG : problem;
  return problem == 0 ? Result<std::string>(*file->second) : file_error(path, kReading, problem);
}

Result<std::vector<std::string>> MemoryEnv::list(const std::string& folder) {
  if (const int problem = look(); problem != 0) {
    return file_error(folder, kReading, problem);
  }
  std::vector<std::string> names;
  for (const auto& [path, content] : files_) {
    if (engine::folder_of(path) == folder) {
      names.push_back(path.substr(path.rfind('/') + 1));
    }
  }
  return names;
}

Status MemoryEnv::rename(const std::string& from, const std::string& to) {
  int problem = call({What::kRename, from, to, ""});
  const auto file = files_.find(from);
  problem = problem == 0 && file == files_.end() ? ENOENT : problem;
  if (problem != 0) {
    return file_error(to, kWriting, problem);
  }
  const Content content = file->second;
  files_.erase(file);
  files_[to] = content;
  return {};
}

Status MemoryEnv::truncate(const std::string& path, std::size_t bytes) {
  int problem = call({What::kTruncate, path, "", "", bytes});
  problem = problem == 0 && files_.count(path) == 0 ? ENOENT : problem;
  if (problem != 0) {
    return file_error(path, kWriting, problem);
  }
  files_[path]->resize(bytes);
  return {};
}

Status MemoryEnv::remove(const std::string& path) {
  if (files_.count(path) == 0) {
    return file_error(path, "cannot be removed", ENOENT);
  }
  if (const int problem = call({What::kRemove, path, "", ""}); problem != 0) {
    return file_error(path, "cannot be removed", problem);
  }
  files_.erase(path);
  return {};
}

Status MemoryEnv::sync_folder(const std::string& folder) {
  const int problem = call({What::kSyncFolder, folder, "", ""});
  return problem == 0 ? Status{} : file_error(folder, kWriting, problem);
}

Result<std::unique_ptr<engine::FolderLock>> MemoryEnv::lock(const std::string& folder) {
  if (const int problem = look(); problem != 0) {
    return file_error(folder, "cannot be locked", problem);
  }
  if (!locked_->insert(folder).second) {
    return engine::folder_in_use(folder);
  }
  return std::unique_ptr<engine::FolderLock>(std::make_unique<MemoryLock>(locked_, folder));
}

}  // namespace orthonav::test
