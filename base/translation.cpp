#include "base/translation.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/beside_limit.h"

namespace orthonav {
namespace {

// Written before any thread is started (decision 0108).
std::shared_ptr<const Translation> in_use;  // NOLINT
thread_local bool for_wearer = false;       // NOLINT

const Translation* wanted() { return for_wearer ? in_use.get() : nullptr; }

/// Null where nothing is translated.
const std::string* found(std::string_view english) {
  const Translation* const translation = wanted();
  return translation != nullptr ? translation->find(english) : nullptr;
}

/// Length of the conversion at the front of a format; 2 for `%%`.
std::size_t conversion_length(std::string_view format) {
  const std::size_t end = format.find_first_not_of("-+ #0123456789.*hlzjtL", 1);
  return end == std::string_view::npos ? format.size() : end + 1;
}

/// One piece of a format: literal text, or a conversion.
struct Piece {
  std::string_view text;
  bool conversion = false;
};

/// Takes the next piece off a format that is not empty. `%%` is the literal text "%".
Piece take_piece(std::string_view& format) {
  if (format[0] != '%') {
    const std::size_t end = std::min(format.find('%'), format.size());
    const Piece piece{format.substr(0, end), false};
    format.remove_prefix(end);
    return piece;
  }
  const std::size_t length = conversion_length(format);
  const bool percent = length == 2 && format[1] == '%';
  const Piece piece{format.substr(0, percent ? 1 : length), !percent};
  format.remove_prefix(length);
  return piece;
}

constexpr std::array<const char*, 2> kJust = {kJustOver, kJustUnder};

/// The values that were printed into a text.
struct Values {
  static constexpr std::size_t kMost = 8;
  std::array<std::string_view, kMost> texts{};
  std::size_t count = 0;
};

/// Length of the number at the front of a text, with the words that base/printed.h may put before
/// it; 0 if there is none.
std::size_t number_length(std::string_view text) {
  std::size_t begin = 0;
  for (const char* const just : kJust) {
    const std::string_view word = just;
    if (text.starts_with(word) && text.substr(word.size()).starts_with(' ')) {
      begin = word.size() + 1;
    }
  }
  std::size_t end = begin + (text.substr(begin).starts_with('-') ? 1 : 0);
  for (const std::string_view odd : {"inf", "nan"}) {
    if (text.substr(end).starts_with(odd)) {
      return end + odd.size();
    }
  }
  const std::size_t digits = end;
  end = std::min(text.find_first_not_of("0123456789.", end), text.size());
  if (end == digits) {
    return 0;
  }
  if (text.substr(end).starts_with("e+") || text.substr(end).starts_with("e-")) {
    end = std::min(text.find_first_not_of("0123456789", end + 2), text.size());
  }
  return end;
}

/// Length of the value at the front of a text, up to what comes behind it in the format.
std::optional<std::size_t> value_length(const Piece& conversion, std::string_view format,
                                        std::string_view text) {
  if (conversion.text.back() != 's') {
    const std::size_t length = number_length(text);
    return length > 0 ? std::optional(length) : std::nullopt;
  }
  if (format.empty()) {
    return text.size();
  }
  const Piece behind = take_piece(format);
  const std::size_t at = behind.conversion ? std::string_view::npos : text.find(behind.text);
  return at == std::string_view::npos ? std::nullopt : std::optional(at);
}

/// Reads the values back from a text if it was printed from this format.
std::optional<Values> values_in(std::string_view text, std::string_view format) {
  Values values;
  while (!format.empty()) {
    const Piece piece = take_piece(format);
    std::size_t length = piece.text.size();
    if (piece.conversion) {
      const auto found = value_length(piece, format, text);
      if (!found || values.count == Values::kMost) {
        return std::nullopt;
      }
      length = *found;
      values.texts[values.count++] = text.substr(0, length);
    } else if (!text.starts_with(piece.text)) {
      return std::nullopt;
    }
    text.remove_prefix(length);
  }
  return text.empty() ? std::optional(values) : std::nullopt;
}

std::size_t literal_length(std::string_view format) {
  std::size_t length = 0;
  while (!format.empty()) {
    const Piece piece = take_piece(format);
    length += piece.conversion ? 0 : piece.text.size();
  }
  return length;
}

/// A number, maybe "just over" its limit, or a text that may have a translation of its own.
void append_value(std::string& out, std::string_view value) {
  for (const char* const just : kJust) {
    const std::string_view word = just;
    if (value.starts_with(word)) {
      out += translated(word);
      value.remove_prefix(word.size());
    }
  }
  out += translated(value);
}

void append_filled(std::string& out, std::string_view format, const Values& values) {
  std::size_t next = 0;
  while (!format.empty()) {
    const Piece piece = take_piece(format);
    if (!piece.conversion) {
      out += piece.text;
    } else if (next < values.count) {
      append_value(out, values.texts[next++]);
    }
  }
}

}  // namespace

Translation::Translation(std::vector<Entry> entries) : entries_(std::move(entries)) {
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return a.english < b.english; });
}

const std::string* Translation::find(std::string_view english) const {
  const auto found = std::lower_bound(
      entries_.begin(), entries_.end(), english,
      [](const Entry& entry, std::string_view key) { return entry.english < key; });
  return found != entries_.end() && found->english == english ? &found->text : nullptr;
}

void use_translation(std::shared_ptr<const Translation> translation) {
  in_use = std::move(translation);
}

const char* translated(const char* english) {
  const std::string* const text = found(english);
  return text != nullptr ? text->c_str() : english;
}

std::string_view translated(std::string_view english) {
  const std::string* const text = found(english);
  return text != nullptr ? std::string_view(*text) : english;
}

void append_retold(std::string& out, std::string_view english) {
  const Translation* const translation = wanted();
  if (translation == nullptr) {
    out += english;
    return;
  }
  // Of several formats that fit, the one that leaves least to its values.
  const Translation::Entry* best = nullptr;
  Values values;
  for (const Translation::Entry& entry : translation->entries()) {
    const auto found = values_in(english, entry.english);
    if (found &&
        (best == nullptr || literal_length(entry.english) > literal_length(best->english))) {
      best = &entry;
      values = *found;
    }
  }
  if (best == nullptr) {
    out.append("\"").append(english).append("\"");
    return;
  }
  append_filled(out, best->text, values);
}

WearersLanguage::WearersLanguage() : before_(std::exchange(for_wearer, true)) {}
WearersLanguage::~WearersLanguage() { for_wearer = before_; }

std::vector<std::string_view> conversions_of(std::string_view format) {
  std::vector<std::string_view> conversions;
  while (!format.empty()) {
    const Piece piece = take_piece(format);
    if (piece.conversion) {
      conversions.push_back(piece.text);
    }
  }
  return conversions;
}

}  // namespace orthonav
