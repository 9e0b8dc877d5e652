#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/base/number_in.h"
#include "core/io/arrays/array_file.h"
#include "core/io/format_choice.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

constexpr std::size_t kHeadBytes = 65536;  // size in bytes

/// Begin of a file, for the tests below.
struct Head {
  std::string_view bytes;               // first bytes of the file
  std::string_view extension;           // extension, such as ".msh"
  std::vector<std::string_view> lines;  // first lines that are not empty, without surrounding blanks

  explicit Head(std::string_view file, std::string_view of) : bytes(file.substr(0, kHeadBytes)), extension(of) {
    constexpr std::size_t kMostLines = 4096;
    std::string_view rest = bytes;
    while (!rest.empty() && lines.size() < kMostLines) {
      const std::string_view line = trimmed(take_line(rest));
      if (!line.empty()) lines.push_back(line);
    }
  }
  [[nodiscard]] std::string_view line(std::size_t i) const { return i < lines.size() ? lines[i] : std::string_view(); }
  /// Whether one of the lines begins like this, in whatever case.
  [[nodiscard]] bool has_line(std::string_view begin) const {
    return std::ranges::any_of(lines, [&](std::string_view line) { return equal_ignoring_case(line.substr(0, begin.size()), begin); });
  }
  [[nodiscard]] bool is(std::string_view one) const { return equal_ignoring_case(extension, one); }
};

bool begins(std::string_view text, std::string_view with) { return equal_ignoring_case(text.substr(0, with.size()), with); }

bool all_whole(std::span<const std::string_view> some) {
  return std::ranges::all_of(some, [](std::string_view word) { return number_in<long>(word).value_or(-1) >= 0; });
}

/// Recognises FreeFEM, by "112 178 44": vertices, triangles, edges; then x, y and a label on each line.
bool is_freefem(const Head& h) {
  if (!h.is(".msh") && !h.is(".mesh")) return false;
  const auto counts = words_of(h.line(0)), vertex = words_of(h.line(1));
  return counts.size() == 3 && all_whole(counts) && (vertex.size() == 3 || vertex.size() == 4) &&
         number_in<long>(vertex.back()).has_value();
}

bool is_tecplot(const Head& h) {
  if (h.bytes.starts_with("#!TDV")) return true;
  const auto sets = [&](std::string_view word) {
    return begins(h.line(0), word) && trimmed(h.line(0).substr(word.size())).starts_with('=');
  };
  return sets("TITLE") || sets("VARIABLES") || (begins(h.line(0), "ZONE ") && h.line(0).find('=') != std::string_view::npos);
}

/// Recognises AVS UCD: behind comments, five counts.
bool is_ucd(const Head& h) {
  if (!h.is(".inp") && !h.is(".avs")) return false;
  for (const std::string_view line : h.lines) {
    if (line.starts_with('#')) continue;
    const auto counts = words_of(line);
    return counts.size() == 5 && all_whole(counts);
  }
  return false;
}

bool is_gid(const Head& h) {
  return std::ranges::any_of(h.lines, [](std::string_view line) {
    const auto some = words_of(line);
    return some.size() >= 3 && equal_ignoring_case(some[0], "MESH") &&
           std::ranges::any_of(some, [](std::string_view word) { return equal_ignoring_case(word, "ElemType"); });
  });
}

/// Recognises Nemoh, a code for waves: "2" and whether the mesh is half of one; then nodes by number.
bool is_nemoh(const Head& h) {
  const auto head = words_of(h.line(0)), first = words_of(h.line(1)), second = words_of(h.line(2));
  return h.is(".dat") && head.size() == 2 && head[0] == "2" && (head[1] == "0" || head[1] == "1") && first.size() == 4 &&
         number_in<long>(first[0]) == 1 && second.size() == 4 && number_in<long>(second[0]) == 2;
}

bool is_fvcom(const Head& h) { return begins(h.line(0), "Node Number") && h.line(0).find('=') != std::string_view::npos; }

