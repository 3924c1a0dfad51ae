#include "engine/session/workflow.h"

#include "base/translation.h"

namespace orthonav::engine {
namespace {

// Spoken words are not translated.
constexpr std::array<std::string_view, kEventCount> kEventNames = {
    translatable("press"),
    translatable("release"),
    translatable("click"),
    translatable("double click"),
    translatable("hold"),
    "\"start\"",
    "\"save\"",
    "\"delete\"",
    "\"accept\"",
    "\"reject\"",
    "\"next\"",
    "\"done\"",
    "\"move rod\"",
    "\"twin\"",
    "\"drill\"",
    translatable("change of the screw"),
    translatable("registered"),
    translatable("registration refused"),
    translatable("registration restored"),
    translatable("acceptance restored"),
    translatable("checked"),
    translatable("not checked"),
    translatable("landmark touched"),
    translatable("landmark missing"),
    translatable("landmark moved"),
    translatable("bone unchecked"),
    translatable("wire settled"),
    translatable("wire undecided"),
    translatable("screw redone"),
    translatable("no other entry"),
    translatable("another screw"),
    translatable("another level"),
    translatable("no screw left"),
    translatable("no rod planned"),
    translatable("another side"),
    translatable("no side left"),
    translatable("tracking lost"),
    translatable("pose stale"),
    translatable("tracking regained"),
    translatable("map moved"),
    translatable("reference hidden"),
    translatable("reference seen"),
    translatable("reference moved"),
};

constexpr std::array<std::string_view, kActionCount> kActionNames = {
    "refuse",
    "ignore",
    "begin level",
    "start sampling",
    "stop sampling",
    "save region",
    "drop region",
    "register",
    "show registration",
    "count refusal",
    "judge checks",
    "ask for checks",
    "record check point",
    "drop check point",
    "accept",
    "clear level",
    "touch landmark",
    "drop landmark",
    "judge landmark",
    "ask for landmark",
    "expect landmark",
    "verify again",
    "correct guide",
    "select screw",
    "expect wire",
    "measure wire",
    "judge wire",
    "ask about wire",
    "keep wire",
    "judge redo",
    "offer to keep",
    "finish screw",
    "begin rod",
    "begin touch",
    "end touch",
    "drop touch",
    "record head",
    "drop head",
    "measure rod",
    "save rod",
    "finish rod",
    "move rod",
    "show or hide twin",
    "watch drill",
    "change screw",
    "consent to breach",
    "finish",
    "warn: not seen",
    "hide guidance",
    "show guidance",
    "forget map",
};

// A missing name at the end of an array would be empty.
static_assert(!kEventNames.back().empty() && !kActionNames.back().empty());

/// Mermaid ends a label at a quote.
std::string unquoted(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c != '"') {
      out += c;
    }
  }
  return out;
}

void append_arrow(std::string& out, const Rule& rule, const char* where) {
  out += "    " + std::string(name_of(rule.step)) + " --> " + std::string(name_of(rule.next)) +
         " : " + where + unquoted(name_of(rule.event)) + " / " + unquoted(name_of(rule.action)) +
         "\n";
}

void append_state_diagram(std::string& out) {
  out += "```mermaid\nstateDiagram-v2\n    [*] --> setup\n";
  for (const Rule& rule : workflow_detail::kRulesRodsAlone) {
    append_arrow(out, rule, "rods alone, ");
  }
  for (const Rule& rule : workflow_detail::kRules) {
    // Events that are ignored would only hide the arrows that matter.
    if (rule.action != Action::kIgnore) {
      append_arrow(out, rule, "");
    }
  }
  out += "    done --> [*]\n```\n";
}

void append_table(std::string& out) {
  out += "| event |";
  for (std::size_t s = 0; s < kStepCount; ++s) {
    out += " " + std::string(name_of(static_cast<Step>(s))) + " |";
  }
  out += "\n|---|";
  for (std::size_t i = 0; i < kStepCount; ++i) {
    out += "---|";
  }
  out += "\n";
  for (std::size_t e = 0; e < kEventCount; ++e) {
    out += "| " + std::string(kEventNames[e]) + " |";
    for (std::size_t s = 0; s < kStepCount; ++s) {
      const Cell cell = kWorkflow[s][e];
      out += " " + std::string(name_of(cell.action));
      if (cell.next != static_cast<Step>(s)) {
        out += " → **" + std::string(name_of(cell.next)) + "**";
      }
      out += " |";
    }
    out += "\n";
  }
}

void append_rules(std::string& out, const auto& rules) {
  out += "| step | event | answer |\n|---|---|---|\n";
  for (const Rule& rule : rules) {
    out += "| " + std::string(name_of(rule.step)) + " | " + std::string(name_of(rule.event)) +
           " | " + std::string(name_of(rule.action));
    if (rule.next != rule.step) {
      out += " → **" + std::string(name_of(rule.next)) + "**";
    }
    out += " |\n";
  }
}

void append_instead(std::string& out) {
  out +=
      "Where rods alone are bent (`--rods-only`), nothing is registered and no screw is "
      "guided:\n\n";
  append_rules(out, workflow_detail::kRulesRodsAlone);
  out +=
      "\nWhere the eye alone verifies (`paper`), these answers stand instead. A study that leaves "
      "out check points,\nthe dimple or the measurement of wires has the rows of `verify`, "
      "`accepted` or `guide`; without the\nlandmark, that of `digitize`:\n\n";
  append_rules(out, workflow_detail::kRulesByEye);
  out += "\nWhere a study leaves out that the landmark is touched again:\n\n";
  append_rules(out, workflow_detail::kRulesTouchedOnce);
  out += "\nWhere it is touched, and a study leaves out that wires are measured:\n\n";
  append_rules(out, workflow_detail::kRulesWireUnmeasured);
}

}  // namespace

std::string_view name_of(Event event) { return kEventNames[static_cast<std::size_t>(event)]; }
std::string_view name_of(Action action) { return kActionNames[static_cast<std::size_t>(action)]; }

std::string workflow_diagram() {
  std::string out;
  append_state_diagram(out);
  out += "\n";
  append_table(out);
  out += "\n";
  append_instead(out);
  return out;
}

}  // namespace orthonav::engine
