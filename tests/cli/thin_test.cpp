// Meshes one cell thick are smoothed as 2-D meshes, and written with their cells.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "tests/support/meshes.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using Place = std::function<Vec3(Vec3)>;

/// The sheet's vertex v is 2 v in front and 2 v + 1 behind, so that no number tells the sides apart.
std::string solid_vtk(const Mesh& sheet, const Place& front, const Place& back) {
  std::string points, cells, types, materials, heat;
  std::size_t words = 0;
  for (const Vec3 p : sheet.positions)
    for (const Vec3 q : {front(p), back(p)}) {
      points += fmt::format("{:.17g} {:.17g} {:.17g}\n", q.x, q.y, q.z);
      heat += fmt::format("{:.17g}\n", 1.0 + 2.0 * q.x - 3.0 * q.y + 5.0 * q.z);
    }
  for (Index e = 0; e < sheet.elements.size(); ++e) {
    std::vector<Index> corners(sheet.elements.corners(e).begin(), sheet.elements.corners(e).end());
    const bool wedge = corners.size() == 3;
    if (wedge) std::swap(corners[1], corners[2]);  // VTK's wedges are wound the other way
    cells += fmt::format("{}", 2 * corners.size());
    for (const Index side : {0U, 1U})
      for (const Index v : corners) cells += fmt::format(" {}", 2 * v + side);
    cells += '\n';
    types += wedge ? "13\n" : "12\n";
    materials += sheet.positions[corners[0]].x + sheet.positions[corners[1]].x + sheet.positions[corners[2]].x < 1.5 ? "1\n" : "2\n";
    words += 1 + 2 * corners.size();
  }
  const std::size_t n = 2 * sheet.positions.size(), m = sheet.elements.size();
  return fmt::format(
      "# vtk DataFile Version 3.0\nthin\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n{}CELLS {} {}\n{}CELL_TYPES {}\n{}"
      "CELL_DATA {}\nSCALARS colour int 1\nLOOKUP_TABLE default\n{}POINT_DATA {}\nSCALARS heat double 1\nLOOKUP_TABLE default\n{}",
      n, points, m, words, cells, m, types, m, materials, n, heat);
}

