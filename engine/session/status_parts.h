#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace orthonav::engine {

/// Priority of a part of the status line when there is no room for all: the last is dropped first.
enum class Importance {
  kDanger,   ///< what must not be trusted now: a lost tool, a moved map
  kNext,     ///< what to do
  kMessage,  ///< what happened, and the first reason
  kHeard,    ///< the command as heard
  kMore,     ///< the other reasons
  kFigures,  ///< how good the registration is
  kCount     ///< how much there is
};

/// A part of a text, up to the beginning of the next part.
struct StatusPart {
  Importance importance = Importance::kMessage;
  std::size_t begin = 0;
  std::size_t separator = 0;  ///< bytes at the beginning that are dropped at the start of a row
};

/// The parts of a text, in order. Parts beyond `kMost` are merged into the last.
struct StatusParts {
  static constexpr std::size_t kMost = 24;
  std::array<StatusPart, kMost> parts{};
  std::size_t count = 0;

  void clear() { count = 0; }
  void add(const StatusPart& part) {
    if (count < kMost) {
      parts[count++] = part;
    }
  }
};

/// A text being written and, if wanted, where its parts begin.
struct PartedText {
  std::string& out;
  StatusParts* parts = nullptr;

  /// Begins a new part with what is appended next.
  void begin(Importance importance, std::string_view separator = "") {
    if (parts != nullptr) {
      parts->add({importance, out.size(), separator.size()});
    }
    out += separator;
  }
};

}  // namespace orthonav::engine
