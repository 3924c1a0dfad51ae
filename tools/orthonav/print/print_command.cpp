#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/how_many.h"
#include "engine/case/tool_file.h"
#include "engine/io/atomic_file.h"
#include "engine/io/text_fields.h"
#include "engine/print/board_file.h"
#include "engine/print/board_sheet.h"
#include "engine/print/sheet_drawing.h"
#include "engine/print/tag_sheets.h"
#include "tools/orthonav/command.h"
#include "tools/orthonav/print/print_page.h"
#include "tools/orthonav/print/print_rod.h"
#include "tools/orthonav/shared/arguments.h"
#include "tools/orthonav/shared/number_list.h"

namespace orthonav::tools {
namespace {

constexpr int kMaxTags = 1000;

struct TagArguments {
  PageArguments page;
  std::string family = "tag36h11";
  std::string ids;
  double size_mm = 40.0;
  double quiet_cells = 1.0;
  std::string tools_file;
  std::string name;
};

struct BoardArguments {
  PageArguments page;
  std::string kind = "aprilgrid";
  std::string family = "tag36h11";
  int first_id = 0;
  std::optional<int> columns;
  std::optional<int> rows;
  double size_mm = 20.0;
  std::optional<double> gap_mm;
  std::string json;
};

int print_tags(const TagArguments& arguments, const std::vector<engine::PrintedTag>& tags,
               const std::string& title) {
  const auto page = engine::page_named(arguments.page.page, arguments.page.landscape);
  if (!page) {
    return bad_input(page.error().message);
  }
  const auto sheets = engine::tag_sheets(tags, {*page, arguments.quiet_cells});
  if (!sheets) {
    return bad_input(sheets.error().message);
  }
  const auto pdf = engine::pdf_of(sheets->sheets, title);
  if (!pdf) {
    return bad_input(pdf.error().message);
  }
  if (Status s = engine::write_file(arguments.page.out, *pdf); !s) {
    return bad_input(s.error().message);
  }
  std::printf("%s: %s on %s (%s); print at 100 %%, both rulers must be 100 mm\n",
              arguments.page.out.c_str(), how_many(tags.size(), "tag").c_str(),
              how_many(sheets->sheets.size(), "page").c_str(), page->name.c_str());
  return kDone;
}

int run_tags(const TagArguments& arguments) {
  const auto ids = number_list(arguments.ids, kMaxTags);
  if (!ids) {
    return bad_input("--ids: " + ids.error().message);
  }
  std::vector<engine::PrintedTag> tags;
  for (const int id : *ids) {
    tags.push_back({{arguments.family, id, arguments.size_mm * 1e-3}, ""});
  }
  return print_tags(arguments, tags, "orthonav tags");
}

int run_tool(const TagArguments& arguments) {
  const bool built_in = arguments.tools_file.empty();
  const auto tools =
      built_in ? Result(engine::built_in_tools()) : engine::load_tools(arguments.tools_file);
  if (!tools) {
    return bad_input(tools.error().message);
  }
  std::vector<engine::PrintedTag> tags;
  std::string known;
  for (const nav::ToolGeometry& tool : *tools) {
    known += (known.empty() ? "" : ", ") + tool.name;
    if (!arguments.name.empty() && tool.name != arguments.name) {
      continue;
    }
    tags.push_back({tool.marker, tool.name});
    for (const nav::AttachedMarker& more : tool.more_markers) {
      tags.push_back({more.definition, tool.name});
    }
  }
  if (tags.empty()) {
    return bad_input((built_in ? "built-in tools" : arguments.tools_file) + ": no tool \"" +
                     arguments.name + "\", there are " + known);
  }
  return print_tags(arguments, tags, "orthonav tool tags");
}

Result<engine::Board> board_of(const BoardArguments& arguments) {
  engine::Board board;
  const bool chessboard = arguments.kind == "chessboard";
  board.kind = chessboard                 ? engine::BoardKind::kChessboard
               : arguments.kind == "tags" ? engine::BoardKind::kTags
                                          : engine::BoardKind::kAprilGrid;
  board.columns = arguments.columns.value_or(chessboard ? 7 : 6);
  board.rows = arguments.rows.value_or(chessboard ? 10 : 6);
  board.size_m = arguments.size_mm * 1e-3;
  if (chessboard) {
    if (arguments.gap_mm) {
      return Error{"--gap-mm: a chessboard has no gaps"};
    }
    board.family.clear();
    board.border_cells = 0;
    return board;
  }
  board.family = arguments.family;
  // Kalibr's own default.
  board.gap_m = arguments.gap_mm.value_or(0.3 * arguments.size_mm) * 1e-3;
  board.border_cells = board.kind == engine::BoardKind::kAprilGrid ? 2 : 1;
  board.ids = engine::consecutive_ids(board.kind, board.columns, board.rows, arguments.first_id);
  return board;
}

/// Beside the PDF unless `--json` names another place.
std::string json_place(const BoardArguments& arguments) {
  if (!arguments.json.empty()) {
    return arguments.json;
  }
  return std::filesystem::path(arguments.page.out).replace_extension(".json").string();
}

int run_board(const BoardArguments& arguments) {
  const auto page = engine::page_named(arguments.page.page, arguments.page.landscape);
  if (!page) {
    return bad_input(page.error().message);
  }
  const auto board = board_of(arguments);
  if (!board) {
    return bad_input(board.error().message);
  }
  const std::string json = json_place(arguments);
  if (std::filesystem::path(json).lexically_normal() ==
      std::filesystem::path(arguments.page.out).lexically_normal()) {
    return bad_input(json + ": is both the PDF and the board's description");
  }
  const auto sheet = engine::board_sheet(*board, *page);
  if (!sheet) {
    return bad_input(sheet.error().message);
  }
  const auto pdf = engine::pdf_of({&sheet->sheet, 1}, "orthonav board");
  if (!pdf) {
    return bad_input(pdf.error().message);
  }
  // Checked before either file gets its name, so that an unwritable place leaves neither.
  if (Status s = engine::check_place(arguments.page.out); !s) {
    return bad_input(s.error().message);
  }
  if (Status s = engine::save_board(json, *board); !s) {
    return bad_input(s.error().message);
  }
  if (Status s = engine::write_file(arguments.page.out, *pdf); !s) {
    return bad_input(s.error().message);
  }
  std::printf(
      "%s: %s, %d x %d, %s x %s mm on %s; print at 100 %%, both rulers must be 100 mm\n"
      "%s: its description\n",
      arguments.page.out.c_str(), engine::in_words(board->kind).c_str(), board->columns,
      board->rows, engine::mm_text(board->width_m() * 1e3).c_str(),
      engine::mm_text(board->height_m() * 1e3).c_str(), page->name.c_str(), json.c_str());
  return kDone;
}

void add_quiet_option(CLI::App& command, TagArguments& arguments) {
  command
      .add_option("--quiet-cells", arguments.quiet_cells, "White around a tag, cells of the tag")
      ->check(finite_number(1, 4))
      ->capture_default_str();
}

void add_tags(CLI::App& print, Action& action) {
  auto arguments = std::make_shared<TagArguments>();
  CLI::App* command = print.add_subcommand("tags", "Tags to cut out");
  command->add_option("--ids", arguments->ids, "Ids and ranges: 3 or 0-5,17")->required();
  command->add_option("--family", arguments->family, "Tag family")->capture_default_str();
  command->add_option("--size-mm", arguments->size_mm, "Outer edge of the border")
      ->check(finite_number(5, 200))
      ->capture_default_str();
  add_quiet_option(*command, *arguments);
  arguments->page.add_to(*command);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_tags(*arguments); }; });
}

