#include "engine/case/model_cache.h"

#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "base/file_code.h"
#include "engine/io/atomic_file.h"

namespace orthonav::engine {

namespace fs = std::filesystem;

namespace {

/// The whole file; empty if there is none, an Error if it can't be read.
Result<std::optional<std::string>> content_of(const std::string& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found) {
    return std::optional<std::string>();
  }
  // Reading a pipe might never return.
  if (!fs::is_regular_file(status)) {
    return Error{"is not a file"};
  }
  const std::uintmax_t size = fs::file_size(path, code);
  if (code) {
    return Error{"cannot be read: " + code.message(), file_code(code)};
  }
  if (size > kMaxPartsBytes) {
    return Error{"is damaged: " + std::to_string(size) + " bytes long"};
  }
  std::string bytes(size, '\0');
  std::ifstream in(path, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size))) {
    return Error{"cannot be read", ErrorCode::kIo};
  }
  return std::optional(std::move(bytes));
}

}  // namespace

std::string ModelCache::file_of(const MeshKey& key) const {
  return (fs::path(folder_) / (key.text() + ".model")).string();
}

std::shared_ptr<const nav::VertebraModel> ModelCache::load(const nav::TriangleMesh& mesh,
                                                           const MeshKey& key) {
  const std::string path = file_of(key);
  const auto again = [&](const Error& error) {
    notes_.push_back(path + ": " + error.message + "; the model was prepared again");
    return nullptr;
  };
  const auto bytes = content_of(path);
  if (!bytes) {
    return again(bytes.error());
  }
  if (!*bytes) {
    return nullptr;
  }
  auto parts = decoded(**bytes, key);
  if (!parts) {
    return again(parts.error());
  }
  auto model = nav::VertebraModel::restore(mesh, std::move(*parts));
  if (!model) {
    return again(Error{"does not fit its mesh (" + model.error().message + ")"});
  }
  return *model;
}

Result<std::shared_ptr<const nav::VertebraModel>> ModelCache::prepared(
    const nav::TriangleMesh& mesh) {
  if (folder_.empty()) {
    ++made_;
    return nav::VertebraModel::prepare(mesh);
  }
  const MeshKey key = MeshKey::of(mesh);
  if (auto model = load(mesh, key)) {
    ++loaded_;
    return model;
  }
  auto model = nav::VertebraModel::prepare(mesh);
  if (!model) {
    return model.error();
  }
  ++made_;
  unwritten_.push_back({key, *model});
  return *model;
}

void ModelCache::keep() {
  if (unwritten_.empty()) {
    return;
  }
  std::error_code ignored;  // writing says what is wrong
  fs::create_directories(folder_, ignored);
  for (const Unwritten& made : unwritten_) {
    if (const Status s = write_file(file_of(made.key), encoded(made.key, made.model->parts()));
        !s) {
      notes_.push_back("the prepared model is not kept: " + s.error().message);
    }
  }
  unwritten_.clear();
}

}  // namespace orthonav::engine