std::string sheet_vtk(const Mesh& sheet) {
  std::string points, cells, types;
  std::size_t words = 0;
  for (const Vec3 p : sheet.positions) points += fmt::format("{:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
  for (Index e = 0; e < sheet.elements.size(); ++e) {
    const auto corners = sheet.elements.corners(e);
    cells += fmt::format("{} {}\n", corners.size(), fmt::join(corners, " "));
    types += corners.size() == 3 ? "5\n" : "9\n";
    words += 1 + corners.size();
  }
  const std::size_t n = sheet.positions.size(), m = sheet.elements.size();
  return fmt::format(
      "# vtk DataFile Version 3.0\nflat\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n{}CELLS {} {}\n{}CELL_TYPES {}\n{}", n, points,
      m, words, cells, m, types);
}

Vec3 as_it_is(Vec3 p) { return p; }
Place behind_by(double thickness) {
  return [thickness](Vec3 p) { return Vec3{p.x, p.y, p.z + thickness}; };
}

/// The numbers after a line that begins with `line`.
std::vector<double> numbers_behind(const std::string& file, const std::string& line, std::size_t count) {
  const std::string text = read_file(file);
  std::size_t at = text.find(line);
  if (at == std::string::npos) throw std::out_of_range("no " + line);
  at = text.find('\n', at) + 1;
  std::istringstream in(text.substr(at));
  std::vector<double> numbers(count);
  for (double& x : numbers) in >> x;
  return numbers;
}

std::vector<Vec3> points_of(const std::string& file, std::size_t count) {
  const std::vector<double> numbers = numbers_behind(file, "POINTS", 3 * count);
  std::vector<Vec3> points(count);
  for (std::size_t v = 0; v < count; ++v) points[v] = {numbers[3 * v], numbers[3 * v + 1], numbers[3 * v + 2]};
  return points;
}

/// The file without its points and the data at them.
std::string but_for_points(const std::string& file) {
  const std::string text = read_file(file);
  const std::size_t cells = text.find("CELLS");
  return text.substr(0, text.find("POINTS")) + text.substr(cells, text.find("LOOKUP_TABLE default", text.find("SCALARS heat")) - cells);
}

Mesh mixed_sheet() { return testing::lattice(8, 0.35, 3, testing::Cells::Mixed); }

TEST(ThinOnTheCommandLine, IsSmoothedAsTheFlatMeshThatItIs) {
  const Folder folder;
  const Mesh sheet = mixed_sheet();
  const std::string solid = folder.file("solid.vtk", solid_vtk(sheet, as_it_is, behind_by(0.1))), out = folder / "out.vtk";
  const auto thick = smooth(solid, out, {"--until-converged", "--hints", "off"});
  const auto flat = smooth(folder.file("flat.vtk", sheet_vtk(sheet)), folder / "flat-out.vtk", {"--until-converged", "--hints", "off"});
  EXPECT_EQ(thick["thin"], true);
  EXPECT_EQ(flat["thin"], false);
  EXPECT_EQ(thick["before"], flat["before"]);
  EXPECT_EQ(thick["after"], flat["after"]);
  EXPECT_GT(thick["after"]["minimum"].get<double>(), thick["before"]["minimum"].get<double>() + 0.1);
  const std::size_t n = sheet.positions.size();
  const auto points = points_of(out, 2 * n), front = points_of(folder / "flat-out.vtk", n);
  for (std::size_t v = 0; v < n; ++v) {
    EXPECT_EQ(points[2 * v], front[v]) << v;
    EXPECT_EQ(points[2 * v + 1], (Vec3{front[v].x, front[v].y, 0.1})) << v;
  }
  EXPECT_EQ(but_for_points(out), but_for_points(solid));
}

TEST(ThinOnTheCommandLine, FieldsAreTakenAnewInFrontAndBehind) {
  const Folder folder;
  const Mesh sheet = mixed_sheet();
  const std::string solid = folder.file("solid.vtk", solid_vtk(sheet, as_it_is, behind_by(0.1))), out = folder / "out.vtk";
  (void)smooth(solid, out, {"--hints", "off"});
  const std::size_t n = 2 * sheet.positions.size();
  const std::string text = read_file(out);
  const std::string rows = text.substr(text.find('\n', text.find("LOOKUP_TABLE default", text.find("SCALARS heat"))) + 1);
  std::istringstream in(rows);
  const auto points = points_of(out, n);
  for (const Vec3 p : points) {
    double heat = 0.0;
    in >> heat;
    EXPECT_NEAR(heat, 1.0 + 2.0 * p.x - 3.0 * p.y + 5.0 * p.z, 1e-12);
  }
}

TEST(ThinOnTheCommandLine, ItIsSaidAndCanBeTurnedOff) {
  const Folder folder;
  const Mesh sheet = mixed_sheet();
  const std::string solid = folder.file("solid.vtk", solid_vtk(sheet, as_it_is, behind_by(0.1))), out = folder / "out.vtk";
  for (const auto& words : {std::vector<std::string>{"info", solid}, {"quality", solid}, {"smooth", solid, "-o", out}}) {
    EXPECT_THAT(run(words).err, HasSubstr("one cell thick, and judged and smoothed as the 2-D mesh of its front"));
  }
  EXPECT_THAT(run({"info", solid}).out, HasSubstr("hexahedra")) << "the file's cells";
  EXPECT_EQ(json_of(run({"info", solid, "--json"}))["thin"], true);
  const auto off = smooth(solid, out, {"--thin", "off", "--hints", "off"});
  EXPECT_EQ(off["thin"], false);
  EXPECT_EQ(read_file(out), read_file(solid)) << "all of its vertices are on the boundary";
  EXPECT_EQ(run({"quality", solid, "--thin", "maybe"}).code, 2);
}

TEST(ThinOnTheCommandLine, TwoCellsThickIsAVolume) {
  const Folder folder;
  ASSERT_EQ(run({"generate", "hexahedra", "--size", "200", "-o", folder / "cube.vtk"}).code, 0);
  const auto json = smooth(folder / "cube.vtk", folder / "auto.vtk", {"--hints", "off"});
  EXPECT_EQ(json["thin"], false);
  (void)smooth(folder / "cube.vtk", folder / "off.vtk", {"--hints", "off", "--thin", "off"});
  EXPECT_EQ(read_file(folder / "auto.vtk"), read_file(folder / "off.vtk"));
  const Output on = run({"quality", folder / "cube.vtk", "--thin", "on"});
  EXPECT_EQ(on.code, 3);
  EXPECT_THAT(on.err, HasSubstr("it cannot be taken for a mesh one cell thick (--thin on): cell"));
}

TEST(ThinOnTheCommandLine, MaterialsAndFixedVerticesStayInFrontAndBehind) {
  const Folder folder;
  const Mesh sheet = mixed_sheet();
  const std::string solid = folder.file("solid.vtk", solid_vtk(sheet, as_it_is, behind_by(0.1)));
  const std::size_t n = sheet.positions.size();
  const auto before = points_of(solid, 2 * n);
  const auto stay = [&](const std::vector<std::string>& options, std::size_t v) {
    (void)smooth(solid, folder / "out.vtk", options);
    const auto after = points_of(folder / "out.vtk", 2 * n);
    EXPECT_EQ(after[v] == before[v], after[v ^ 1U] == before[v ^ 1U]);
    return after[v] == before[v];
  };
  const std::size_t inside = 2 * (2 * 9 + 2), between = 2 * (4 * 9 + 4);  // between: the materials meet at the fifth column
  EXPECT_FALSE(stay({"--hints", "off"}, inside));
  EXPECT_TRUE(stay({"--hints", "off", "--fix", fmt::format("{}", inside)}, inside));
  EXPECT_TRUE(stay({"--hints", "off", "--fix", fmt::format("{}", inside + 1)}, inside)) << "by its partner";
  EXPECT_FALSE(stay({"--hints", "off"}, between));
  EXPECT_TRUE(stay({"--hints", "off", "--materials", "colour"}, between));
}

/// A quarter of a tube, triangles.
TEST(ThinOnTheCommandLine, TheBackOfAShellStaysOnItself) {
  const Folder folder;
  const Mesh sheet = testing::lattice(8, 0.3, 5, testing::Cells::Triangles);
  const auto tube = [](double radius) {
    return [radius](Vec3 p) {
      const double angle = 0.5 * std::numbers::pi * p.x;
      return Vec3{radius * std::cos(angle), radius * std::sin(angle), p.y};
    };
  };
  const std::string solid = folder.file("shell.vtk", solid_vtk(sheet, tube(1.0), tube(1.02))), out = folder / "out.vtk";
  const auto json = smooth(solid, out, {"--hints", "off", "--max-deviation", "0.05"});
  EXPECT_EQ(json["thin"], true);
  EXPECT_GT(json["after"]["minimum"].get<double>(), json["before"]["minimum"].get<double>() + 0.05);
  const std::size_t n = sheet.positions.size();
  const auto before = points_of(solid, 2 * n), after = points_of(out, 2 * n);
  std::size_t moved = 0;
  for (std::size_t v = 0; v < 2 * n; ++v) {
    if (after[v] == before[v]) continue;
    ++moved;
    double nearest = 1.0;  // distance to the nearest triangle of its own side above which it lies
    for (Index e = 0; e < sheet.elements.size(); ++e) {
      const auto c = sheet.elements.corners(e);
      const auto at = [&](std::size_t i) { return before[2 * c[i] + v % 2]; };
      const Vec3 across = cross(at(1) - at(0), at(2) - at(0));
      const double area = dot(across, across);
      bool over = true;
      for (std::size_t i = 0; i < 3; ++i) over = over && dot(cross(at((i + 1) % 3) - at(i), after[v] - at(i)), across) > -1e-9 * area;
      if (over) nearest = std::min(nearest, std::abs(dot(after[v] - at(0), across)) / std::sqrt(area));
    }
    EXPECT_LT(nearest, 1e-9) << v;
  }
  EXPECT_GT(moved, n / 2);
}

/// An axisymmetric case: the sides are 5 degrees apart, and on the axis, which both share, cells are wedges on their sides.
std::string turned_vtk(std::size_t n) {
  const auto place = [n](std::size_t i, std::size_t j, double side) {
    const bool inside = i > 0 && j > 0 && i < n && j < n;
    const double along = static_cast<double>(i) + (inside ? 0.3 * std::sin(2.1 * static_cast<double>(i + 3 * j)) : 0.0);
    const double away = static_cast<double>(j) + (inside ? 0.3 * std::cos(1.7 * static_cast<double>(i + 2 * j)) : 0.0);
    const double angle = side * 2.5 * std::numbers::pi / 180.0;
    return Vec3{along, away * std::cos(angle), away * std::sin(angle)};
  };
  const auto number = [n](std::size_t i, std::size_t j, std::size_t side) {
    return j == 0 ? i : (n + 1) + 2 * ((j - 1) * (n + 1) + i) + side;
  };
  std::string points, cells, types;
  std::size_t count = 0, words = 0;
  for (std::size_t j = 0; j <= n; ++j)
    for (std::size_t i = 0; i <= n; ++i)
      for (const double side : {-1.0, 1.0}) {
        if (j == 0 && side > 0.0) continue;
        const Vec3 p = place(i, j, side);
        points += fmt::format("{:.17g} {:.17g} {:.17g}\n", p.x, p.y, p.z);
        ++count;
      }
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<std::size_t> corners;
      if (j == 0) {
        corners = {number(i, 0, 0), number(i, 1, 0), number(i, 1, 1), number(i + 1, 0, 0), number(i + 1, 1, 0), number(i + 1, 1, 1)};
      } else {
        for (const std::size_t side : {0U, 1U})
          for (const std::size_t k : {0U, 1U, 2U, 3U}) corners.push_back(number(i + (k == 1 || k == 2 ? 1 : 0), j + k / 2, side));
      }
      cells += fmt::format("{} {}\n", corners.size(), fmt::join(corners, " "));
      types += corners.size() == 6 ? "13\n" : "12\n";
      words += 1 + corners.size();
    }
  return fmt::format(
      "# vtk DataFile Version 3.0\nturned\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n{}CELLS {} {}\n{}CELL_TYPES {}\n{}", count,
      points, n * n, words, cells, n * n, types);
}

