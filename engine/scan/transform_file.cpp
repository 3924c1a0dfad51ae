#include "engine/scan/transform_file.h"

#include <chrono>
#include <cstdint>

#include "base/write_all.h"
#include "engine/io/atomic_file.h"
#include "engine/io/json_document.h"
#include "engine/io/text_fields.h"
#include "engine/io/tfm_file.h"
#include "engine/scan/child_process.h"
#include "engine/scan/transform_hdf5.h"

namespace orthonav::engine {
namespace {

/// Many times what a megabyte needs.
constexpr ChildLimits kLimits{std::chrono::seconds(10), std::uint64_t{1} << 28u};

/// From one process to the other: the first byte says whether text of a `.tfm` file follows, or why
/// there is none.
constexpr char kFound = '+';
constexpr char kRefused = '-';

bool write_found(int file, const Result<StoredTransform>& found) {
  return write_all(file, found ? kFound + tfm_text(*found) : kRefused + found.error().message) == 0;
}

bool is_hdf5_name(const std::string& path) { return lower_case(path).ends_with(".h5"); }

}  // namespace

Result<StoredTransform> load_transform(const std::string& path) {
  const auto bytes = read_text(path, kLongestTransformFile);
  if (!bytes) {
    return bytes.error();
  }
  if (!is_hdf5(*bytes)) {
    return transform_from_tfm(*bytes, path);
  }
  const auto answer = bytes_from_child(
      kLimits, [&](int file) { return write_found(file, transform_from_hdf5(*bytes)); });
  if (!answer) {
    return Error{path + ": " + answer.error().message, answer.error().code};
  }
  if (answer->view().empty()) {
    return Error{path + ": its reader said nothing", ErrorCode::kIo};
  }
  const std::string_view said = answer->view().substr(1);
  if (answer->view().front() == kRefused) {
    return Error{path + ": " + std::string(said)};
  }
  return transform_from_tfm(said, path);
}

Status check_transform_name(const std::string& path) {
  if (is_hdf5_name(path) || lower_case(path).ends_with(".tfm")) {
    return {};
  }
  return Error{path + ": must end in .tfm or .h5"};
}

Status save_transform(const std::string& path, const StoredTransform& transform) {
  if (Status s = check_transform_name(path); !s) {
    return s;
  }
  if (!is_hdf5_name(path)) {
    return write_file(path, tfm_text(transform));
  }
  const auto bytes = hdf5_from_transform(transform);
  return bytes ? write_file(path, *bytes) : Status{Error{path + ": " + bytes.error().message}};
}

}  // namespace orthonav::engine
