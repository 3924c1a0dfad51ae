#include "engine/report/session_report.h"
#include "engine/session/journal_reader.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Journals of sessions, and their reports.
void fuzz_journal(std::span<const std::uint8_t> input) {
  const std::string text(input.begin(), input.end());
  const auto session = engine::read_journal_text(text, "journal");
  if (!session) {
    insist_one_line(session.error());
    return;
  }
  insist(session->lines > 0 && session->levels.size() <= 100);
  insist(session->begin.has_value() == session->end.has_value());
  const std::string page = engine::session_page(*session, "journal");
  insist(page.find("nan") == std::string::npos || text.find("nan") != std::string::npos);
  insist(!engine::session_json(*session).empty());
}

}  // namespace orthonav::fuzz
