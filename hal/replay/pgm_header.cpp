#include "hal/replay/pgm_header.h"

#include <cctype>
#include <optional>

#include "hal/replay/text.h"

namespace orthonav::replay {

namespace {

/// Reads the fields: blanks and comments before each, one blank after the last.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}
  bool magic() {
    position_ = 2;
    return bytes_.substr(0, 2) == "P5";
  }
  std::optional<std::int64_t> number() {
    skip_blanks();
    const std::size_t begin = position_;
    while (position_ < bytes_.size() && is(&isdigit)) {
      ++position_;
    }
    if (begin == position_ || position_ - begin > 9) {
      return std::nullopt;
    }
    return parse_integer(bytes_.substr(begin, position_ - begin));
  }
  /// Bytes up to the first pixel.
  std::optional<std::size_t> end() {
    if (position_ >= bytes_.size() || !is(&isspace)) {
      return std::nullopt;
    }
    return position_ + 1;
  }

 private:
  std::string_view bytes_;
  std::size_t position_ = 0;

  bool is(int (*kind)(int)) const {
    return kind(static_cast<unsigned char>(bytes_[position_])) != 0;
  }
  void skip_blanks() {
    while (position_ < bytes_.size() && (is(&isspace) || bytes_[position_] == '#')) {
      if (bytes_[position_] == '#') {
        while (position_ < bytes_.size() && bytes_[position_] != '\n') {
          ++position_;
        }
      } else {
        ++position_;
      }
    }
  }
};

}  // namespace

Result<PgmHeader> parse_pgm_header(std::string_view bytes) {
  Fields fields(bytes);
  if (!fields.magic()) {
    return Error{"is not a binary PGM (P5)"};
  }
  const auto width = fields.number();
  const auto height = fields.number();
  const auto maximum = fields.number();
  const auto end = fields.end();
  if (!width || !height || !maximum || !end) {
    return Error{"has a broken PGM header"};
  }
  return PgmHeader{*width, *height, *maximum, *end};
}

}  // namespace orthonav::replay
