#include "tools/orthonav/print/print_rod.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "base/how_many.h"
#include "engine/io/atomic_file.h"
#include "engine/print/rod_sheet.h"
#include "engine/print/sheet_drawing.h"
#include "tools/orthonav/print/print_page.h"
#include "tools/orthonav/shared/rod_arguments.h"

namespace orthonav::tools {
namespace {

struct PrintRodArguments {
  RodHeadArguments heads;
  RodBendingArguments bending;
  PageArguments page;
};

Result<std::string> rod_pdf(const nav::RodInstructions& told, const nav::RodBending& bending,
                            const engine::Page& page, const PrintRodArguments& arguments) {
  const auto spring_back =
      nav::RodSpringBack::of(bending.bender, bending.material, bending.diameter_m);
  if (!spring_back) {
    return spring_back.error();
  }
  const auto sheet = engine::rod_sheet(
      told,
      {std::filesystem::path(arguments.heads.heads).filename().string(), bending.material.name,
       bending.diameter_m, bending.bender.width_m, spring_back->smallest_radius_m()},
      page);
  if (!sheet) {
    return sheet.error();
  }
  return engine::pdf_of({&*sheet, 1}, "orthonav rod");
}

int run_print_rod(const PrintRodArguments& arguments) {
  const auto page = engine::page_named(arguments.page.page, arguments.page.landscape);
  if (!page) {
    return bad_input(page.error().message);
  }
  const auto rod = arguments.heads.rod();
  if (!rod) {
    return bad_input(rod.error().message);
  }
  const auto bending = arguments.bending.bending(arguments.heads.diameter_mm);
  if (!bending) {
    return bad_input(bending.error().message);
  }
  const auto seats_m = arguments.bending.seats_m(*rod);
  if (!seats_m) {
    return bad_input(seats_m.error().message);
  }
  const auto told = nav::rod_instructions(*seats_m, *bending);
  if (!told) {
    std::fprintf(stderr, "orthonav: %s: %s\n", arguments.heads.heads.c_str(),
                 told.error().message.c_str());
    return kNo;
  }
  const auto pdf = rod_pdf(*told, *bending, *page, arguments);
  if (!pdf) {
    return bad_input(pdf.error().message);
  }
  if (const Status s = engine::write_file(arguments.page.out, *pdf); !s) {
    return bad_input(s.error().message);
  }
  std::printf("%s: rod of %.1f mm with %s (%s); print at 100 %%, both rulers must be 100 mm\n",
              arguments.page.out.c_str(), told->cut_length_m() * 1e3,
              how_many(told->bends.size(), "bend").c_str(), page->name.c_str());
  return kDone;
}

}  // namespace

void add_print_rod(CLI::App& print, Action& action) {
  auto arguments = std::make_shared<PrintRodArguments>();
  CLI::App* command =
      print.add_subcommand("rod", "How to bend a rod: table, marks at full size, both views");
  arguments->heads.add_to(*command);
  arguments->bending.add_to(*command);
  arguments->page.add_to(*command);
  command->callback(
      [arguments, &action] { action = [arguments] { return run_print_rod(*arguments); }; });
}

}  // namespace orthonav::tools
