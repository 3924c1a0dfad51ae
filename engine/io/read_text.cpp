#include <filesystem>
#include <fstream>
#include <vector>

#include "base/file_code.h"
#include "engine/io/json_document.h"

namespace orthonav::engine {

Result<std::string> read_text(const std::string& path, std::size_t max_bytes) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem)) {
    return Error{path + ": is a folder, not a file"};
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    return Error{path + ": cannot be opened", code_of_unopened(path)};
  }
  std::string text;
  std::vector<char> block(1u << 16u);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (text.size() > max_bytes) {
      return Error{path + ": larger than " + std::to_string(max_bytes >> 20u) + " MiB"};
    }
  }
  if (in.bad()) {
    return Error{path + ": cannot be read", ErrorCode::kIo};
  }
  return text;
}

}  // namespace orthonav::engine
