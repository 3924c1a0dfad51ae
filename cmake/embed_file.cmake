# Writes OUT/NAME.cpp holding the bytes of FILE.
file(READ "${FILE}" hex HEX)
string(REGEX REPLACE "(................................)" "\\1\n" hex "${hex}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
file(WRITE "${OUT}/${NAME}.cpp" "#include \"embedded/${NAME}.h\"

namespace orthonav::embedded {
// As long as the file.
std::string_view ${NAME}() {  // NOLINT(readability-function-size)
  static constexpr unsigned char kBytes[] = {
${bytes}0x00};
  return {reinterpret_cast<const char*>(kBytes), sizeof(kBytes) - 1};
}
}
")
