#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>
#include <sstream>

#include "tests/tools/command_line.h"
#include "tools/orthonav/command_page.h"
#include "tools/orthonav/config/did_you_mean.h"
#include "tools/orthonav/help_text.h"
#include "tools/orthonav/manual/manual_page.h"

namespace orthonav::test::help_test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using tools::CommandPage;

/// A command with every kind of option.
CommandPage page() {
  CLI::App app("Drives nails", "tool");
  static std::string text;
  static int number = 3;
  static bool flag = false;
  CLI::App* nail = app.add_subcommand("nail", "One nail");
  nail->add_option("WOOD", text, "what it goes into")->required();
  nail->add_option("-o,--out", text, "where it comes out")->type_name("FILE");
  nail->add_option("--kind", text, "which kind")->type_name("round|square");
  nail->add_option("--head", text, "flat or none")->type_name("SHAPE|flat|none");
  nail->add_option("--blows", number, "how often it is hit, until it sits as deep as it should be")
      ->capture_default_str();
  nail->add_option("--hammer", text, "")->required();
  CLI::Option* quiet = nail->add_flag("--quiet", flag, "no noise");
  nail->add_flag("--loud", flag, "noise")->excludes(quiet);
  nail->add_option("--secret", text, "not told")->group("");
  nail->footer("\n.starts with a dot\n  tool nail oak -o out");
  return tools::page_of(app);
}

TEST(HelpText, SaysWhatFollowsAnOptionItsDefaultAndWhatItExcludes) {
  EXPECT_EQ(tools::help_text(page().commands.front(), 60),
            "One nail\n"
            "\n"
            "Usage: tool nail --hammer TEXT [OPTIONS] WOOD\n"
            "\n"
            "Arguments:\n"
            "  WOOD                        what it goes into\n"
            "\n"
            "Options:\n"
            "  -h, --help                  print this help message and\n"
            "                              exit\n"
            "  -o, --out FILE              where it comes out\n"
            "  --kind round|square         which kind\n"
            "  --head SHAPE                flat or none\n"
            "  --blows N                   how often it is hit, until it\n"
            "                              sits as deep as it should be\n"
            "                              (default: 3)\n"
            "  --hammer TEXT               (required)\n"
            "  --quiet                     no noise (not with --loud)\n"
            "  --loud                      noise (not with --quiet)\n"
            "\n"
            ".starts with a dot\n"
            "  tool nail oak -o out\n");
}

TEST(ManualPages, AreOnePerCommandAndTakeNoTextForARequest) {
  const auto pages = tools::manual_pages(page(), "tool 1");
  ASSERT_EQ(pages.size(), 2u);
  EXPECT_EQ(pages[0].file_name, "tool.1");
  EXPECT_EQ(pages[1].file_name, "tool-nail.1");
  EXPECT_THAT(pages[0].roff, HasSubstr("\\fBtool\\-nail\\fR(1)\nOne nail\n"));
  EXPECT_THAT(pages[1].roff,
              AllOf(HasSubstr("tool\\-nail \\- One nail\n"),
                    HasSubstr("\n\\&.starts with a dot\n.nf\n  tool nail oak \\-o out\n"),
                    Not(HasSubstr("secret"))));
}

