#include "engine/case/tool_file.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Tool definitions: what is read is written and read again to the same.
void fuzz_tools(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  const auto tools = engine::load_tools(file.path());
  if (!tools) {
    insist_one_line(tools.error());
    return;
  }
  const auto again = engine::parse_tools(engine::tools_text(*tools), "again");
  insist(again.ok() && again->size() == tools->size());
  for (std::size_t i = 0; i < tools->size(); ++i) {
    insist((*again)[i].tip_in_marker.v == (*tools)[i].tip_in_marker.v);
  }
}

}  // namespace orthonav::fuzz
