#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace orthonav {

// What the wearer of a headset reads can be in another language than English. The sources say all
// of it in English; a Translation has the other text for each, found by the English one. Whatever
// programs read, and what is said on the command line, stays English (docs/languages.md).

/// Marks an English text, or a format for base/printed.h, that a wearer may read:
/// tools/list_texts finds the texts by this word and by `translated`.
[[nodiscard]] constexpr const char* translatable(const char* english) { return english; }

/// Where a WearersLanguage lives on this thread, the text in the wearer's language; the English one
/// otherwise, and if there is no translation for it. Valid as long as the translation is in use.
/// Allocates nothing.
[[nodiscard]] const char* translated(const char* english);
[[nodiscard]] std::string_view translated(std::string_view english);

/// Whether `translated` looks texts up in another language here.
[[nodiscard]] bool writes_for_wearer();

/// Texts by the English ones.
class Translation {
 public:
  struct Entry {
    std::string english;
    std::string text;
  };

  Translation() = default;
  /// Each English text at most once.
  explicit Translation(std::vector<Entry> entries);
  /// Null if it has none.
  [[nodiscard]] const std::string* find(std::string_view english) const;
  /// Sorted by the English texts.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

/// The wearer's language of this process from now on; null: English. Like a locale it is set once,
/// before any thread is started; it never changes afterwards.
void use_translation(std::shared_ptr<const Translation> translation);

/// While one lives, this thread writes for a wearer. Everything else is written in English, so that
/// a log or a report can't be translated by accident.
class [[nodiscard]] WearersLanguage {
 public:
  WearersLanguage();
  ~WearersLanguage();
  WearersLanguage(const WearersLanguage&) = delete;
  WearersLanguage& operator=(const WearersLanguage&) = delete;

 private:
  bool before_;
};

/// While one lives, this thread writes English again.
class [[nodiscard]] InEnglish {
 public:
  InEnglish();
  ~InEnglish();
  InEnglish(const InEnglish&) = delete;
  InEnglish& operator=(const InEnglish&) = delete;

 private:
  bool before_;
};

/// One piece of a format: literal text, or a conversion.
struct FormatPiece {
  std::string_view text;
  bool conversion = false;
};
/// Takes the next piece off a format that is not empty. `%%` is the literal text "%".
[[nodiscard]] FormatPiece take_piece(std::string_view& format);

/// The conversions of a format in order, as "%.1f"; `%%` is none.
[[nodiscard]] std::vector<std::string_view> conversions_of(std::string_view format);

}  // namespace orthonav
