#pragma once

#include <array>
#include <memory>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::engine {

/// A text as curves: x right, y down, the baseline's start at (0, 0), the font's height 1.
struct TextOutline {
  enum class Kind { kMove, kLine, kCubic };
  struct Step {
    Kind kind = Kind::kMove;
    std::array<Vec2, 3> to{};  ///< a cubic's two controls and its end; otherwise the end is first
  };
  std::vector<Step> steps;  ///< closed curves, one after the other, to be filled non-zero
  double advance = 0.0;     ///< where the next letter would begin
};

/// The embedded font (DejaVu Sans), so that a print does not depend on the machine's.
class PrintFont {
 public:
  static Result<PrintFont> open();
  PrintFont(PrintFont&&) noexcept;
  PrintFont& operator=(PrintFont&&) noexcept;
  ~PrintFont();
  /// From UTF-8; invalid bytes, and letters that the font lacks, are drawn as its box.
  [[nodiscard]] TextOutline outline(std::string_view text) const;

 private:
  struct Library;
  explicit PrintFont(std::unique_ptr<Library> library);
  std::unique_ptr<Library> library_;
};

}  // namespace orthonav::engine
