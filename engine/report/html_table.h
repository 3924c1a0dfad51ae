#pragma once

#include <string>
#include <vector>

namespace orthonav::engine {

/// The name of a column, and the unit of its figures; plain text.
struct TableColumn {
  std::string name;
  std::string unit = {};
  bool is_text = false;  ///< aligned left, unlike figures
};

/// A table of a page. Each cell carries the name of its column, so that a narrow screen can show
/// each row as a card (data/report.css) instead of a table wider than the screen.
class HtmlTable {
 public:
  explicit HtmlTable(std::vector<TableColumn> columns);
  /// Begins a row with its first cell. Contents are HTML, `kind` is a class of the style.
  void row(const std::string& name);
  void cell(const std::string& content, const char* kind = "");
  /// A line of its own below the row.
  void below(const std::string& content, const char* kind = "");
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  /// The whole element. The last row must be complete. `kind` is an additional class of it.
  [[nodiscard]] std::string html(const char* kind = "") const;

 private:
  std::vector<TableColumn> columns_;
  std::size_t next_ = 0;  ///< the column of the next cell
  std::string rows_;
};

}  // namespace orthonav::engine