void add_tool(CLI::App& print, Action& action) {
  auto arguments = std::make_shared<TagArguments>();
  CLI::App* command = print.add_subcommand("tool", "The tags of tools, at their sizes");
  command->add_option("TOOLS", arguments->tools_file,
                      "Tool definitions, JSON (default: the built-in tools)");
  command->add_option("--name", arguments->name, "Only this tool")->check(some_text());
  add_quiet_option(*command, *arguments);
  arguments->page.add_to(*command);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_tool(*arguments); }; });
}

void add_board(CLI::App& print, Action& action) {
  auto arguments = std::make_shared<BoardArguments>();
  CLI::App* command =
      print.add_subcommand("board", "A board to calibrate and to check accuracy with");
  command
      ->add_option("--kind", arguments->kind,
                   "aprilgrid: Kalibr's (borders of two cells, black squares at the crossings); "
                   "tags: plain tags; chessboard")
      ->check(CLI::IsMember({"aprilgrid", "tags", "chessboard"}))
      ->capture_default_str();
  command
      ->add_option("--columns", arguments->columns,
                   "Tags or squares across (default: 6, 7 of a chessboard)")
      ->check(whole_number(1, 50));
  command
      ->add_option("--rows", arguments->rows,
                   "Tags or squares upward (default: 6, 10 of a chessboard)")
      ->check(whole_number(1, 50));
  command
      ->add_option("--size-mm", arguments->size_mm, "Outer edge of a tag's border, or of a square")
      ->check(finite_number(2, 500))
      ->capture_default_str();
  command
      ->add_option("--gap-mm", arguments->gap_mm,
                   "Between the borders of neighbours (default: 0.3 of the size)")
      ->check(finite_number(0, 500));
  command->add_option("--family", arguments->family, "Tag family")->capture_default_str();
  command->add_option("--first-id", arguments->first_id, "Id of the first tag")
      ->check(whole_number(0, 1000000))
      ->capture_default_str();
  arguments->page.add_to(*command);
  command
      ->add_option("--json", arguments->json,
                   "The board's description (default: beside the PDF, with its name)")
      ->check(some_text())
      ->type_name("FILE");
  command->callback(
      [arguments, &action] { action = [arguments] { return run_board(*arguments); }; });
}

constexpr const char* kPrintFooter =
    "\nEvery page has a ruler of 100 mm in both directions: measure them before the print is "
    "used.\n"
    "A tag's size is the outer edge of its black border; the white around it belongs to it.";

}  // namespace

void add_print_command(CLI::App& app, Action& action) {
  CLI::App* command =
      app.add_subcommand("print", "Tags, tools, boards and rods as PDF, in exact millimetres");
  command->require_subcommand(1);
  command->footer(kPrintFooter);
  add_tags(*command, action);
  add_tool(*command, action);
  add_board(*command, action);
  add_print_rod(*command, action);
}

}  // namespace orthonav::tools
