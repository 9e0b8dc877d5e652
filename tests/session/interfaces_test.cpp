// Interfaces are kept in runs, through every format that carries groups, and are freed on request.

#include <cmath>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/io/mesh_io.h"
#include "core/mesh/generate.h"
#include "core/view/frame_builder.h"
#include "tests/session/spoken_session.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// Area or volume of a group of triangles or tetrahedra.
double measure(const Mesh& mesh, std::span<const Vec3> p, std::span<const Index> elements) {
  double sum = 0.0;
  for (const Index e : elements) {
    const auto c = mesh.elements.corners(e);
    const Vec3 twice = cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]]);
    sum += c.size() == 3 ? 0.5 * twice.z : dot(twice, p[c[3]] - p[c[0]]) / 6.0;
  }
  return sum;
}

class InterfacesInASession : public testing::SpokenSession {
 protected:
  [[nodiscard]] std::string interfaces() { return std::string(name(session_.active().parameters().interfaces)); }
  [[nodiscard]] double inner() {
    const Mesh& mesh = session_.input()->mesh;
    return measure(mesh, session_.active().positions(), mesh.groups[0].members);
  }
};

TEST_F(InterfacesInASession, CellDataThatAreNamedStayNamed) {
  const test::TemporaryFolder folder;
  Mesh mesh = testing::lattice(4, 0.3, 1, testing::Cells::Quadrilaterals);
  mesh.fields.push_back({.name = "my zones", .on = Field::On::Elements, .components = 1, .type = "int", .role = "", .values = {}});
  for (Index e = 0; e < mesh.elements.size(); ++e) mesh.fields.back().values.push_back(e % 4 < 2 ? 1.0 : 2.0);
  Progress progress;
  const std::string file = (folder.path() / "zones.vtk").string(), saved = (folder.path() / "zones.dmoscope").string();
  (void)write_mesh(file, mesh, mesh.positions, progress);
  say("open " + file);
  const std::string offered = session_.input()->interfaces.offers("materials").at(0);
  EXPECT_THAT(messages_, Contains(HasSubstr(offered)));
  const std::string name = session_.input()->mesh.fields.at(0).name;
  say("run 2");
  const Vec3 moved = session_.active().positions()[12];
  say("materials " + quote_word(name));
  EXPECT_EQ(session_.input()->interfaces.count(), 3U);
  say("run 2");
  EXPECT_EQ(session_.active().positions()[12], session_.input()->mesh.positions[12]);
  say("save-state " + saved);
  say("reload");
  EXPECT_EQ(session_.input()->interfaces.count(), 3U);
  say("generate grid 16");
  say("open-state " + saved);
  EXPECT_EQ(session_.input()->interfaces.count(), 3U);
  EXPECT_EQ(session_.active().positions()[12], session_.input()->mesh.positions[12]);
  EXPECT_TRUE(fails("materials nothing"));
  EXPECT_EQ(session_.input()->interfaces.count(), 3U);
  say("materials");
  EXPECT_EQ(session_.input()->interfaces.count(), 0U);
  say("run 2");
  EXPECT_EQ(session_.active().positions()[12], moved);
}

TEST_F(InterfacesInASession, TheInnerMaterialKeepsItsSizeUnlessInterfacesAreFree) {
  const std::vector<std::pair<std::string, double>> meshes{{"nested 400 2", 81.0}, {"nested-solids 343 2", 64.0}};
  for (const auto& [words, size] : meshes) {
    for (const std::string method : {"dmo", "laplace"}) {
      SCOPED_TRACE(words + " " + method);
      messages_.clear();
      say("generate " + words);
      EXPECT_THAT(messages_, Contains(HasSubstr("on the interface between groups stay ('interfaces free' moves them)")));
      say("method " + method);
      ASSERT_NEAR(inner(), size, 1e-9);
      const double before = inner();
      say("run 5");
      EXPECT_NEAR(inner(), before, 1e-12 * before);
      EXPECT_GT(session_.active().history().records()[1].moved, 0U);
      for (Index v = 0; v < session_.input()->mesh.vertex_count(); ++v) {
        if (!session_.input()->interfaces.holds(v)) continue;
        ASSERT_EQ(session_.active().positions()[v], session_.input()->mesh.positions[v]);
        ASSERT_EQ(session_.active().why_fixed(v), "it lies on the interface between \"inner\" and \"outer\", which stays");
      }
      say("interfaces free");
      EXPECT_THAT(session_.active().title(), HasSubstr("interfaces free"));
      say("run 5");
      EXPECT_GT(std::abs(inner() - before), 1e-3);
    }
  }
}