TEST(DidYouMean, FindsTheWordWithTheFewestMistakesAndNoneThatIsFar) {
  const std::vector<std::string> words = {"run", "rod", "render", "register", "--headset"};
  EXPECT_EQ(tools::closest("rnu", words), "run");
  EXPECT_EQ(tools::closest("regsiter", words), "register");
  EXPECT_EQ(tools::closest("--haedset", words), "--headset");
  EXPECT_EQ(tools::closest("rendr", words), "render");
  EXPECT_EQ(tools::closest("fly", words), "");
  EXPECT_EQ(tools::closest("", words), "");
  EXPECT_EQ(tools::closest(std::string(100'000, 'r'), words), "");
}

TEST(Help, OfEveryCommandIsThereAndNamesTheMistypedWord) {
  EXPECT_THAT(orthonav({"--help"}).out, HasSubstr("\nCommands:\n  calibrate "));
  EXPECT_THAT(orthonav({"rnu"}).err, HasSubstr("unknown command: rnu; did you mean run? (see"));
  EXPECT_THAT(orthonav({"case", "mkae"}).err,
              HasSubstr("did you mean make? (see orthonav case --"));
  EXPECT_THAT(orthonav({"run", "--headest", "x"}).err,
              HasSubstr("unknown option: --headest; did you mean --headset? (see orthonav run --"));
  const auto slicer = orthonav({"plan", "to-slicer"});
  EXPECT_EQ(slicer.code, 2);
  EXPECT_THAT(slicer.err, HasSubstr("unknown command: to-slicer; did you mean export? (see"));
  EXPECT_THAT(orthonav({"plan", "screws"}).err, HasSubstr("unknown command: screws (see"))
      << "the description of several";
  EXPECT_THAT(orthonav({"doctor", "more"}).err, HasSubstr("unexpected argument: more (see"));
}

/// Calls `look` with the help of this command and of all below it.
void for_each_help(const std::vector<std::string>& way,
                   const std::function<void(const std::string&)>& look) {
  std::vector<std::string> asked = way;
  asked.emplace_back("--help");
  const std::string help = orthonav(asked).out;
  look(help);
  std::istringstream lines(help);
  std::string line;
  while (std::getline(lines, line) && line != "Commands:") {
  }
  while (std::getline(lines, line) && !line.empty()) {
    if (line[2] != ' ') {
      std::vector<std::string> below = way;
      below.push_back(line.substr(2, line.find(' ', 2) - 2));
      for_each_help(below, look);
    }
  }
}

TEST(Help, SaysDefaultsInOneStyle) {
  int commands = 0;
  int defaults = 0;
  for_each_help({}, [&](const std::string& help) {
    ++commands;
    defaults += help.find("(default: ") != std::string::npos ? 1 : 0;
    EXPECT_THAT(help, Not(HasSubstr("; default:")));
    EXPECT_THAT(help, Not(HasSubstr("(default)")));
    EXPECT_THAT(help, Not(ContainsRegex(" \\[[a-z]"))) << "a default in brackets";
  });
  EXPECT_GE(commands, 45);
  EXPECT_GE(defaults, 25);
}

/// The manual, made once.
const ScratchFolder& manual() {
  static const ScratchFolder folder;
  static const int code = orthonav({"manual", "-o", folder.file("man")}).code;
  EXPECT_EQ(code, 0);
  return folder;
}

TEST(Manual, HasAPageOfEveryCommandThatHelpNames) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(manual().file("man"))) {
    names.insert(entry.path().filename().string());
  }
  std::istringstream lines(orthonav({"--help"}).out);
  std::string line;
  while (std::getline(lines, line) && line != "Commands:") {
  }
  int commands = 0;
  while (std::getline(lines, line) && !line.empty()) {
    if (line[2] != ' ') {
      ++commands;
      EXPECT_EQ(names.count("orthonav-" + line.substr(2, line.find(' ', 2) - 2) + ".1"), 1u)
          << line;
    }
  }
  EXPECT_GE(commands, 20);
  EXPECT_EQ(names.count("orthonav-plan-auto.1"), 1u);
}

/// What bash offers after these words, the last of which is not complete, in the folder /usr.
std::string completed(const std::vector<std::string>& words) {
  const ScratchFolder folder;
  std::string script =
      "source <(" + std::string(ORTHONAV_COMMAND) + " completion bash)\nCOMP_WORDS=(";
  for (const std::string& word : words) {
    script += "'" + word + "' ";
  }
  script += ")\nCOMP_CWORD=" + std::to_string(words.size() - 1) +
            "\ncd /usr && _orthonav; IFS=,; echo \"${COMPREPLY[*]}\" >" + folder.file("offered") +
            "\n";
  EXPECT_EQ(std::system(("bash " + folder.with("complete", script)).c_str()), 0);
  const std::string offered = content_of(folder.file("offered"));
  return offered.substr(0, offered.find('\n'));
}

TEST(Completion, OffersCommandsOptionsChoicesAndFiles) {
  EXPECT_EQ(completed({"orthonav", "ru"}), "run");
  EXPECT_EQ(completed({"orthonav", "calibrate", "st"}), "stereo");
  EXPECT_EQ(completed({"orthonav", "run", "--met"}), "--method");
  EXPECT_EQ(completed({"orthonav", "run", "-m", ""}), "best,paper");
  EXPECT_EQ(completed({"orthonav", "track", "loc"}), "local");
  EXPECT_EQ(completed({"orthonav", "demo", "--guidance", ""}),
            "overlay,numbers,closed loop,published");
  EXPECT_EQ(completed({"orthonav", "run", "--instrument", "ro"}), "robot arm");
  EXPECT_EQ(completed({"orthonav", "case", "make", "--convention", "v"}), "verse");
  EXPECT_EQ(completed({"orthonav", "run", "--language", ""}), "en,de");
  EXPECT_EQ(completed({"orthonav", "completion", "z"}), "zsh");
  EXPECT_EQ(completed({"orthonav", "study", "--instrument", "sl"}), "sleeved drill");
  EXPECT_EQ(completed({"orthonav", "study", "--profile", "lieb"}), "liebmann-2019");
  EXPECT_EQ(completed({"orthonav", "study", "--without", "ta"}), "tag-sizes");
  EXPECT_EQ(completed({"orthonav", "run", "--headset", "hl"}), "hl2ss://");
  EXPECT_EQ(completed({"orthonav", "run", "--voice", ""}), "headset,none,mic:,headset-mic:,wav:");
  EXPECT_EQ(completed({"orthonav", "run", "--clicker", "k"}), "keyboard:");
  EXPECT_EQ(completed({"orthonav", "detect", "--family", "tag25"}), "tag25h9");
  EXPECT_EQ(completed({"orthonav", "print", "tags", "--family", "tagStandard41"}),
            "tagStandard41h12");
  EXPECT_EQ(completed({"orthonav", "serve-hl2ss", "--faults", "freeze_l"}), "freeze_left=");
}

}  // namespace
}  // namespace orthonav::test::help_test
