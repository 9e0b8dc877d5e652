// Interfaces and --fix on the command line, and the lists of groups.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A square in a square of another material, in a file of this name.
std::string nested(const Folder& folder, const std::string& name) {
  const std::string path = folder / name;
  EXPECT_EQ(run({"generate", "nested", "--size", "100", "-o", path}).code, 0);
  return path;
}

TEST(InterfacesOnTheCommandLine, StayUnlessFreeAndAreSaid) {
  const Folder folder;
  const std::string in = nested(folder, "a.msh");
  const Output said = run({"smooth", in, "-o", folder / "b.msh", "--iterations", "3", "--json"});
  EXPECT_THAT(said.err, HasSubstr("a.msh: 20 vertices on the interface between groups stay (--interfaces free moves them)"));
  const auto held = json_of(said);
  EXPECT_EQ(held["held_on_interfaces"], 20);
  EXPECT_EQ(held["parameters"]["interfaces"], "fixed");
  EXPECT_THAT(held["warnings"], Contains(HasSubstr("20 vertices on the interface")));
  const auto moves = smooth(in, folder / "c.msh", {"--iterations", "3", "--interfaces", "free"});
  EXPECT_EQ(moves["held_on_interfaces"], 0);
  EXPECT_EQ(moves["free"], held["free"].get<int>() + 20);
  EXPECT_THAT(moves["warnings"], Not(Contains(HasSubstr("interface"))));
  const Output compared = run({"compare", in, "--run", "dmo", "--run", "laplace", "--iterations", "1", "--json"});
  EXPECT_EQ(json_of(compared)["free"], held["free"]);
  EXPECT_THAT(compared.err, HasSubstr("20 vertices on the interface"));
  EXPECT_EQ(json_of(run({"compare", in, "--run", "dmo", "--iterations", "1", "--json", "--interfaces", "free"}))["free"], moves["free"]);
  EXPECT_EQ(run({"smooth", in, "-o", folder / "d.msh", "--interfaces", "up"}).code, 2);
}

/// 4 x 4 squares, the middle vertex of the left ones misplaced; the two halves have different numbers.
std::string two_materials(const Folder& folder, const std::string& field) {
  std::string text = "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 25 double\n";
  for (int v = 0; v < 25; ++v) text += fmt::format("{} {} 0\n", v % 5 + (v == 12 ? 0.3 : 0.0), v / 5);
  text += "CELLS 16 80\n";
  for (int e = 0; e < 16; ++e) {
    const int v = e % 4 + 5 * (e / 4);
    text += fmt::format("4 {} {} {} {}\n", v, v + 1, v + 6, v + 5);
  }
  text += "CELL_TYPES 16\n";
  for (int e = 0; e < 16; ++e) text += "9\n";
  text += fmt::format("CELL_DATA 16\nSCALARS {} int 1\nLOOKUP_TABLE default\n", field);
  for (int e = 0; e < 16; ++e) text += e % 4 < 2 ? "1\n" : "2\n";
  return folder.file("two.vtk", text);
}

TEST(InterfacesOnTheCommandLine, AnyCellDataNameMaterials) {
  const Folder folder;
  const std::string known = two_materials(folder, "avsucd:material");
  EXPECT_EQ(smooth(known, folder / "b.vtk", {"--iterations", "3"})["held_on_interfaces"], 3);

  const std::string in = two_materials(folder, "zoning");
  const Output said = run({"smooth", in, "-o", folder / "b.vtk", "--iterations", "3", "--json"});
  EXPECT_THAT(said.err, HasSubstr("two.vtk: cell data \"zoning\" has 2 values: --materials zoning keeps their interfaces"));
  EXPECT_EQ(json_of(said)["held_on_interfaces"], 0);
  EXPECT_THAT(json_of(said)["warnings"], Contains(HasSubstr("--materials zoning")));
  EXPECT_THAT(run({"smooth", in, "-o", folder / "b.vtk", "--interfaces", "free", "--iterations", "1"}).err, Not(HasSubstr("--materials")));
  const auto named = smooth(in, folder / "c.vtk", {"--iterations", "3", "--materials", "zoning"});
  EXPECT_EQ(named["held_on_interfaces"], 3);
  EXPECT_THAT(named["warnings"], Not(Contains(HasSubstr("--materials"))));
  const Output compared = run({"compare", in, "--run", "dmo", "--iterations", "1", "--json", "--materials", "zoning"});
  EXPECT_EQ(json_of(compared)["free"], named["free"]);
  const Output refused = run({"smooth", in, "-o", folder / "d.vtk", "--materials", "zones"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("unknown cell data 'zones'"), HasSubstr("known are zoning")));
}

