#include "engine/report/html_table.h"

#include <utility>

#include "base/check.h"
#include "engine/report/html_text.h"

namespace orthonav::engine {
namespace {

std::string class_of(const std::string& kind) { return kind.empty() ? "" : " class=" + kind; }

std::string class_of(const std::string& kind, const TableColumn& column) {
  if (!column.is_text) {
    return class_of(kind);
  }
  return class_of(kind.empty() ? "text" : "\"text " + kind + "\"");
}

std::string title_of(const TableColumn& column) {
  return html_escaped(column.name) +
         (column.unit.empty() ? "" : " <small>" + html_escaped(column.unit) + "</small>");
}

std::string label_of(const TableColumn& column) {
  return html_escaped(column.name + (column.unit.empty() ? "" : " [" + column.unit + "]"));
}

}  // namespace

HtmlTable::HtmlTable(std::vector<TableColumn> columns)
    : columns_(std::move(columns)), next_(columns_.size()) {}

void HtmlTable::row(const std::string& name) {
  ORTHONAV_CHECK(next_ == columns_.size());
  rows_ += std::string(rows_.empty() ? "" : "</tr>") + "<tr><th scope=row>" + name + "</th>";
  next_ = 1;
}

void HtmlTable::cell(const std::string& content, const char* kind) {
  ORTHONAV_CHECK(next_ < columns_.size());
  rows_ += "<td" + class_of(kind, columns_[next_]) + " data-label=\"" + label_of(columns_[next_]) +
           "\">" + content + "</td>";
  ++next_;
}

void HtmlTable::below(const std::string& content, const char* kind) {
  ORTHONAV_CHECK(next_ == columns_.size() && !rows_.empty());
  rows_ += "</tr><tr class=below><td colspan=" + std::to_string(columns_.size()) + class_of(kind) +
           ">" + content + "</td>";
}

std::string HtmlTable::html(const char* kind) const {
  ORTHONAV_CHECK(next_ == columns_.size());
  std::string out =
      "<table class=\"cards" + std::string(*kind == '\0' ? "" : " ") + kind + "\"><thead><tr>";
  for (const TableColumn& column : columns_) {
    out += "<th scope=col" + class_of("", column) + ">" + title_of(column) + "</th>";
  }
  return out + "</tr></thead><tbody>" + rows_ + (rows_.empty() ? "" : "</tr>") + "</tbody></table>";
}

}  // namespace orthonav::engine