TEST_F(InterfacesInASession, WhyFixedKeepsEachReason) {
  say("generate nested 100 1");
  const Index on_interface = 2 + 10 * 2, on_boundary = 0, by_hand = 4 + 10 * 4, free = 5 + 10 * 5;
  say("fix " + std::to_string(by_hand));
  const auto why = [&](Index v) { return session_.active().why_fixed(v); };
  EXPECT_THAT(why(on_interface), HasSubstr("interface"));
  EXPECT_EQ(why(on_boundary), "it lies on the boundary, which stays");
  EXPECT_EQ(why(by_hand), "it was fixed by hand");
  EXPECT_EQ(why(free), "");
  EXPECT_TRUE(fails("visit " + std::to_string(on_interface)));
  say("fix " + std::to_string(on_interface));
  say("interfaces free");
  EXPECT_EQ(why(on_interface), "it was fixed by hand");
  say("unfix");
  EXPECT_EQ(why(on_interface), "");
  say("generate nested 100 2");
  EXPECT_EQ(interfaces(), "fixed") << "another mesh has interfaces of its own";
}

TEST_F(InterfacesInASession, FixTakesTheWordsOfTheCommandLine) {
  say("generate nested 100 1");
  const auto fixed = [&] { return session_.active().parameters().fixed.size(); };
  say("fix group:inner");
  EXPECT_EQ(fixed(), 36U);
  say("unfix");
  say("fix material=1 box:0,0,1.5,1.5 \"vertices:3,50-52\"");
  EXPECT_EQ(fixed(), 43U);
  EXPECT_TRUE(fails("fix 1")) << "a vertex, or the group of this number";
  EXPECT_TRUE(fails("fix group:middle"));
  EXPECT_TRUE(fails("interfaces up"));
  EXPECT_EQ(fixed(), 43U);
}

TEST_F(InterfacesInASession, StateFilesKeepTheRuleAndThoseFromBeforeItHaveFreeOnes) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "a.dmoscope").string();
  say("generate nested 100 1");
  say("interfaces free");
  say("run 2");
  const std::vector<Vec3> moved(session_.active().positions().begin(), session_.active().positions().end());
  say("save-state " + file);
  say("generate nested 100 1");
  say("open-state " + file);
  EXPECT_EQ(interfaces(), "free");
  EXPECT_TRUE(std::ranges::equal(session_.active().positions(), moved));
  auto json = nlohmann::ordered_json::parse(std::ifstream(file));
  json["version"] = 1;  // also from before there were checksums
  json.erase("checksums");
  json["runs"][0].erase("checksums");
  auto& parameters = json["runs"][0]["parameters"];
  ASSERT_EQ(parameters["interfaces"], "free");
  parameters.erase("interfaces");
  std::ofstream(file) << json;
  say("open-state " + file);
  EXPECT_EQ(interfaces(), "free");
  parameters["interfaces"] = "sliding";
  std::ofstream(file) << json;
  EXPECT_TRUE(fails("open-state " + file));
}

TEST_F(InterfacesInASession, TheInputIsJudgedByWhatStaysInTheActiveRun) {
  // A square of bad elements whose corners all lie on the interface: they can move only if that is free.
  Mesh mesh = testing::lattice(5, 0.0, 1, testing::Cells::Quadrilaterals);
  mesh.groups = {{.name = "core", .role = "physical group", .code = 1, .dimension = 2, .members = {12}}};
  for (const Index v : {14U, 15U}) mesh.positions[v] = mesh.positions[v] + Vec3{v == 14U ? 0.08 : -0.08, 0.0, 0.0};
  session_.open(mesh, progress_);
  FrameBuilder builder;
  const std::vector<Watch> input{{Watch::kInput, std::nullopt}};
  const auto ceiling = [&] { return builder.build(session_, FrameDetail::Whole, input)->watched.at(0).frame->statistics.ceiling; };
  ASSERT_EQ(session_.active().immovable().size(), 1U);
  EXPECT_EQ(ceiling(), session_.active().statistics().ceiling);
  EXPECT_LT(ceiling(), 1.0);
  say("interfaces free");
  EXPECT_EQ(session_.active().immovable().size(), 0U);
  EXPECT_TRUE(std::isinf(ceiling()));
}