TEST(InterfacesOnTheCommandLine, NothingIsSaidOfAMeshWithoutAny) {
  const Folder folder;
  ASSERT_EQ(run({"generate", "grid", "--size", "100", "-o", folder / "a.off"}).code, 0);
  EXPECT_THAT(run({"smooth", folder / "a.off", "-o", folder / "b.off", "--iterations", "1"}).err, Not(HasSubstr("interface")));
}

TEST(FixOnTheCommandLine, TakesEveryFormAndRefusesWhatIsNotClear) {
  const Folder folder;
  const std::string in = nested(folder, "a.msh");
  const auto fixed = [&](std::vector<std::string> words) {
    std::vector<std::string> more{"--iterations", "1"};
    for (std::string& word : words) more.insert(more.end(), {"--fix", std::move(word)});
    return smooth(in, folder / "b.msh", more)["parameters"]["fixed_by_user"].get<int>();
  };
  EXPECT_EQ(fixed({"group:inner"}), 36);
  EXPECT_EQ(fixed({"inner"}), 36);
  EXPECT_EQ(fixed({"group:1"}), 36);
  EXPECT_EQ(fixed({"material=1"}), 36);
  EXPECT_EQ(fixed({"material=1,2"}), 100);
  EXPECT_EQ(fixed({"vertices:0,5-7"}), 4);
  EXPECT_EQ(fixed({"0,5-7", "box:-1,-1,0.1,9"}), 13);
  const auto refused = [&](const std::string& word) {
    const Output output = run({"smooth", in, "-o", folder / "no.msh", "--fix", word});
    EXPECT_EQ(output.code, 2) << word;
    EXPECT_FALSE(exists(folder / "no.msh"));
    return output.err;
  };
  EXPECT_THAT(refused("1"), HasSubstr("--fix 1: this can mean more than one thing; write 'group:inner' or 'vertices:1'"));
  EXPECT_THAT(refused("group:middle"), HasSubstr("no such group; the mesh's groups: outer, inner"));
  EXPECT_THAT(refused("material=3"), HasSubstr("material is nowhere 3; it is 1, 2"));
  EXPECT_THAT(refused("box:8,8,7,9"), HasSubstr("the box ends"));
}

TEST(GroupLists, InfoAndQualityTellKindDimensionNumberNameAndCounts) {
  const Folder folder;
  const std::string in = nested(folder, "a.msh");
  const Output text = run({"info", in});
  EXPECT_EQ(text.code, 0);
  EXPECT_THAT(text.out, AllOf(HasSubstr("physical group"), HasSubstr("inner"), HasSubstr("names materials"),
                              HasSubstr("20 vertices on the interface between groups stay")));
  for (const auto& listed : {json_of(run({"info", in, "--json"})), json_of(run({"quality", in, "--json"}))}) {
    ASSERT_EQ(listed["groups"].size(), 2U);
    const auto& inner = listed["groups"][1];  // its elements come after the outer ones
    EXPECT_EQ(inner["kind"], "physical group");
    EXPECT_EQ(inner["dimension"], 2);
    EXPECT_EQ(inner["id"], 1);
    EXPECT_EQ(inner["name"], "inner");
    EXPECT_EQ(inner["members"], "elements");
    EXPECT_EQ(inner["count"], 50);
    EXPECT_EQ(inner["vertices"], 36);
    EXPECT_EQ(listed["vertices"], 100);
  }
  EXPECT_THAT(run({"quality", in}).out, HasSubstr("physical group"));
  const auto coast = json_of(run({"info", sample("coast.14"), "--json"}));
  EXPECT_EQ(coast["groups"][0]["kind"], "open boundary");
  EXPECT_EQ(coast["groups"][0]["dimension"], 0);
  EXPECT_TRUE(coast["groups"][0]["id"].is_null());
  EXPECT_EQ(coast["data"][0]["name"], "depth");
  EXPECT_EQ(coast["held_on_interfaces"], 0);
  EXPECT_EQ(run({"info", folder / "missing.msh"}).code, 3);
}

}  // namespace
}  // namespace dmoscope::test
