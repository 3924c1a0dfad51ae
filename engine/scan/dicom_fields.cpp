#include "engine/scan/dicom_fields.h"

#include <cctype>
#include <cstdlib>
#include <sstream>

namespace orthonav::engine {

std::vector<double> dicom_numbers(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, '\\');) {
    numbers.push_back(std::strtod(part.c_str(), nullptr));
  }
  return numbers;
}

std::string dicom_text(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::iscntrl(c) != 0; });
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

}  // namespace orthonav::engine
