#include "hal/igtl/text_message.h"

namespace orthonav::igtl {
namespace {

// IANA's numbers of character sets.
constexpr std::uint64_t kAscii = 3;
constexpr std::uint64_t kUtf8 = 106;
constexpr std::size_t kBeforeText = 4;  ///< encoding and length

}  // namespace

Result<std::string> text_in(const Header& header, Bytes body) {
  const auto content = content_of(header, body);
  if (!content) {
    return content.error();
  }
  const Bytes bytes = content->bytes;
  const std::string what = header.type + " " + header.device + ": ";
  if (bytes.size() < kBeforeText || number_in(bytes.subspan(2, 2)) != bytes.size() - kBeforeText) {
    return Error{what + std::to_string(bytes.size()) + " bytes, which is not its length"};
  }
  const std::uint64_t encoding = number_in(bytes.first(2));
  if (encoding != kAscii && encoding != kUtf8) {
    return Error{what + "encoding " + std::to_string(encoding) +
                 ", must be 3 (ASCII) or 106 (UTF-8)"};
  }
  const Bytes text = bytes.subspan(kBeforeText);
  return std::string(text.begin(), text.end());
}

}  // namespace orthonav::igtl
