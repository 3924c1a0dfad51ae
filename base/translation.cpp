#include "base/translation.h"

#include <algorithm>
#include <cstddef>
#include <utility>

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

bool writes_for_wearer() { return wanted() != nullptr; }

WearersLanguage::WearersLanguage() : before_(std::exchange(for_wearer, true)) {}
WearersLanguage::~WearersLanguage() { for_wearer = before_; }

InEnglish::InEnglish() : before_(std::exchange(for_wearer, false)) {}
InEnglish::~InEnglish() { for_wearer = before_; }

FormatPiece take_piece(std::string_view& format) {
  if (format[0] != '%') {
    const std::size_t end = std::min(format.find('%'), format.size());
    const FormatPiece piece{format.substr(0, end), false};
    format.remove_prefix(end);
    return piece;
  }
  const std::size_t length = conversion_length(format);
  const bool percent = length == 2 && format[1] == '%';
  const FormatPiece piece{format.substr(0, percent ? 1 : length), !percent};
  format.remove_prefix(length);
  return piece;
}

std::vector<std::string_view> conversions_of(std::string_view format) {
  std::vector<std::string_view> conversions;
  while (!format.empty()) {
    const FormatPiece piece = take_piece(format);
    if (piece.conversion) {
      conversions.push_back(piece.text);
    }
  }
  return conversions;
}

}  // namespace orthonav
