#include "engine/io/av_error.h"

#include "base/file_code.h"

extern "C" {
#include <libavutil/error.h>
}

namespace orthonav::engine {
namespace {

/// What the system refused comes back as its errno, negated; libav's own codes are far larger.
ErrorCode code_of(int code) {
  const int error_number = AVUNERROR(code);
  const bool is_refusal = error_number > 0 && error_number < 256 && error_number != EINVAL;
  return is_refusal ? file_code(error_number) : ErrorCode::kInvalid;
}

}  // namespace

Error av_error(const std::string& path, const std::string& what, int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof(text));
  return Error{path + ": " + what + " (" + text + ")", code_of(code)};
}

}  // namespace orthonav::engine
