#include "engine/report/spine_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/phantom/phantom.h"
#include "tests/support/browser.h"
#include "tests/support/mesh_builder.h"

namespace orthonav::engine::spine_view_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// L4 of the phantom with its planned screws; the left one was driven 20 mm beside its plan.
SpineView operated_level() {
  SpineView view;
  const CaseLevel level = phantom({"L4"}).levels.front();
  const Transform<Vertebra, Vertebra> here;
  view.add_bone(level.mesh, here);
  for (const nav::ScrewPlan& plan : level.screws) {
    auto screw = *nav::cylinder_of(plan);
    view.add_planned(screw, here);
    if (plan.side == nav::Side::kLeft) {
      screw.entry = screw.entry + Vec3{0.02, 0, 0};
      view.add_placed(screw, here);
    }
  }
  return view;
}

json data_of(const std::string& section) {
  const std::string opening = "<script id=spine-data type=\"application/json\">";
  const std::size_t start = section.find(opening) + opening.size();
  return json::parse(section.substr(start, section.find("</script>", start) - start));
}

TEST(SpineView, HoldsEveryBoneAndScrewInMillimetres) {
  const std::string section = operated_level().section("Spine", "What lies where.");
  EXPECT_THAT(section, StartsWith("<section><h2>Spine</h2><canvas id=spine"));
  EXPECT_THAT(section, HasSubstr("What lies where.<span class=on-screen> Drag to turn"));
  const json data = data_of(section);
  EXPECT_EQ(data["bones"].size(), 1u);
  EXPECT_EQ(data["planned"].size(), 2u);
  ASSERT_EQ(data["placed"].size(), 1u);
  EXPECT_EQ(data["placed"][0].size(), 7u);
  EXPECT_NEAR(data["placed"][0][0].get<double>() - data["planned"][0][0].get<double>(), 20, 1e-6);
  EXPECT_GT(data["reach"], 30.0);
  EXPECT_LT(data["reach"], 90.0);
}

TEST(SpineView, IsNothingWithoutABoneAndLeavesOutOneThatIsTooLarge) {
  EXPECT_EQ(SpineView().section("Spine", ""), "");
  SpineView view;
  nav::TriangleMesh large = test::box({}, {0.05, 0.05, 0.05});
  large.vertices_m.resize(65536);
  view.add_bone(large, Transform<Vertebra, Vertebra>());
  EXPECT_EQ(view.section("Spine", ""), "");
}

/// What a script says of the view's picture after it ran, such as "blue 120"; it has a function
/// `count(test)` of the pixels whose red, green and blue pass.
std::string said_in_browser(const std::string& script) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.file("page.html"))
      << "<!doctype html><body>" << operated_level().section("Spine", "")
      << "<script>function count(test){const s=document.getElementById('spine'),"
         "c=document.createElement('canvas');c.width=s.width;c.height=s.height;"
         "const x=c.getContext('2d');x.drawImage(s,0,0);"
         "const p=x.getImageData(0,0,c.width,c.height).data;let n=0;"
         "for(let i=0;i<p.length;i+=4)n+=test(p[i],p[i+1],p[i+2]);return n;}"
         "const amber=(r,g,b)=>r>1.6*b&&r>1.2*g,blue=(r,g,b)=>b>1.3*r;"
         "document.title='says '+("
      << script << ")+';'</script>";
  const std::string page =
      test::page_in_browser("file://" + folder.file("page.html"), 3000, test::BrowserDraws::kWebGl);
  const std::size_t from = page.find("<title>says ");
  return from == std::string::npos ? "?" : page.substr(from + 12, page.find(';', from) - from - 12);
}

TEST(SpineView, IsDrawnInABrowserAndTurns) {
  if (!test::has_browser()) {
    GTEST_SKIP() << test::kNoBrowser;
  }
  const std::string said = said_in_browser(
      "[count(amber)>300,count(blue)>600,"
      "(()=>{const before=count(blue);document.querySelector('[data-turn=above]').click();"
      "return before!==count(blue)&&count(amber)>300})(),"
      "document.getElementById('spine').dataset.drawn].join()");
  EXPECT_EQ(said, "true,true,true,2");
}

}  // namespace
}  // namespace orthonav::engine::spine_view_test