// --- Through the formats ---

/// Writes the text to a file of this name and reads it as a mesh to smooth.
std::shared_ptr<const InputMesh> loaded(const std::string& name, const std::string& text) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / name;
  std::ofstream(path) << text;
  Progress progress;
  return load_input(path, Need::Smoothing, progress);
}

Index count_held(const InputMesh& input) {
  Index count = 0;
  for (Index v = 0; v < input.mesh.vertex_count(); ++v) count += input.interfaces.holds(v) ? 1 : 0;
  EXPECT_EQ(count, input.interfaces.count());
  return count;
}

TEST(InterfacesInFiles, GroupsAndValuesComeThroughEveryFormatThatHoldsThem) {
  const test::TemporaryFolder folder;
  Progress progress;
  for (const std::string kind : {"nested", "nested-solids"}) {
    const Mesh mesh = generate_mesh(kind, kind == "nested" ? 100 : 216, 1, progress);
    for (const FormatInfo& format : format_table()) {
      const std::string_view name = format.name;
      if (name != "gmsh" && name != "medit" && name != "vtk" && name != "vtu") continue;
      const auto path = folder.path() / ("a" + std::string(format.extensions.substr(0, format.extensions.find(' '))));
      (void)write_mesh(path, mesh, mesh.positions, progress);
      const auto input = load_input(path, Need::Smoothing, progress);
      EXPECT_EQ(count_held(*input), kind == "nested" ? 20U : 56U) << path;
      EXPECT_EQ(input->interfaces.count(name.starts_with("vt") ? HeldBy::Values : HeldBy::Groups), kind == "nested" ? 20U : 56U) << path;
    }
  }
}

/// 2 x 2 squares in MSH 4.1: two surfaces, 1 and 2, left and right, with the line between them, and with physical groups if `physical`.
std::string gmsh_4(bool physical) {
  const std::string surfaces = physical ? "1 0 0 0 1 2 0 1 11 0\n2 0 0 0 1 2 0 1 12 0\n" : "1 0 0 0 1 2 0 0 0\n2 0 0 0 1 2 0 0 0\n";
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 2 0\n" + surfaces + "$EndEntities\n$Nodes\n1 9 1 9\n2 1 0 9\n";
  for (int v = 1; v <= 9; ++v) text += std::to_string(v) + "\n";
  for (int v = 0; v < 9; ++v) text += std::to_string(v % 3) + " " + std::to_string(v / 3) + " 0\n";
  return text + "$EndNodes\n$Elements\n2 4 1 4\n2 1 3 2\n1 1 2 5 4\n2 4 5 8 7\n2 2 3 2\n3 2 3 6 5\n4 5 6 9 8\n$EndElements\n";
}

TEST(InterfacesInFiles, GmshVersion4) {
  const auto physical = loaded("a.msh", gmsh_4(true));
  EXPECT_EQ(physical->interfaces.why(4), "it lies on the interface between \"physical 11\" and \"physical 12\", which stays");
  const auto entities = loaded("a.msh", gmsh_4(false));
  EXPECT_EQ(entities->interfaces.why(4), "it lies on the interface between gmsh:geometrical 1 and 2, which stays");
}

