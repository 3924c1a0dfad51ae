#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace orthonav::engine {

/// How long a part of the status line stays where there is no room for all of it: the last gives
/// way first.
enum class Importance {
  kDanger,   ///< what must not be trusted now: a tool lost, the map moved
  kNext,     ///< what to do
  kMessage,  ///< what happened, and the first reason
  kHeard,    ///< the command as it was heard
  kMore,     ///< the other reasons
  kFigures,  ///< how good the registration is
  kCount     ///< how much there is
};

/// A stretch of a text, from here to the next part.
struct StatusPart {
  Importance importance = Importance::kMessage;
  std::size_t begin = 0;
  std::size_t separator = 0;  ///< so many bytes come first that no row begins with
};

/// The parts of a text, in its order. Whatever comes beyond the last belongs to it.
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

/// A text as it is written, and where its parts begin for whoever asks.
struct PartedText {
  std::string& out;
  StatusParts* parts = nullptr;

  /// What is appended from here on is a part of its own.
  void begin(Importance importance, std::string_view separator = "") {
    if (parts != nullptr) {
      parts->add({importance, out.size(), separator.size()});
    }
    out += separator;
  }
};

}  // namespace orthonav::engine
