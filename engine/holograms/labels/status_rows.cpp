#include "engine/holograms/labels/status_rows.h"

#include <algorithm>
#include <array>

#include "render/text/font.h"
#include "render/text/text_layout.h"

namespace orthonav::engine {
namespace {

constexpr std::string_view kEllipsis = "…";
constexpr std::string_view kSeparators = " ;,:|";
/// The end of a row stands for these.
constexpr std::string_view kLeftOutAtAnEnd = " ;|";
/// More than any rows hold.
constexpr std::size_t kMostBytes = 1024;

const render::Font& embedded_font() {
  static const render::Font font;
  return font;
}

/// A text with some of its parts dropped.
class Candidate {
 public:
  Candidate(std::string_view text, const StatusParts& parts) : text_(text), parts_(parts) {
    kept_.fill(true);
    write();
  }
  [[nodiscard]] std::string_view text() const { return {bytes_.data(), size_}; }

  /// False if only one part is left.
  bool drop_least() {
    std::size_t least = parts_.count;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < parts_.count; ++i) {
      if (!kept_[i]) {
        continue;
      }
      ++kept;
      if (least == parts_.count || parts_.parts[i].importance >= parts_.parts[least].importance) {
        least = i;
      }
    }
    if (kept < 2) {
      return false;
    }
    kept_[least] = false;
    write();
    return true;
  }

 private:
  void put(std::string_view piece) {
    const std::size_t count = std::min(piece.size(), bytes_.size() - size_);
    std::copy_n(piece.begin(), count, bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += count;
  }
  void write() {
    size_ = 0;
    bool whole = true;
    for (std::size_t i = 0; i < parts_.count; ++i) {
      const StatusPart& part = parts_.parts[i];
      whole = whole && kept_[i];
      if (!kept_[i]) {
        continue;
      }
      const std::size_t end = i + 1 < parts_.count ? parts_.parts[i + 1].begin : text_.size();
      const std::size_t begin = part.begin + (size_ == 0 ? part.separator : 0);
      put(text_.substr(begin, end - begin));
    }
    if (parts_.count == 0) {
      put(text_);
    }
    if (!whole) {
      const std::size_t last = text().find_last_not_of(kSeparators);
      size_ = last == std::string_view::npos ? 0 : last + 1;
      put(" ");
      put(kEllipsis);
    }
  }

  std::string_view text_;
  const StatusParts& parts_;
  std::array<bool, StatusParts::kMost> kept_{};
  std::array<char, kMostBytes> bytes_{};
  std::size_t size_ = 0;
};

/// As many whole words as fit; at least the first word, even if it does not.
std::string_view first_row(std::string_view text) {
  std::size_t end = std::min(text.find(' '), text.size());
  while (end < text.size()) {
    const std::size_t next = std::min(text.find(' ', end + 1), text.size());
    if (width_caps(text.substr(0, next)) > kStatusWidth_caps) {
      break;
    }
    end = next;
  }
  return text.substr(0, end);
}

std::string_view without_separators(std::string_view row, std::string_view at_end = kSeparators) {
  const std::size_t first = row.find_first_not_of(kSeparators);
  const std::size_t last = row.find_last_not_of(at_end);
  return first == std::string_view::npos ? std::string_view{} : row.substr(first, last + 1 - first);
}

/// False where it takes more rows, or a word is wider than one.
bool wrap(std::string_view text, std::span<std::string_view> rows) {
  bool fits = true;
  for (std::string_view& row : rows) {
    const bool last = &row == &rows.back();
    const std::string_view whole = first_row(text);
    row = last ? without_separators(text) : without_separators(whole, kLeftOutAtAnEnd);
    fits = fits && width_caps(row) <= kStatusWidth_caps;
    text = without_separators(text.substr(last ? text.size() : whole.size()));
  }
  return fits;
}

}  // namespace

float width_caps(std::string_view text) {
  float width = 0;
  while (const auto code = render::take_code_point(text)) {
    width += embedded_font().glyph(*code).advance;
  }
  return width;
}

void append_cut(std::string& out, std::string_view text, float most_caps) {
  if (width_caps(text) <= most_caps) {
    out += text;
    return;
  }
  const float room = most_caps - width_caps(kEllipsis);
  float width = 0;
  std::string_view rest = text;
  std::size_t end = 0;
  while (const auto code = render::take_code_point(rest)) {
    width += embedded_font().glyph(*code).advance;
    if (width > room) {
      break;
    }
    end = text.size() - rest.size();
  }
  out.append(without_separators(text.substr(0, end))).append(kEllipsis);
}

void fill_rows(std::string_view text, const StatusParts& parts, std::span<std::string*> rows) {
  std::array<std::string_view, kDetailRows> found;
  const auto used = std::span(found).first(std::min(rows.size(), found.size()));
  Candidate candidate(text, parts);
  while (!wrap(candidate.text(), used) && candidate.drop_least()) {
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i]->clear();
    append_cut(*rows[i], i < used.size() ? used[i] : std::string_view{}, kStatusWidth_caps);
  }
}

}  // namespace orthonav::engine