/// Recognises a part of a mesh of Elmer: mesh.header, mesh.nodes, mesh.elements, mesh.boundary.
bool is_elmer(const Head& h) {
  const auto first = words_of(h.line(0));
  if (h.is(".header")) return first.size() == 3 && all_whole(first);
  const bool numbered = first.size() >= 4 && number_in<long>(first[0]).has_value() && number_in<long>(first[1]).has_value();
  return numbered && (h.is(".nodes") || h.is(".elements") || h.is(".boundary"));
}

bool is_nastran(const Head& h) {
  return h.has_line("BEGIN BULK") || h.has_line("GRID,") || h.has_line("GRID*") ||
         (h.has_line("GRID ") && (h.has_line("C") || h.has_line("$")));
}

bool is_fluent(const Head& h) {
  const std::string_view first = h.line(0);
  return first.size() > 2 && first.front() == '(' && first[1] >= '0' && first[1] <= '9';
}

bool begins_hdf5(const Head& h) { return is_hdf5(h.bytes); }
bool begins_netcdf(const Head& h) { return is_netcdf_classic(h.bytes); }

constexpr std::string_view kMeshio = "convert it with meshio to .vtu",
                           kOpenFoam = "convert the case with foamToVTK, and open the internal mesh that this writes",
                           kElmer = "'ElmerGrid 2 5' on its folder makes a .vtu of it";

struct Foreign {
  std::string_view name;  // name such as "an MFEM mesh"
  std::string_view advice;
  bool (*is)(const Head&);
  std::string_view read_as = {};  // extension of a reader that may be there, and has then reported an error itself
};

