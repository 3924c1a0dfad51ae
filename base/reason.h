#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "base/result.h"

namespace orthonav {

/// A value printed with enough digits to tell it from its limit, which stands elsewhere in the
/// text.
struct NearLimit {
  double value = 0.0;
  double limit = 0.0;
  const char* both = "%.1f;%.1f";  ///< how value and limit are printed; what precedes ';' is kept
};

/// Why something was refused, as data: which refusal it is, by its format that is marked
/// `translatable` (base/translation.h), and its values. Text is made from it at the very end, in
/// the language of whoever reads it.
struct Reason {
  /// A text of type `const char*` is marked `translatable` itself; a string stays as it is.
  using Value = std::variant<std::size_t, double, NearLimit, std::string, const char*>;

  const char* format = "";
  std::vector<Value> values;  ///< one for each conversion of the format; `%s` takes any
  bool beside_limit = false;  ///< they are a number and its limit (base/printed.h)
};

/// An error with its reason, and the English message made from it.
[[nodiscard]] Error refused(Reason reason);

/// Appends what an error says, in the language of `translated`. An error without a reason is put in
/// quotation marks there, so that nobody takes its English for a translation.
void append_error(std::string& out, const Error& error);

}  // namespace orthonav
