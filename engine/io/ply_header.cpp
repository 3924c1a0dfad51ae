#include "engine/io/ply_header.h"

#include <cmath>
#include <map>

#include "engine/io/text_fields.h"

namespace orthonav::engine::ply {
namespace {

constexpr double kMaxRows = 1e8;

std::optional<Type> type_named(const std::string& name) {
  static const std::map<std::string, Type> kTypes = {
      {"char", {1, Kind::kSigned}},     {"int8", {1, Kind::kSigned}},
      {"uchar", {1, Kind::kUnsigned}},  {"uint8", {1, Kind::kUnsigned}},
      {"short", {2, Kind::kSigned}},    {"int16", {2, Kind::kSigned}},
      {"ushort", {2, Kind::kUnsigned}}, {"uint16", {2, Kind::kUnsigned}},
      {"int", {4, Kind::kSigned}},      {"int32", {4, Kind::kSigned}},
      {"uint", {4, Kind::kUnsigned}},   {"uint32", {4, Kind::kUnsigned}},
      {"float", {4, Kind::kReal}},      {"float32", {4, Kind::kReal}},
      {"double", {8, Kind::kReal}},     {"float64", {8, Kind::kReal}}};
  const auto found = kTypes.find(name);
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

Result<Encoding> encoding_from(const std::vector<std::string>& words) {
  const std::string format = words.size() > 1 ? words[1] : "";
  if (format == "ascii") {
    return Encoding::kAscii;
  }
  if (format == "binary_little_endian") {
    return Encoding::kLittle;
  }
  if (format == "binary_big_endian") {
    return Encoding::kBig;
  }
  return Error{"unknown format \"" + format + "\""};
}

Status read_element(const std::vector<std::string>& words, Header& header) {
  if (words.size() != 3) {
    return Error{"an element line is not \"element NAME COUNT\""};
  }
  const auto count = number_from(words[2]);
  if (!count || *count < 0 || *count > kMaxRows || *count != std::floor(*count)) {
    return Error{"element count " + words[2] + " must be 0 to 100000000"};
  }
  header.elements.push_back({words[1], static_cast<std::size_t>(*count), {}});
  return {};
}

Status read_property(const std::vector<std::string>& words, Header& header) {
  if (header.elements.empty()) {
    return Error{"a property stands before the first element"};
  }
  Element& element = header.elements.back();
  const bool is_list = words.size() == 5 && words[1] == "list";
  const auto type = is_list             ? type_named(words[3])
                    : words.size() == 3 ? type_named(words[1])
                                        : std::nullopt;
  const auto count = is_list ? type_named(words[2]) : std::nullopt;
  if (!type || (is_list && !count)) {
    return Error{"a " + element.name + " property has an unknown type"};
  }
  element.properties.push_back({words.back(), *type, count});
  return {};
}

}  // namespace

Result<Header> read_header(const std::string& text) {
  if (!text.starts_with("ply")) {
    return Error{"does not start with \"ply\""};
  }
  Header header;
  Result<Encoding> encoding = Error{"has no format line"};
  for (;;) {
    const std::size_t end = text.find('\n', header.end);
    if (end == std::string::npos) {
      return Error{"has no end_header"};
    }
    std::vector<std::string> words = split(text.substr(header.end, end - header.end), ' ');
    std::erase(words, "");
    header.end = end + 1;
    const std::string first = words.empty() ? "" : words[0];
    if (first == "end_header") {
      break;
    }
    if (first == "format") {
      encoding = encoding_from(words);
    }
    const Status taken = first == "element"    ? read_element(words, header)
                         : first == "property" ? read_property(words, header)
                                               : Status{};
    if (!taken) {
      return taken.error();
    }
  }
  if (!encoding) {
    return encoding.error();
  }
  header.encoding = *encoding;
  return header;
}

}  // namespace orthonav::engine::ply