TEST(InterfacesInFiles, LinesAndPointsOfGmshAndMedit) {
  std::string msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 3 \"crack\"\n$EndPhysicalNames\n$Nodes\n9\n";
  for (int v = 0; v < 9; ++v) msh += std::to_string(v + 1) + " " + std::to_string(v % 3) + " " + std::to_string(v / 3) + " 0\n";
  msh +=
      "$EndNodes\n$Elements\n5\n1 1 2 3 3 2 5\n2 3 2 1 1 1 2 5 4\n3 3 2 1 1 2 3 6 5\n4 3 2 1 1 4 5 8 7\n5 3 2 1 1 5 6 9 8\n$EndElements\n";
  EXPECT_EQ(loaded("a.msh", msh)->interfaces.why(4), "it lies on the line \"crack\", which stays");

  std::string medit = "MeshVersionFormatted 2\nDimension 2\nVertices 9\n";
  for (int v = 0; v < 9; ++v) medit += std::to_string(v % 3) + " " + std::to_string(v / 3) + " 0\n";
  medit += "Quadrilaterals 4\n1 2 5 4 1\n2 3 6 5 1\n4 5 8 7 1\n5 6 9 8 1\n";
  EXPECT_FALSE(loaded("a.mesh", medit + "End\n")->interfaces.any());
  EXPECT_EQ(loaded("a.mesh", medit + "Edges 1\n2 5 7\nEnd\n")->interfaces.why(4), "it lies on the line \"reference 7\", which stays");
  EXPECT_EQ(loaded("a.mesh", medit + "Edges 1\n2 5 0\nRidges 1\n1\nEnd\n")->interfaces.count(HeldBy::Lines), 1U);
  for (const std::string mark : {"RequiredVertices", "Corners"})
    EXPECT_EQ(loaded("a.mesh", medit + mark + " 1\n5\nEnd\n")->interfaces.why(4), "it is one of the points \"" + mark + "\", which stay");
}

/// 4 x 4 squares; in the middle the vertex 12, between 7, 11, 13 and 17.
std::string medit_squares() {
  std::string text = "MeshVersionFormatted 2\nDimension 2\nVertices 25\n";
  for (int v = 0; v < 25; ++v) text += std::to_string(v % 5) + " " + std::to_string(v / 5) + " 0\n";
  text += "Quadrilaterals 16\n";
  for (int e = 0; e < 16; ++e) {
    const int a = e / 4 * 5 + e % 4 + 1;
    text += std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(a + 6) + " " + std::to_string(a + 5) + " 0\n";
  }
  return text;
}

TEST(InterfacesInFiles, RequiredElementsOfMeditKeepTheirVertices) {
  EXPECT_FALSE(loaded("a.mesh", medit_squares() + "End\n")->interfaces.any());
  const auto input = loaded("a.mesh", medit_squares() + "RequiredQuadrilaterals 1\n6\nEnd\n");  // 7 8 13 12 of the file, from 1
  for (Index v = 0; v < 25; ++v) EXPECT_EQ(input->interfaces.holds(v), v == 6 || v == 7 || v == 11 || v == 12) << v;
  EXPECT_EQ(input->interfaces.why(6), "it lies on a face of \"RequiredQuadrilaterals\", which stays");
  EXPECT_EQ(input->interfaces.sentence("x"), "4 vertices on faces that the file names stay (x moves them)");
  EXPECT_EQ(input->interfaces.count(HeldBy::Groups), 0U) << "they are no material of their own";
}

/// 2 x 2 x 2 hexahedra and, of VTK's cells, one more; the vertex 13 is in the middle.
std::string vtk_cubes(const std::string& cell, int size, int type) {
  std::string text = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 27 double\n";
  for (int v = 0; v < 27; ++v) text += std::to_string(v % 3) + " " + std::to_string(v / 3 % 3) + " " + std::to_string(v / 9) + "\n";
  text += "CELLS 9 " + std::to_string(72 + 1 + size) + "\n";
  for (int e = 0; e < 8; ++e) {
    const int a = e % 2 + e / 2 % 2 * 3 + e / 4 * 9;
    text += "8";
    for (const int step : {0, 1, 4, 3, 9, 10, 13, 12}) text += " " + std::to_string(a + step);
    text += "\n";
  }
  text += std::to_string(size) + " " + cell + "\nCELL_TYPES 9\n12 12 12 12 12 12 12 12 " + std::to_string(type) + "\n";
  return text;
}

