#include "engine/print/tag_sheets.h"

#include <algorithm>

namespace orthonav::engine {
namespace {

constexpr double kSmallestMm = 5.0;
constexpr double kLargestMm = 200.0;
constexpr double kMostQuietCells = 4.0;
constexpr std::size_t kMostTags = 1000;
constexpr double kCaptionMm = 2.4;
constexpr double kLineMm = 3.2;
// Room for the text under a small tag.
constexpr double kLeastWidthMm = 34.0;
constexpr double kApartMm = 4.0;

/// A tag and the paper it takes.
struct Patch {
  TagCells cells;
  double size_mm = 0.0;
  double around_mm = 0.0;  ///< from the tag's outer edge to the cut
  std::vector<std::string> lines;

  [[nodiscard]] double cut_mm() const { return size_mm + 2 * around_mm; }
  [[nodiscard]] double width_mm() const { return std::max(cut_mm(), kLeastWidthMm); }
  [[nodiscard]] double height_mm() const {
    return cut_mm() + kLineMm * static_cast<double>(lines.size()) + 1.0;
  }
};

std::string title_of(const PrintedTag& tag) {
  return "tag " + tag.marker.family + " id " + std::to_string(tag.marker.id);
}

Result<Patch> patch_of(const PrintedTag& tag, const TagSheetOptions& options) {
  auto cells = tag_cells(tag.marker.family, tag.marker.id);
  if (!cells) {
    return cells.error();
  }
  Patch patch;
  patch.size_mm = tag.marker.size_m * 1e3;
  if (!(patch.size_mm >= kSmallestMm && patch.size_mm <= kLargestMm)) {
    return Error{title_of(tag) + ": size " + mm_text(patch.size_mm) + " mm, must be 5-200 mm"};
  }
  const double cell_mm = patch.size_mm / cells->border_cells;
  const double quiet_mm = options.quiet_cells * cell_mm;
  patch.around_mm = cells->overhang_cells() * cell_mm + quiet_mm;
  patch.cells = std::move(*cells);
  if (!tag.name.empty()) {
    patch.lines.push_back(tag.name);
  }
  patch.lines.push_back(tag.marker.family + "  id " + std::to_string(tag.marker.id));
  patch.lines.push_back("size " + mm_text(patch.size_mm) + " mm, quiet zone " + mm_text(quiet_mm) +
                        " mm");
  const SheetRect content = content_of(options.page);
  const double limit_mm =
      std::min(content.width_mm, content.height_mm - (patch.height_mm() - patch.cut_mm()));
  if (patch.width_mm() > content.width_mm || patch.height_mm() > content.height_mm) {
    return Error{title_of(tag) + " of " + mm_text(patch.size_mm) + " mm takes " +
                 mm_text(patch.cut_mm()) + " mm with its quiet zone, page " + options.page.name +
                 " has room for " + mm_text(limit_mm) + " mm"};
  }
  return patch;
}

void add_patch(Sheet& sheet, const Patch& patch, double x_mm, double y_mm) {
  const double cut_x_mm = x_mm + (patch.width_mm() - patch.cut_mm()) / 2;
  sheet.cuts.push_back({{cut_x_mm, y_mm, patch.cut_mm(), patch.cut_mm()}});
  add_tag(sheet, patch.cells, cut_x_mm + patch.around_mm, y_mm + patch.around_mm, patch.size_mm);
  double baseline_mm = y_mm + patch.cut_mm() + kLineMm;
  for (const std::string& line : patch.lines) {
    sheet.texts.push_back(
        {x_mm + patch.width_mm() / 2, baseline_mm, kCaptionMm, line, SheetAlign::kCentre});
    baseline_mm += kLineMm;
  }
}

/// Fills rows from the left and pages from the top.
class Layout {
 public:
  Layout(const Page& page, TagSheets& out) : page_(page), content_(content_of(page)), out_(out) {}

  void place(const Patch& patch) {
    if (!out_.sheets.empty() && x_mm_ + patch.width_mm() > content_.width_mm) {
      x_mm_ = 0.0;
      y_mm_ += row_mm_ + kApartMm;
      row_mm_ = 0.0;
    }
    if (out_.sheets.empty() || y_mm_ + patch.height_mm() > content_.height_mm) {
      out_.sheets.push_back(blank_sheet(page_));
      x_mm_ = y_mm_ = row_mm_ = 0.0;
    }
    const double left_mm = content_.x_mm + x_mm_;
    const double top_mm = content_.y_mm + y_mm_;
    add_patch(out_.sheets.back(), patch, left_mm, top_mm);
    out_.placed.push_back({out_.sheets.size() - 1, left_mm + patch.width_mm() / 2,
                           top_mm + patch.cut_mm() / 2, patch.size_mm});
    x_mm_ += patch.width_mm() + kApartMm;
    row_mm_ = std::max(row_mm_, patch.height_mm());
  }

 private:
  const Page& page_;
  SheetRect content_;
  TagSheets& out_;
  double x_mm_ = 0.0;
  double y_mm_ = 0.0;
  double row_mm_ = 0.0;
};

}  // namespace

Result<TagSheets> tag_sheets(const std::vector<PrintedTag>& tags, const TagSheetOptions& options) {
  if (tags.empty()) {
    return Error{"no tags to print"};
  }
  if (tags.size() > kMostTags) {
    return Error{std::to_string(tags.size()) + " tags to print, limit 1000"};
  }
  if (!(options.quiet_cells >= 1.0 && options.quiet_cells <= kMostQuietCells)) {
    return Error{"quiet zone of " + mm_text(options.quiet_cells) + " cells, must be 1-4"};
  }
  TagSheets out;
  Layout layout(options.page, out);
  for (const PrintedTag& tag : tags) {
    const auto patch = patch_of(tag, options);
    if (!patch) {
      return patch.error();
    }
    layout.place(*patch);
  }
  const std::string pages = std::to_string(out.sheets.size());
  for (std::size_t i = 0; i < out.sheets.size(); ++i) {
    add_heading(out.sheets[i], "orthonav tags, cut along the dashed lines, page " +
                                   std::to_string(i + 1) + " of " + pages);
  }
  return out;
}

}  // namespace orthonav::engine
