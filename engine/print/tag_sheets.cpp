#include "engine/print/tag_sheets.h"

#include <algorithm>

#include "engine/print/tag_patch.h"

namespace orthonav::engine {
namespace {

constexpr double kMaxQuietCells = 4.0;
constexpr std::size_t kMaxTags = 1000;
constexpr double kApartMm = 4.0;

Status fits(const PrintedTag& tag, const TagPatch& patch, const Page& page) {
  const SheetRect content = content_of(page);
  if (patch.width_mm() <= content.width_mm && patch.height_mm() <= content.height_mm) {
    return {};
  }
  const double limit_mm =
      std::min(content.width_mm, content.height_mm - (patch.height_mm() - patch.quiet_mm()));
  return Error{"tag " + tag.marker.family + " id " + std::to_string(tag.marker.id) + " of " +
               mm_text(patch.size_mm) + " mm takes " + mm_text(patch.quiet_mm()) +
               " mm with its quiet zone, page " + page.name + " has room for " + mm_text(limit_mm) +
               " mm"};
}

/// Fills rows from the left and pages from the top.
class Layout {
 public:
  Layout(const Page& page, TagSheets& out) : page_(page), content_(content_of(page)), out_(out) {}

  void place(const TagPatch& patch) {
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
    const Vec2 centre_mm = add_patch(out_.sheets.back(), patch, left_mm, top_mm);
    out_.placed.push_back({out_.sheets.size() - 1, centre_mm.x, centre_mm.y, patch.size_mm});
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
  if (tags.size() > kMaxTags) {
    return Error{std::to_string(tags.size()) + " tags to print, limit 1000"};
  }
  if (!(options.quiet_cells >= 1.0 && options.quiet_cells <= kMaxQuietCells)) {
    return Error{"quiet zone of " + mm_text(options.quiet_cells) + " cells, must be 1-4"};
  }
  const auto font = PrintFont::open();
  if (!font) {
    return font.error();
  }
  TagSheets out;
  Layout layout(options.page, out);
  for (const PrintedTag& tag : tags) {
    const auto patch = tag_patch(tag, options.quiet_cells, *font);
    if (!patch) {
      return patch.error();
    }
    if (const Status s = fits(tag, *patch, options.page); !s) {
      return s.error();
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
