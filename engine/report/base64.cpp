#include "engine/report/base64.h"

extern "C" {
#include <libavutil/base64.h>
}

namespace orthonav::engine {

std::string base64(std::span<const std::uint8_t> bytes) {
  std::string out(static_cast<std::size_t>(AV_BASE64_SIZE(bytes.size())), '\0');
  if (bytes.empty()) {
    return {};
  }
  av_base64_encode(out.data(), static_cast<int>(out.size()), bytes.data(),
                   static_cast<int>(bytes.size()));
  out.resize(out.size() - 1);  // the library counts its terminating zero
  return out;
}

}  // namespace orthonav::engine
