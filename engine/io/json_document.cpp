#include "engine/io/json_document.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/one_line.h"

namespace orthonav::engine {

using nlohmann::json;

struct JsonDocument::State {
  std::string name;
  json content;
  std::optional<Error> problem;
};

struct JsonNode::Value {
  JsonDocument::State* document;
  const json* content;

  [[nodiscard]] const json* find(const char* key) const {
    if (!content->is_object()) {
      return nullptr;
    }
    const auto found = content->find(key);
    return found == content->end() || found->is_null() ? nullptr : &*found;
  }
};

Result<JsonDocument> JsonDocument::read(const std::string& path) {
  const Result<std::string> text = read_text(path);
  if (!text) {
    return text.error();
  }
  return parse(*text, path);
}

Result<JsonDocument> JsonDocument::parse(std::string_view text, const std::string& name) {
  auto state = std::make_shared<State>();
  state->name = name;
  try {
    state->content = json::parse(text);
  } catch (const json::parse_error& error) {
    return Error{name + ": is not JSON (byte " + std::to_string(error.byte) + " of " +
                 std::to_string(text.size()) + ")"};
  } catch (const json::exception&) {
    return Error{name + ": holds a number that is too large"};
  }
  if (!state->content.is_object()) {
    return Error{name + ": must hold a JSON object"};
  }
  return JsonDocument(std::move(state));
}

JsonNode JsonDocument::root() const {
  return {std::make_shared<JsonNode::Value>(JsonNode::Value{state_.get(), &state_->content}), ""};
}

Status JsonDocument::status() const {
  return state_->problem ? Status(*state_->problem) : Status();
}

std::string JsonNode::way_to(const char* key) const {
  return where_.empty() ? key : where_ + "." + key;
}

void JsonNode::refuse(const std::string& problem) const {
  JsonDocument::State& document = *value_->document;
  if (document.problem) {
    return;
  }
  document.problem =
      Error{document.name + ": " + one_line(where_ + (where_.empty() ? "" : " ") + problem)};
}

void JsonNode::refuse(const char* key, const std::string& problem) const {
  JsonNode(value_, way_to(key)).refuse(problem);
}

bool JsonNode::has(const char* key) const { return value_->find(key) != nullptr; }

std::vector<std::string> JsonNode::keys() const {
  std::vector<std::string> names;
  if (value_->content->is_object()) {
    for (const auto& [name, ignored] : value_->content->items()) {
      names.push_back(name);
    }
  }
  return names;
}

bool JsonNode::is_text(const char* key) const {
  const json* found = value_->find(key);
  return found != nullptr && found->is_string();
}

std::string JsonNode::text(const char* key) const {
  const json* found = value_->find(key);
  if (found == nullptr) {
    return refuse(key, "is missing"), std::string();
  }
  if (!found->is_string()) {
    return refuse(key, std::string("must be text, is ") + found->type_name()), std::string();
  }
  return found->get<std::string>();
}

std::string JsonNode::text_or(const char* key, const std::string& fallback) const {
  return has(key) ? text(key) : fallback;
}

double JsonNode::number(const char* key) const {
  const json* found = value_->find(key);
  if (found == nullptr) {
    return refuse(key, "is missing"), 0.0;
  }
  if (!found->is_number()) {
    return refuse(key, std::string("must be a number, is ") + found->type_name()), 0.0;
  }
  const double value = found->get<double>();
  if (!std::isfinite(value)) {
    return refuse(key, "is not finite"), 0.0;
  }
  return value;
}

int JsonNode::integer(const char* key) const {
  const double value = number(key);
  if (value != std::floor(value) || std::abs(value) > 1e9) {
    return refuse(key, "must be a whole number"), 0;
  }
  return static_cast<int>(value);
}

std::uint64_t JsonNode::unsigned_integer(const char* key) const {
  const json* found = value_->find(key);
  if (found == nullptr) {
    return refuse(key, "is missing"), 0;
  }
  if (!found->is_number_unsigned()) {
    return refuse(key, "must be a whole number from 0 on"), 0;
  }
  return found->get<std::uint64_t>();
}

std::vector<std::string> JsonNode::texts(const char* key) const {
  std::vector<std::string> out;
  const json* found = value_->find(key);
  if (found == nullptr) {
    return refuse(key, "is missing"), out;
  }
  if (!found->is_array()) {
    return refuse(key, std::string("must be a list, is ") + found->type_name()), out;
  }
  for (const json& element : *found) {
    if (!element.is_string()) {
      return refuse(key, "must be a list of texts"), out;
    }
    out.push_back(element.get<std::string>());
  }
  return out;
}

namespace {

/// False if any element is not a finite number.
bool flatten(const json& value, int depth, std::vector<double>& out) {
  if (value.is_number()) {
    out.push_back(value.get<double>());
    return std::isfinite(out.back());
  }
  if (!value.is_array() || depth == 0) {
    return false;
  }
  for (const json& element : value) {
    if (!flatten(element, depth - 1, out)) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<double> JsonNode::numbers(const char* key, std::size_t count) const {
  std::vector<double> out;
  const json* found = value_->find(key);
  if (found == nullptr) {
    refuse(key, "is missing");
  } else if (!found->is_array() || !flatten(*found, 2, out)) {
    refuse(key, "must be a list of " + std::to_string(count) + " finite numbers");
  } else if (out.size() != count) {
    refuse(key,
           "holds " + std::to_string(out.size()) + " numbers, must be " + std::to_string(count));
  }
  out.resize(count, 0.0);
  return out;
}

std::vector<double> JsonNode::number_list(const char* key, std::size_t most) const {
  std::vector<double> out;
  const json* found = value_->find(key);
  if (found == nullptr) {
    refuse(key, "is missing");
  } else if (!found->is_array() || found->size() > most || !flatten(*found, 1, out)) {
    refuse(key, "must be a list of at most " + std::to_string(most) + " finite numbers");
    out.clear();
  }
  return out;
}

Vec3 JsonNode::vec3(const char* key) const {
  const std::vector<double> values = numbers(key, 3);
  return {values[0], values[1], values[2]};
}

std::vector<Vec3> JsonNode::vec3s(const char* key) const {
  constexpr std::size_t kMost = 1'000'000;
  std::vector<Vec3> out;
  const json* found = value_->find(key);
  if (found == nullptr) {
    refuse(key, "is missing");
    return out;
  }
  if (!found->is_array() || found->size() > kMost) {
    refuse(key, "must be a list of at most 1000000 points");
    return out;
  }
  for (const json& element : *found) {
    std::vector<double> values;
    if (!element.is_array() || !flatten(element, 1, values) || values.size() != 3) {
      refuse(key, "point " + std::to_string(out.size() + 1) + " must be 3 finite numbers");
      return out;
    }
    out.push_back({values[0], values[1], values[2]});
  }
  return out;
}

bool JsonNode::flag_or(const char* key, bool fallback) const {
  const json* found = value_->find(key);
  if (found == nullptr) {
    return fallback;
  }
  if (!found->is_boolean()) {
    refuse(key, "must be true or false");
  }
  return found->is_boolean() ? found->get<bool>() : fallback;
}

JsonNode JsonNode::child(const char* key) const {
  static const json kNothing;
  const json* found = value_->find(key);
  if (found == nullptr) {
    refuse(key, "is missing");
  } else if (!found->is_object()) {
    refuse(key, std::string("must be an object, is ") + found->type_name());
  }
  const Value value{value_->document, found == nullptr ? &kNothing : found};
  return {std::make_shared<Value>(value), way_to(key)};
}

std::vector<JsonNode> JsonNode::list(const char* key) const {
  std::vector<JsonNode> nodes;
  const json* found = value_->find(key);
  if (found == nullptr) {
    return refuse(key, "is missing"), nodes;
  }
  if (!found->is_array()) {
    return refuse(key, std::string("must be a list, is ") + found->type_name()), nodes;
  }
  for (const json& element : *found) {
    const std::string where = way_to(key) + "[" + std::to_string(nodes.size()) + "]";
    nodes.push_back({std::make_shared<Value>(Value{value_->document, &element}), where});
    if (!element.is_object()) {
      nodes.back().refuse("must be an object");
    }
  }
  return nodes;
}

std::vector<std::string> JsonNode::text_or_texts(const char* key) const {
  const json* found = value_->find(key);
  return found != nullptr && found->is_string() ? std::vector{found->get<std::string>()}
                                                : texts(key);
}

std::string JsonNode::first_text(const char* key) const {
  const json* found = value_->find(key);
  if (found != nullptr && found->is_array() && !found->empty() && found->front().is_string()) {
    return found->front().get<std::string>();
  }
  return text(key);
}

}  // namespace orthonav::engine
