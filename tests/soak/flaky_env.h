#pragma once

#include <atomic>
#include <cerrno>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/io/file_names.h"
#include "engine/io/posix_env.h"

namespace orthonav::soak {

/// This machine's files on a disk that can be full for a while.
class FlakyEnv : public engine::PosixEnv {
 public:
  void set_full(bool full) { full_ = full; }
  Result<std::unique_ptr<engine::AppendFile>> open_append(const std::string& path) override {
    auto file = PosixEnv::open_append(path);
    return file ? Result<std::unique_ptr<engine::AppendFile>>(
                      std::make_unique<File>(std::move(*file), path, full_))
                : file.error();
  }

 private:
  class File : public engine::AppendFile {
   public:
    File(std::unique_ptr<engine::AppendFile> inner, std::string path, const std::atomic<bool>& full)
        : inner_(std::move(inner)), path_(std::move(path)), full_(full) {}
    Status append(std::string_view bytes) override {
      return full_ ? Status(engine::file_error(path_, "cannot be written", ENOSPC))
                   : inner_->append(bytes);
    }
    Status sync() override { return inner_->sync(); }

   private:
    std::unique_ptr<engine::AppendFile> inner_;
    std::string path_;
    const std::atomic<bool>& full_;
  };
  std::atomic<bool> full_ = false;
};

}  // namespace orthonav::soak
