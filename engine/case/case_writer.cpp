#include "engine/case/case_writer.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/case/plan_file.h"
#include "engine/io/atomic_file.h"
#include "engine/io/json_document.h"
#include "engine/io/mesh_file.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string plan_name(const std::string& label) { return label + ".plan.json"; }

/// Labels become names of files.
Status check_label(const std::string& label) {
  const bool plain = !label.empty() && std::all_of(label.begin(), label.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  return plain ? Status{}
               : Status{Error{"label '" + label +
                              "' can't be the name of a file: letters, digits, - and _ can"}};
}

ordered_json rows_mm(const Transform<Spine, Vertebra>& t) {
  ordered_json rows = ordered_json::array();
  const auto a = t.row_major();
  for (std::size_t i = 0; i < 4; ++i) {
    const double scale = i < 3 ? 1e3 : 1.0;
    rows.push_back({a[4 * i], a[4 * i + 1], a[4 * i + 2], a[4 * i + 3] * scale});
  }
  return rows;
}

Status write_json(const std::string& path, const ordered_json& root) {
  return write_file(path, root.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

std::string in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

/// What `case.json` says, with the names of the plans that are to come.
Result<ordered_json> with_plan_names(const std::string& path, const Case& planned) {
  const auto text = read_text(path);
  if (!text) {
    return text.error();
  }
  ordered_json root = ordered_json::parse(*text, nullptr, false);
  if (!root.is_object() || !root.contains("levels") || !root["levels"].is_array()) {
    return Error{path + ": is no case"};
  }
  if (root.value("units", "mm") != "mm") {
    return Error{path + ": units must be mm where plans are added to it"};
  }
  for (ordered_json& level : root["levels"]) {
    const CaseLevel* known = planned.find(level.value("label", ""));
    if (known == nullptr || known->screws.empty()) {
      continue;
    }
    if (level.contains("plan")) {
      return Error{path + ": " + known->label + " has a plan already"};
    }
    level["plan"] = plan_name(known->label);
  }
  return root;
}

}  // namespace

Status check_labels(const Case& subject) {
  for (const CaseLevel& level : subject.levels) {
    if (Status s = check_label(level.label); !s) {
      return s;
    }
  }
  return {};
}

Status save_case(const std::string& folder, const Case& subject) {
  const std::string path = in(folder, "case.json");
  if (fs::exists(path)) {
    return Error{path + ": is there already"};
  }
  if (Status s = check_labels(subject); !s) {
    return s;
  }
  ordered_json root = {{"name", subject.name}, {"units", "mm"}, {"levels", ordered_json::array()}};
  for (const CaseLevel& level : subject.levels) {
    ordered_json entry = {{"label", level.label}, {"model", level.label + ".stl"}};
    if (!level.screws.empty()) {
      entry["plan"] = plan_name(level.label);
    }
    entry["spine_from_model"] = rows_mm(level.spine_from_vertebra);
    root["levels"].push_back(entry);
  }
  for (const CaseLevel& level : subject.levels) {
    if (Status s = save_stl(in(folder, level.label + ".stl"), level.mesh); !s) {
      return s;
    }
    if (level.screws.empty()) {
      continue;
    }
    if (Status s = save_plan(in(folder, plan_name(level.label)), level.label, level.screws); !s) {
      return s;
    }
  }
  return write_json(path, root);
}

Status add_plans(const std::string& folder, const Case& planned) {
  const std::string path = in(folder, "case.json");
  const auto root = with_plan_names(path, planned);
  if (!root) {
    return root.error();
  }
  if (Status s = check_labels(planned); !s) {
    return s;
  }
  for (const CaseLevel& level : planned.levels) {
    if (fs::exists(in(folder, plan_name(level.label))) && !level.screws.empty()) {
      return Error{in(folder, plan_name(level.label)) + ": is there already"};
    }
  }
  for (const CaseLevel& level : planned.levels) {
    if (level.screws.empty()) {
      continue;
    }
    if (Status s = save_plan(in(folder, plan_name(level.label)), level.label, level.screws); !s) {
      return s;
    }
  }
  return write_json(path, *root);
}

}  // namespace orthonav::engine
