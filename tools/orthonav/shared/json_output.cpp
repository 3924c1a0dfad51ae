#include "tools/orthonav/shared/json_output.h"

#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "engine/io/atomic_file.h"

namespace orthonav::tools {

void JsonOutput::add_to(CLI::App& command) {
  option_ = command
                .add_option("--json", place_,
                            "Every figure as JSON into this file, or to standard output (-)")
                ->expected(0, 1)
                ->type_name("OUT");
}

bool JsonOutput::on_stdout() const { return given() && (place_.empty() || place_ == "-"); }

Status JsonOutput::check() const {
  if (!given() || on_stdout()) {
    return {};
  }
  return engine::check_place(place_);
}

Status JsonOutput::write(const nlohmann::ordered_json& content) const {
  return write_text(content.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

Status JsonOutput::write_text(const std::string& text) const {
  if (on_stdout()) {
    std::fputs(text.c_str(), stdout);
  } else if (given()) {
    return engine::write_file(place_, text);
  }
  return {};
}

Status JsonOutput::stream(const std::function<Status(std::ostream&)>& make) const {
  if (on_stdout()) {
    return make(std::cout);
  }
  if (!given()) {
    return {};
  }
  auto file = engine::AtomicFile::create(place_);
  if (!file) {
    return file.error();
  }
  std::ofstream out(file->temporary_path(), std::ios::binary);
  if (const Status made = make(out); !made) {
    return made;
  }
  out.close();
  return out ? file->commit() : Status(Error{place_ + ": cannot be written", ErrorCode::kIo});
}

}  // namespace orthonav::tools
