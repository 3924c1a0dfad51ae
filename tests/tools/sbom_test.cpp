#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/tools/command_line.h"

namespace orthonav::test::sbom_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// What a line of the shell prints.
std::string said(const std::string& line) {
  FILE* pipe = ::popen(line.c_str(), "r");
  std::string out;
  char part[4096];
  while (const std::size_t count = std::fread(part, 1, sizeof part, pipe)) {
    out.append(part, count);
  }
  EXPECT_EQ(::pclose(pipe), 0) << line;
  return out;
}

const std::string kTool = std::string(ORTHONAV_SOURCE_DIR) + "/tools/sbom ";

TEST(Sbom, IsSpdxAndNamesEveryLibraryThatTheProgramNames) {
  const json document = json::parse(said(kTool + ORTHONAV_BUILD_DIR));
  EXPECT_EQ(document.at("spdxVersion"), "SPDX-2.3");
  EXPECT_EQ(document.at("dataLicense"), "CC0-1.0");
  EXPECT_EQ(document.at("SPDXID"), "SPDXRef-DOCUMENT");
  EXPECT_THAT(document.at("documentNamespace").get<std::string>(), HasSubstr("https://"));
  EXPECT_TRUE(std::regex_match(document.at("creationInfo").at("created").get<std::string>(),
                               std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ)")));
  EXPECT_THAT(document.at("creationInfo").at("creators").at(0).get<std::string>(),
              HasSubstr("Tool: "));

  std::map<std::string, json> by_id;
  const std::regex id(R"(SPDXRef-[A-Za-z0-9.-]+)");
  for (const json& package : document.at("packages")) {
    const std::string name = package.at("SPDXID");
    EXPECT_TRUE(std::regex_match(name, id)) << name;
    EXPECT_TRUE(by_id.emplace(name, package).second) << name << " stands twice";
    EXPECT_FALSE(package.at("versionInfo").get<std::string>().empty()) << name;
    EXPECT_EQ(package.at("downloadLocation"), "NOASSERTION");
    EXPECT_EQ(package.at("filesAnalyzed"), false);
    EXPECT_NE(package.at("licenseDeclared"), "NOASSERTION") << name;
  }
  std::set<std::string> depended_on;
  bool described = false;
  for (const json& relation : document.at("relationships")) {
    const std::string from = relation.at("spdxElementId");
    EXPECT_TRUE(from == "SPDXRef-DOCUMENT" || by_id.count(from) == 1) << from;
    ASSERT_EQ(by_id.count(relation.at("relatedSpdxElement")), 1u) << relation;
    described = described || relation.at("relationshipType") == "DESCRIBES";
    if (relation.at("relationshipType") == "DEPENDS_ON") {
      depended_on.insert(relation.at("relatedSpdxElement"));
    }
  }
  EXPECT_TRUE(described);
  EXPECT_EQ(depended_on.size() + 1, by_id.size()) << "all but the program itself";
  // A library, headers alone, what is embedded, and what a library brings.
  for (const char* name : {"libassimp5", "libeigen3-dev", "fonts-dejavu-core", "libx264-164"}) {
    EXPECT_EQ(depended_on.count(std::string("SPDXRef-Package-") + name), 1u) << name;
  }
  EXPECT_EQ(by_id.at("SPDXRef-Package-libeigen3-dev").at("licenseDeclared"), "MPL-2.0");
  EXPECT_EQ(by_id.at("SPDXRef-Package-libx264-164").at("licenseDeclared"), "GPL-2.0-or-later");
  EXPECT_EQ(by_id.at("SPDXRef-Package-orthonav").at("licenseDeclared"), "Apache-2.0");
}

TEST(Sbom, RefusesAPackageWhoseLicenceNobodyStated) {
  const ScratchFolder root;
  const std::string tables = "data/licences.tsv data/licences_loaded.tsv ";
  said("cd " + std::string(ORTHONAV_SOURCE_DIR) + " && cp -r --parents tools/sbom CMakeLists.txt " +
       tables + root.file(""));
  said("cd " + root.file("") + " && sed -i '/^assimp\\|^x264/d' " + tables);
  const std::string out = said("! " + root.file("tools/sbom ") + ORTHONAV_BUILD_DIR + " 2>&1");
  EXPECT_THAT(out, HasSubstr("sbom: data/licences.tsv lacks assimp (package libassimp5)\n"));
  EXPECT_THAT(out, HasSubstr("sbom: data/licences_loaded.tsv lacks x264 (package libx264-164)\n"));
}

TEST(Licences, AreInTheirPageAsTheTableHasThem) {
  const std::string page = content_of(std::string(ORTHONAV_SOURCE_DIR) + "/docs/licences.md");
  EXPECT_THAT(page, HasSubstr("<!-- licences begin -->\n" + said(kTool + "--licences") +
                              "<!-- licences end -->"));
}

}  // namespace
}  // namespace orthonav::test::sbom_test