constexpr std::array kForeign{
    Foreign{"an MFEM mesh", "save it from MFEM as VTK (Mesh::PrintVTK)", [](const Head& h) { return begins(h.line(0), "MFEM "); }},
    Foreign{"a FreeFem mesh", "save it from FreeFem as MEDIT: savemesh(Th, \"name.mesh\")", is_freefem},
    Foreign{"a GiD mesh", "export it from GiD as VTK or MEDIT", is_gid},
    Foreign{"a Fluent mesh (ANSYS)", "convert it with ParaView or meshio to .vtu", is_fluent},
    Foreign{"an ANSYS archive (CDB)", "export it from ANSYS as Fluent or CGNS, and convert that with meshio to .vtu",
            [](const Head& h) { return h.has_line("/PREP7") || h.has_line("/COM,ANSYS") || h.has_line("NBLOCK,"); }},
    Foreign{"a CGNS file", "this build of the program was made without HDF5; convert it with ParaView or cgns_to_vtk",
            [](const Head& h) { return (begins_hdf5(h) && h.is(".cgns")) || h.bytes.starts_with("@(#)ADF Database"); }, ".cgns"},
    Foreign{"a MED file (Salome)", kMeshio, [](const Head& h) { return begins_hdf5(h) && h.is(".med"); }, ".med"},
    Foreign{"an HDF5 file (Fluent and others are such; of XDMF, open the .xdmf file)", "convert it with ParaView or meshio to .vtu",
            begins_hdf5},
    Foreign{"a NetCDF file (UGRID and others are such)", "open it in ParaView and save it as .vtu", begins_netcdf},
    Foreign{"a Nemoh mesh", "convert it with meshmagick to .vtp or .stl", is_nemoh},
    Foreign{"an FVCOM grid", "export it from SMS as .2dm", is_fvcom},
    Foreign{"an FEBio model", "open it in FEBio Studio and export it as .vtk", [](const Head& h) { return h.has_line("<febio_spec"); }},
    Foreign{"a GMV file", "open it in ParaView and save it as .vtu", [](const Head& h) { return begins(h.line(0), "gmvinput"); }},
    Foreign{"a UGRID mesh (AFLR)", kMeshio, [](const Head& h) { return h.is(".ugrid"); }},
    Foreign{"a part of an Elmer mesh", kElmer, is_elmer},
    Foreign{"a GAMBIT neutral file", "read it with VTK's vtkGAMBITReader and write it as .vtu",
            [](const Head& h) { return h.line(0).find("CONTROL INFO") != std::string_view::npos; }},
    Foreign{"a 3MF model", "save it from the program that made it, or from MeshLab, as .stl or .ply",
            [](const Head& h) { return h.is(".3mf") && h.bytes.starts_with("PK\x03\x04"); }},
    Foreign{"a Tecplot file", "convert it with ParaView or meshio to .vtu", is_tecplot},
    Foreign{"an LS-DYNA keyword file", "convert it with LS-PrePost to Nastran, and that with meshio to .vtu",
            [](const Head& h) { return h.has_line("*KEYWORD"); }},
    Foreign{"an Abaqus input file", kMeshio,
            [](const Head& h) { return h.has_line("*HEADING") || h.has_line("*NODE") || h.has_line("*PART"); }, ".inp"},
    Foreign{"an AVS UCD file", "name it .avs, and convert it with meshio to .vtu", is_ucd},
    Foreign{"a Nastran bulk data file", kMeshio, is_nastran, ".bdf"},
    Foreign{"an SMS 2dm mesh", "export it from SMS as fort.14 (ADCIRC)", [](const Head& h) { return begins(h.line(0), "MESH2D"); }, ".2dm"},
    Foreign{"a Netgen mesh", "export it from Netgen as Gmsh2",
            [](const Head& h) { return h.line(0) == "mesh3d" || h.line(0) == "mesh2d" || begins(h.line(0), "# Generated by NETGEN"); }},
    Foreign{"a COMSOL mesh", "export it from COMSOL as Nastran, and convert that with meshio to .vtu",
            [](const Head& h) { return begins(h.line(0), "# Created by COMSOL"); }},
    Foreign{"an XDMF file", kMeshio, [](const Head& h) { return h.bytes.find("<Xdmf") != std::string_view::npos; }, ".xdmf"},
    Foreign{"a DOLFIN XML mesh", kMeshio, [](const Head& h) { return h.bytes.find("<dolfin") != std::string_view::npos; }},
    Foreign{"an OpenFOAM file", kOpenFoam,
            [](const Head& h) { return h.is(".foam") || std::ranges::find(h.lines, std::string_view("FoamFile")) != h.lines.end(); }},
    Foreign{"a Gmsh geometry, not a mesh", "run gmsh -2 or gmsh -3 on it",
            [](const Head& h) { return h.is(".geo") || h.is(".geo_unrolled"); }},
    Foreign{"an outline, not a mesh", "run triangle or tetgen on it", [](const Head& h) { return h.is(".poly") || h.is(".smesh"); }},
    Foreign{"a CAD geometry (STEP), not a mesh", "mesh it with Gmsh", [](const Head& h) { return begins(h.line(0), "ISO-10303-21"); }},
    Foreign{"packed by zip", "unpack it first", [](const Head& h) { return h.bytes.starts_with("PK\x03\x04"); }},
    Foreign{"packed by bzip2", "unpack it first", [](const Head& h) { return h.bytes.starts_with("BZh"); }},
    Foreign{"packed by xz", "unpack it first",
            [](const Head& h) {
              return h.bytes.starts_with(
                  "\xfd"
                  "7zXZ");
            }},
    Foreign{"packed by zstd", "unpack it first", [](const Head& h) { return h.bytes.starts_with("\x28\xb5\x2f\xfd"); }},
};

}  // namespace

std::string foreign_folder(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return {};
  const auto has = [&](const char* name) { return std::filesystem::exists(path / name, error); };
  const auto sentence = [](std::string_view name, std::string_view advice) {
    return fmt::format("this folder is {}, which is not read here: {}", name, advice);
  };
  if (has("constant/polyMesh") || has("polyMesh") || (has("points") && has("faces") && has("owner")))
    return sentence("a mesh of OpenFOAM", kOpenFoam);
  return has("mesh.header") && has("mesh.nodes") ? sentence("a mesh of Elmer", kElmer) : std::string();
}

std::string foreign_format(std::string_view bytes, std::string_view extension) {
  const Head head(bytes, extension);
  for (const Foreign& foreign : kForeign) {
    if (!foreign.read_as.empty() && format_by_extension(foreign.read_as) != nullptr) continue;
    if (foreign.is(head)) return fmt::format("this is {}, which is not read here: {}", foreign.name, foreign.advice);
  }
  return {};
}

}  // namespace dmoscope
