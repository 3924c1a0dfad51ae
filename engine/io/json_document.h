#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/vec.h"

namespace orthonav::engine {

/// The text of a file; refuses unreadable files, folders, and more than `max_bytes`.
Result<std::string> read_text(const std::string& path, std::size_t max_bytes = 64u << 20u);

/// A value inside a JSON document together with the path to it. Reading a value that is missing or
/// of the wrong type returns a plain default and notes the problem in the document; only the first
/// problem is kept. Readers therefore read everything, then check `JsonDocument::status` before
/// they use any of it. Must not outlive its document.
class JsonNode {
 public:
  [[nodiscard]] bool has(const char* key) const;
  /// The names in an object, sorted, so that unknown ones can be refused; empty if it is not an
  /// object.
  [[nodiscard]] std::vector<std::string> keys() const;
  [[nodiscard]] bool is_text(const char* key) const;
  [[nodiscard]] std::string text(const char* key) const;
  [[nodiscard]] std::string text_or(const char* key, const std::string& fallback) const;
  /// A finite number.
  [[nodiscard]] double number(const char* key) const;
  [[nodiscard]] int integer(const char* key) const;
  /// Any whole number from 0 on, to the last digit.
  [[nodiscard]] std::uint64_t unsigned_integer(const char* key) const;
  /// A list of texts.
  [[nodiscard]] std::vector<std::string> texts(const char* key) const;
  /// The same, or a single text.
  [[nodiscard]] std::vector<std::string> text_or_texts(const char* key) const;
  /// Exactly `count` finite numbers; nested lists (a matrix by rows) are flattened.
  [[nodiscard]] std::vector<double> numbers(const char* key, std::size_t count) const;
  /// At most `most` finite numbers.
  [[nodiscard]] std::vector<double> number_list(const char* key, std::size_t most) const;
  [[nodiscard]] Vec3 vec3(const char* key) const;
  /// A list of vectors, at most 1,000,000.
  [[nodiscard]] std::vector<Vec3> vec3s(const char* key) const;
  [[nodiscard]] bool flag_or(const char* key, bool fallback) const;
  [[nodiscard]] JsonNode child(const char* key) const;
  /// The objects of a list.
  [[nodiscard]] std::vector<JsonNode> list(const char* key) const;
  /// The text, or the first one of a list of texts.
  [[nodiscard]] std::string first_text(const char* key) const;

  /// Notes "FILE: WHERE.KEY PROBLEM".
  void refuse(const char* key, const std::string& problem) const;
  void refuse(const std::string& problem) const;

 private:
  friend class JsonDocument;
  struct Value;
  JsonNode(std::shared_ptr<const Value> value, std::string where)
      : value_(std::move(value)), where_(std::move(where)) {}
  [[nodiscard]] std::string way_to(const char* key) const;

  std::shared_ptr<const Value> value_;
  std::string where_;
};

/// A parsed JSON file and the first thing that was wrong with it.
class JsonDocument {
 public:
  static Result<JsonDocument> read(const std::string& path);
  /// `name` stands for the file in messages. Refuses text that is not a JSON object.
  static Result<JsonDocument> parse(std::string_view text, const std::string& name);
  [[nodiscard]] JsonNode root() const;
  [[nodiscard]] Status status() const;

 private:
  struct State;
  friend class JsonNode;
  explicit JsonDocument(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

}  // namespace orthonav::engine
