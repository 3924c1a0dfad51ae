#pragma once

#include <cstdio>

#include "engine/case/model_cache.h"

namespace orthonav::tools {

/// Reports on standard error the files of prepared models that could not be used or written.
inline void print_notes(const engine::ModelCache& models) {
  for (const std::string& note : models.notes()) {
    std::fprintf(stderr, "orthonav: %s\n", note.c_str());
  }
}

}  // namespace orthonav::tools
