#include "engine/case/case_writer.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/case/plan_file.h"
#include "engine/io/json_document.h"
#include "engine/io/json_writer.h"
#include "engine/io/mesh_file.h"

namespace orthonav::engine {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string plan_name(const std::string& label) { return label + ".plan.json"; }

/// Labels become file names.
Status check_label(const std::string& label) {
  const bool plain = !label.empty() && std::all_of(label.begin(), label.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_';
  });
  return plain ? Status{}
               : Status{Error{"label '" + label +
                              "' can't be the name of a file: letters, digits, - and _ can"}};
}

std::string in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

/// Whether the value under the key is a text or absent.
bool may_be_text(const ordered_json& object, const char* key) {
  return !object.contains(key) || object[key].is_string();
}

bool is_case(const ordered_json& root) {
  return root.is_object() && may_be_text(root, "units") && root.contains("levels") &&
         root["levels"].is_array() &&
         std::all_of(root["levels"].begin(), root["levels"].end(), [](const ordered_json& level) {
           return level.is_object() && may_be_text(level, "label");
         });
}

/// The content of `case.json`, with the names of the plans that will be written.
Result<ordered_json> with_plan_names(const std::string& path, const Case& planned) {
  const auto text = read_text(path);
  if (!text) {
    return text.error();
  }
  ordered_json root = ordered_json::parse(*text, nullptr, false);
  if (!is_case(root)) {
    return Error{path + ": is not a case"};
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

Status save_plans(const std::string& folder, const Case& subject) {
  for (const CaseLevel& level : subject.levels) {
    if (level.screws.empty()) {
      continue;
    }
    if (Status s = save_plan(in(folder, plan_name(level.label)), level.label, level.screws); !s) {
      return s;
    }
  }
  return {};
}

}  // namespace

std::string model_name(const std::string& label) { return label + ".stl"; }

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
  std::error_code code;
  if (fs::exists(path, code)) {
    return Error{path + ": already exists"};
  }
  if (Status s = check_labels(subject); !s) {
    return s;
  }
  ordered_json root = {{"name", subject.name}, {"units", "mm"}, {"levels", ordered_json::array()}};
  if (!subject.unusual.empty()) {
    root["unusual"] = subject.unusual;
  }
  for (const CaseLevel& level : subject.levels) {
    ordered_json entry = {{"label", level.label}, {"model", model_name(level.label)}};
    if (!level.screws.empty()) {
      entry["plan"] = plan_name(level.label);
    }
    entry["spine_from_model"] = rows_mm(level.spine_from_vertebra.row_major());
    root["levels"].push_back(entry);
  }
  for (const CaseLevel& level : subject.levels) {
    if (Status s = save_stl(in(folder, model_name(level.label)), level.mesh); !s) {
      return s;
    }
  }
  if (Status s = save_plans(folder, subject); !s) {
    return s;
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
  std::error_code code;
  for (const CaseLevel& level : planned.levels) {
    const std::string plan = in(folder, plan_name(level.label));
    if (!level.screws.empty() && fs::exists(plan, code)) {
      return Error{plan + ": already exists"};
    }
  }
  if (Status s = save_plans(folder, planned); !s) {
    return s;
  }
  return write_json(path, *root);
}

}  // namespace orthonav::engine