TEST(ThinOnTheCommandLine, SidesThatMeetOnAnAxisStayInTheirPlanes) {
  const Folder folder;
  constexpr std::size_t kCells = 6;
  const std::string in = folder.file("turned.vtk", turned_vtk(kCells)), out = folder / "out.vtk";
  const auto json = smooth(in, out, {"--hints", "off"});
  EXPECT_EQ(json["thin"], true);
  EXPECT_GT(json["after"]["minimum"].get<double>(), json["before"]["minimum"].get<double>() + 0.05);
  const std::size_t axis = kCells + 1, count = axis + 2 * kCells * (kCells + 1);
  const auto before = points_of(in, count), after = points_of(out, count);
  const double slope = std::tan(2.5 * std::numbers::pi / 180.0);
  std::size_t moved = 0;
  for (std::size_t v = axis; v < count; v += 2) {
    moved += after[v] == before[v] ? 0U : 1U;
    EXPECT_NEAR(after[v].z, -slope * after[v].y, 1e-12);
    EXPECT_NEAR(after[v + 1].z, slope * after[v + 1].y, 1e-12);
    EXPECT_NEAR(after[v + 1].x, after[v].x, 1e-12);
    EXPECT_NEAR(after[v + 1].y, after[v].y, 1e-12);
  }
  EXPECT_EQ(moved, (kCells - 1) * (kCells - 1));
}