TEST(InterfacesInFiles, CellsOfFewerDimensionsInVtk) {
  const auto sentence = [](const std::string& name, const std::string& text) {
    const std::string whole = loaded(name, text)->interfaces.sentence("x");
    return whole.substr(0, whole.find("; no vertex is left"));
  };
  EXPECT_EQ(sentence("a.vtk", vtk_cubes("10 13 16", 3, 5)), "1 vertex on faces that the file names stays (x moves it)");
  EXPECT_EQ(sentence("a.vtk", vtk_cubes("12 13", 2, 3)), "1 vertex on lines that the file names stays (x moves it)");
  EXPECT_EQ(sentence("a.vtk", vtk_cubes("4 13 22", 3, 4)), "1 vertex on lines that the file names stays (x moves it)");
  EXPECT_EQ(sentence("a.vtk", vtk_cubes("13", 1, 1)), "1 vertex named by the file as points stays (x moves it)");
  EXPECT_EQ(sentence("a.vtk", vtk_cubes("0 1 4 3", 4, 9)), "") << "a face of the boundary holds nothing";

  // In a planar mesh the lines are between, and triangles are elements.
  std::string planar = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n0 0 0 2 0 0 2 2 0 0 2 0 1 1 0\n";
  const std::string triangles = "POLYGONS 4 16\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  EXPECT_EQ(sentence("a.vtk", planar + triangles), "");
  EXPECT_EQ(sentence("a.vtk", planar + "LINES 1 4\n3 0 4 2\n" + triangles), "1 vertex on lines that the file names stays (x moves it)");
  // A vertex cell for every point, as viewers write them, names nothing.
  EXPECT_EQ(sentence("a.vtk", planar + "VERTICES 1 6\n5 0 1 2 3 4\n" + triangles),
            "1 vertex is named only in lists of all lines, faces or points there are; such lists hold nothing");

  const std::string vtu =
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"5\" NumberOfCells=\"5\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
      "0 0 0 2 0 0 2 2 0 0 2 0 1 1 0</DataArray></Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">"
      "0 1 4 1 2 4 2 3 4 3 0 4 1 4</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 6 9 12 14</DataArray>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5 5 5 "
      "3</DataArray></Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  EXPECT_EQ(sentence("a.vtu", vtu), "1 vertex on lines that the file names stays (x moves it)");
}

TEST(InterfacesInFiles, WeirsAndOpenBoundariesOfFort14AndMarkersOfSu2) {
  std::string grid = "t\n4 9\n";
  for (int v = 0; v < 9; ++v) grid += std::to_string(v + 1) + " " + std::to_string(v % 3) + " " + std::to_string(v / 3) + " 5\n";
  grid += "1 4 1 2 5 4\n2 4 2 3 6 5\n3 4 4 5 8 7\n4 4 5 6 9 8\n";
  EXPECT_EQ(loaded("a.14", grid + "1\n2\n2\n2\n5\n0\n0\n")->interfaces.why(4), "it lies on \"open boundary 1\", which stays");
  EXPECT_EQ(loaded("a.14", grid + "0\n0\n1\n2\n2 13\n2 1.5 1.0\n5 1.5 1.0\n")->interfaces.why(4),
            "it lies on \"land boundary 1\", which stays");

  for (const std::string weir : {"4\n2 5 1.5 1 1\n", "24\n2 5 1.5 1 1\n", "5\n2 5 1.5 1 1 1 1 1\n", "25\n2 5 1.5 1 1 1 1 1\n"}) {
    const auto input = loaded("a.14", grid + "0\n0\n1\n2\n1 " + weir);
    EXPECT_EQ(input->interfaces.why(4), "it lies on \"land boundary 1, far side\", which stays") << weir;
    EXPECT_THAT(input->interfaces.sentence("x"), ::testing::StartsWith("1 vertex on boundary strings stays (x moves it)"));
  }

  std::string su2 = "NDIME= 2\nNELEM= 4\n9 0 1 4 3\n9 1 2 5 4\n9 3 4 7 6\n9 4 5 8 7\nNPOIN= 9\n";
  for (int v = 0; v < 9; ++v) su2 += std::to_string(v % 3) + " " + std::to_string(v / 3) + "\n";
  EXPECT_EQ(loaded("a.su2", su2 + "NMARK= 1\nMARKER_TAG= disk\nMARKER_ELEMS= 2\n3 1 4\n3 4 7\n")->interfaces.why(4),
            "it lies on the line \"disk\", which stays");
}

}  // namespace
}  // namespace dmoscope
