#include <optional>

// Compiled as the product is: this must end the program, not read what is not there.
int main(int count, char** /*words*/) {
  const std::optional<int> number = count > 100 ? std::optional(count) : std::nullopt;
  return *number == 7 ? 1 : 0;
}