/// Gmsh 2.2, with names for front, back, the inlet between them, and two materials.
std::string named_msh(const Mesh& sheet, std::size_t n) {
  const Index count = sheet.vertex_count();
  std::string nodes, elements;
  for (const double z : {0.0, 0.1})
    for (Index v = 0; v < count; ++v)
      nodes += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", v + 1 + (z > 0.0 ? count : 0), sheet.positions[v].x, sheet.positions[v].y, z);
  std::size_t number = 0;
  const auto add = [&](int type, int name, const std::vector<Index>& corners) {
    elements += fmt::format("{} {} 2 {} {}", ++number, type, name, name);
    for (const Index v : corners) elements += fmt::format(" {}", v + 1);
    elements += '\n';
  };
  for (Index j = 0; j < n; ++j) {
    const auto a = static_cast<Index>(j * (n + 1)), b = static_cast<Index>((j + 1) * (n + 1));
    add(3, 3, {a, b, b + count, a + count});
  }
  for (const Index side : {0U, count})
    for (Index e = 0; e < sheet.elements.size(); ++e) {
      std::vector<Index> corners(sheet.elements.corners(e).begin(), sheet.elements.corners(e).end());
      for (Index& v : corners) v += side;
      add(corners.size() == 4 ? 3 : 2, side == 0 ? 1 : 2, corners);
    }
  for (Index e = 0; e < sheet.elements.size(); ++e) {
    std::vector<Index> corners(sheet.elements.corners(e).begin(), sheet.elements.corners(e).end());
    const double x = sheet.positions[corners[0]].x + sheet.positions[corners[1]].x + sheet.positions[corners[2]].x;
    for (std::size_t i = 0, own = corners.size(); i < own; ++i) corners.push_back(corners[i] + count);
    add(corners.size() == 8 ? 5 : 6, x < 1.5 ? 4 : 5, corners);
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n2 1 \"front\"\n2 2 \"back\"\n2 3 \"inlet\"\n3 4 \"steel\"\n3 5 \"air\"\n"
      "$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      2 * count, nodes, number, elements);
}

TEST(ThinOnTheCommandLine, NamesOfSidesAndCellsStayInTheFile) {
  const Folder folder;
  constexpr std::size_t kCells = 8;
  const Mesh sheet = mixed_sheet();
  const std::string in = folder.file("named.msh", named_msh(sheet, kCells)), out = folder / "out.msh";
  const auto json = smooth(in, out, {"--hints", "off"});
  EXPECT_EQ(json["thin"], true);
  const std::size_t n = sheet.positions.size();
  const auto before = lines_of(read_file(in)), after = lines_of(read_file(out));
  ASSERT_EQ(after.size(), before.size());
  const auto first = static_cast<std::size_t>(std::ranges::find(before, "$Nodes") - before.begin()) + 2;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const bool front = i >= first && i < first + n, back = i >= first + n && i < first + 2 * n;
    const std::size_t v = front ? i - first : i - first - n, column = v % (kCells + 1), row = v / (kCells + 1);
    const bool inside = row > 0 && row < kCells && column > 0 && column < kCells;
    // The materials meet at the middle column.
    EXPECT_EQ(before[i] == after[i], !((front || back) && inside && column != kCells / 2)) << before[i] << " " << after[i];
    if (back) {
      const auto here = split(after[i], ' '), there = split(after[i - n], ' ');
      EXPECT_EQ(here.at(1), there.at(1));
      EXPECT_EQ(here.at(2), there.at(2));
      EXPECT_EQ(std::stod(here.at(3)), 0.1);
    }
  }
  (void)smooth(in, folder / "held.msh", {"--hints", "off", "--fix", "group:back"});
  EXPECT_EQ(read_file(folder / "held.msh"), read_file(in));
  EXPECT_EQ(smooth(in, out, {"--hints", "off", "--fix", "group:inlet"})["parameters"]["fixed_by_user"], kCells + 1);
  EXPECT_EQ(json_of(run({"info", in, "--json"}))["groups"].size(), 5U);
  ASSERT_EQ(run({"smooth", in, "-o", folder / "out.vtu", "--hints", "off"}).code, 0);
  EXPECT_EQ(json_of(run({"info", folder / "out.vtu", "--json"}))["kinds"], json_of(run({"info", in, "--json"}))["kinds"]);
}

