#include "engine/io/tfm_file.h"

#include <array>
#include <charconv>
#include <optional>

#include "base/one_line.h"
#include "engine/io/json_document.h"
#include "engine/io/text_fields.h"

namespace orthonav::engine {
namespace {

constexpr std::string_view kHeader = "#Insight Transform File V1.0";
constexpr std::string_view kHdf5Signature = "\x89HDF\r\n\x1a\n";

void append_numbers(std::string& text, const std::vector<double>& numbers) {
  for (const double number : numbers) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    text += ' ';
    text.append(digits.data(), end);
  }
  text += '\n';
}

std::string shown(std::string_view text) {
  constexpr std::size_t kShown = 40;
  return "\"" + one_line(std::string(text.substr(0, kShown))) + "\"";
}

Result<std::vector<double>> numbers_in(std::string_view text) {
  constexpr std::string_view kBlank = " \t";
  std::vector<double> numbers;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::string_view word = text.substr(0, text.find_first_of(kBlank));
    const auto number = number_from(word);
    if (!number) {
      return Error{shown(word) + " is not a finite number"};
    }
    numbers.push_back(*number);
    text.remove_prefix(word.size());
  }
  return numbers;
}

/// What the lines have said so far.
class Lines {
 public:
  Status take(std::string_view line) {
    const std::size_t colon = line.find(':');
    const std::string_view key = trimmed(line.substr(0, colon));
    if (colon == std::string_view::npos) {
      return Error{shown(line) + " must be \"NAME: VALUE\""};
    }
    const std::string_view value = line.substr(colon + 1);
    if (key == "Transform") {
      return take_kind(trimmed(value));
    }
    if (key == "Parameters") {
      return take_numbers(value, "Parameters", parameters_);
    }
    if (key == "FixedParameters") {
      return take_numbers(value, "FixedParameters", fixed_);
    }
    return Error{shown(key) + " is unknown, must be Transform, Parameters or FixedParameters"};
  }
  [[nodiscard]] Result<StoredTransform> whole() const {
    if (!kind_) {
      return Error{"holds no transform"};
    }
    if (!parameters_ || !fixed_) {
      return Error{std::string("has no ") + (parameters_ ? "FixedParameters" : "Parameters")};
    }
    return StoredTransform{*kind_, *parameters_, *fixed_};
  }

 private:
  Status take_kind(std::string_view value) {
    if (kind_) {
      return Error{"a second transform begins, must hold one"};
    }
    kind_ = std::string(value);
    return {};
  }
  static Status take_numbers(std::string_view value, const char* key,
                             std::optional<std::vector<double>>& numbers) {
    if (numbers) {
      return Error{std::string(key) + " stands twice"};
    }
    auto found = numbers_in(value);
    if (!found) {
      return Error{std::string(key) + ": " + found.error().message};
    }
    numbers = std::move(*found);
    return {};
  }

  std::optional<std::string> kind_;
  std::optional<std::vector<double>> parameters_;
  std::optional<std::vector<double>> fixed_;
};

}  // namespace

std::string tfm_text(const StoredTransform& transform) {
  std::string text(kHeader);
  text += "\n#Transform 0\nTransform: " + transform.kind + "\nParameters:";
  append_numbers(text, transform.parameters);
  text += "FixedParameters:";
  append_numbers(text, transform.fixed_parameters);
  return text;
}

Result<StoredTransform> transform_from_tfm(std::string_view text, const std::string& name) {
  if (!text.starts_with(kHeader)) {
    return Error{name + ": is not a transform file: must begin with \"" + std::string(kHeader) +
                 "\""};
  }
  // Digits could be missing at the end of a line that does not end.
  if (text.back() != '\n') {
    return Error{name + ": is cut off: its last line does not end"};
  }
  Lines lines;
  int number = 0;
  for (const std::string& line : lines_of(text)) {
    ++number;
    if (line.empty() || line.starts_with('#')) {
      continue;
    }
    if (Status s = lines.take(line); !s) {
      return Error{name + ": line " + std::to_string(number) + ": " + s.error().message};
    }
  }
  auto whole = lines.whole();
  return whole ? whole : Error{name + ": " + whole.error().message};
}

Result<StoredTransform> load_tfm(const std::string& path) {
  const auto text = read_text(path, kLongestTransformFile);
  if (!text) {
    return text.error();
  }
  if (is_hdf5(*text)) {
    return Error{path + ": is HDF5, which is not read here: save it as .tfm"};
  }
  return transform_from_tfm(*text, path);
}

bool is_hdf5(std::string_view bytes) { return bytes.starts_with(kHdf5Signature); }

}  // namespace orthonav::engine
