#include "base/reason.h"

#include <utility>

#include "base/printed.h"
#include "base/translation.h"

namespace orthonav {
namespace {

struct ValueWriter {
  std::string& out;
  std::string_view conversion;

  void number(PrintedValue value) const {
    std::string format(conversion);  // shorter than what a string allocates for
    append_printed(out, format.c_str(), std::span<const PrintedValue>(&value, 1));
  }
  void operator()(std::size_t value) const { number(value); }
  void operator()(double value) const { number(value); }
  void operator()(const NearLimit& near) const {
    const std::size_t begin = out.size();
    append_beside_limit(out, near.both, near.value, near.limit);
    out.resize(out.find(';', begin));
  }
  void operator()(const std::string& text) const { out += text; }
  void operator()(const char* text) const { out += translated(text); }
};

void append(std::string& out, const Reason& reason) {
  const char* const format = translated(reason.format);
  if (reason.beside_limit) {
    return append_beside_limit(out, format, std::get<double>(reason.values[0]),
                               std::get<double>(reason.values[1]));
  }
  std::size_t next = 0;
  for (std::string_view rest = format; !rest.empty();) {
    const FormatPiece piece = take_piece(rest);
    if (!piece.conversion) {
      out += piece.text;
    } else if (next < reason.values.size()) {
      std::visit(ValueWriter{out, piece.text}, reason.values[next++]);
    }
  }
}

}  // namespace

Error refused(Reason reason) {
  Error error;
  {
    const InEnglish language;
    append(error.message, reason);
  }
  error.reason = std::make_shared<const Reason>(std::move(reason));
  return error;
}

void append_error(std::string& out, const Error& error) {
  if (error.reason) {
    append(out, *error.reason);
  } else if (writes_for_wearer()) {
    out.append("\"").append(error.message).append("\"");
  } else {
    out += error.message;
  }
}

}  // namespace orthonav