TEST(ThinOnTheCommandLine, SessionsComeBackAsTheyWere) {
  const Folder folder;
  const Mesh sheet = mixed_sheet();
  const std::string solid = folder.file("solid.vtk", solid_vtk(sheet, as_it_is, behind_by(0.1))), state = folder / "s.json";
  const auto script = [&](const std::string& name, const std::string& lines) { return run({"script", folder.file(name, lines)}); };
  ASSERT_EQ(script("one.txt", "open " + solid + "\nstep iteration 3\nexport " + (folder / "a.vtk") + "\nsave-state " + state + "\n").code,
            0);
  ASSERT_EQ(script("two.txt", "thin off\nopen-state " + state + "\nexport " + (folder / "b.vtk") + "\nreload\nstep iteration 3\nexport " +
                                  (folder / "c.vtk") + "\n")
                .code,
            0);
  EXPECT_NE(read_file(folder / "a.vtk"), read_file(solid));
  EXPECT_EQ(read_file(folder / "b.vtk"), read_file(folder / "a.vtk"));
  EXPECT_EQ(read_file(folder / "c.vtk"), read_file(folder / "a.vtk"));
  ASSERT_EQ(script("three.txt", "thin off\nopen " + solid + "\nstep iteration 3\nexport " + (folder / "d.vtk") + "\n").code, 0);
  EXPECT_EQ(read_file(folder / "d.vtk"), read_file(solid));
}

TEST(ThinOnTheCommandLine, OnAnotherSurfaceItsCellsCount) {
  const Folder folder;
  const std::string solid = folder.file("solid.vtk", solid_vtk(mixed_sheet(), as_it_is, behind_by(0.1)));
  const auto json = smooth(solid, folder / "out.vtk", {"--surface", solid, "--boundary", "slide", "--hints", "off"});
  EXPECT_EQ(json["thin"], false);
  EXPECT_EQ(run({"script", folder.file("one.txt", "thin off\nopen " + solid + "\nthin auto\nsurface " + solid + "\n")}).code, 0);
}

TEST(ThinOnTheCommandLine, PicturesAreOfTheFront) {
  const Folder folder;
  const std::string solid = folder.file("solid.vtk", solid_vtk(mixed_sheet(), as_it_is, behind_by(0.1)));
  const Output front = run({"render", solid, "-o", folder / "a.png", "--size", "200x150"});
  if (cannot_draw(front)) GTEST_SKIP() << front.err;
  EXPECT_EQ(front.code, 0) << front.err;
  EXPECT_EQ(run({"render", solid, "-o", folder / "b.png", "--size", "200x150", "--thin", "off"}).code, 0);
  EXPECT_NE(read_file(folder / "a.png"), read_file(folder / "b.png"));
}

}  // namespace
}  // namespace dmoscope::test
