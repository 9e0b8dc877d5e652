// Files of formats that are not read: each is named, with advice; and no file that is read is mistaken for one.

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/format_choice.h"
#include "core/io/mesh_io.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;

struct Known {
  const char* file;
  std::string bytes;
  const char* name;
  const char* advice;
};

TEST(ForeignFormat, IsNamedWithWhatToDo) {
  const std::string zero(1, '\0');
  const std::vector<Known> all{
      {"a.mesh", "MFEM mesh v1.0\n\ndimension\n2\n", "an MFEM mesh", "PrintVTK"},
      {"a.msh", "112 178 44\n0.5 0.25 1\n0.75 0.5 0\n", "a FreeFem mesh", "savemesh"},
      {"a.msh", "# comment\nMESH dimension 3 ElemType Tetrahedra Nnode 4\nCoordinates\n1 0 0 0\n", "a GiD mesh", "export"},
      {"a.msh", "MESH    dimension 2 ElemType Triangle  Nnode 3\nCoordinates\n", "a GiD mesh", "export"},
      {"a.msh", "(0 \"GAMBIT to Fluent File\")\n\n(2 3)\n", "a Fluent mesh", "ParaView"},
      {"a.cas", "(0 \"fluent15.0.0 build-id: 10038\")\n", "a Fluent mesh", "ParaView"},
      {"a.cdb", "/COM,ANSYS RELEASE 17.0\n/PREP7\n", "an ANSYS archive", "Fluent"},
      {"a.h5", "\x89HDF\r\n\x1a\n" + zero, "an HDF5 file", "ParaView"},
      {"a.nc", "CDF\x01" + zero, "a NetCDF file", "ParaView"},
      {"a.dat", "2 0\n1 0. 0. 0.\n2 1. 0. 0.\n", "a Nemoh mesh", "meshmagick"},
      {"a.dat", "Node Number = 4\nCell Number = 2\n1 1 2 3 1\n", "an FVCOM grid", ".2dm"},
      {"a.feb", "<?xml version=\"1.0\"?>\n<febio_spec version=\"4.0\">\n", "an FEBio model", "FEBio Studio"},
      {"a.gmv", "gmvinput ascii\nnodev 3\n", "a GMV file", "ParaView"},
      {"a.ugrid", "4 2 0 0 0 0 0\n0 0 0\n", "a UGRID mesh", "meshio"},
      {"mesh.header", "4 2 4\n2\n", "a part of an Elmer mesh", "ElmerGrid"},
      {"mesh.nodes", "1 -1 0 0 0\n", "a part of an Elmer mesh", "ElmerGrid"},
      {"a.neu", "        CONTROL INFO 2.4.6\n** GAMBIT NEUTRAL FILE\n", "a GAMBIT neutral file", "vtkGAMBITReader"},
      {"a.3mf", "PK\x03\x04" + zero, "a 3MF model", ".stl"},
      {"case.foam", "", "an OpenFOAM file", "foamToVTK"},
      {"a.dat", "TITLE = \"x\"\nVARIABLES = \"X\" \"Y\"\nZONE T=\"a\"\n", "a Tecplot file", "ParaView"},
      {"a.plt", "#!TDV112" + zero, "a Tecplot file", "ParaView"},
      {"a.k", "*KEYWORD\n*NODE\n", "an LS-DYNA keyword file", "LS-PrePost"},
      {"a.inp", "# made by LaGriT\n4 2 0 0 0\n1 0 0 0\n", "an AVS UCD file", ".avs"},
      {"a.vol", "mesh3d\ndimension\n3\n", "a Netgen mesh", "Gmsh2"},
      {"a.mphtxt", "# Created by COMSOL Multiphysics\n", "a COMSOL mesh", "Nastran"},
      {"a.xml", "<?xml version=\"1.0\"?>\n<dolfin>\n<mesh celltype=\"triangle\" dim=\"2\">\n", "a DOLFIN XML mesh", "meshio"},
      {"points", "FoamFile\n{\n version 2.0;\n}\n", "an OpenFOAM file", "foamToVTK"},
      {"a.geo", "Point(1) = {0, 0, 0};\n", "a Gmsh geometry", "gmsh -3"},
      {"a.poly", "4 2 0 0\n", "an outline", "triangle"},
      {"a.step", "ISO-10303-21;\nHEADER;\n", "a CAD geometry", "Gmsh"},
      {"a.zip", "PK\x03\x04" + zero, "packed by zip", "unpack"},
      {"a.vtk.xz",
       "\xfd"
       "7zXZ" +
           zero,
       "packed by xz", "unpack"},
  };
  for (const Known& known : all) {
    SCOPED_TRACE(known.file);
    expect_refused(known.file, known.bytes, 0, known.name);
    expect_refused(known.file, known.bytes, 0, known.advice);
    expect_refused(known.file, known.bytes, 0, "not read here");
  }
}

TEST(ForeignFormat, FoldersOfACaseAreNamed) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::filesystem::path& path) -> std::string {
    Progress progress;
    try {
      (void)read_mesh(path, progress);
    } catch (const InputError& error) {
      return error.what();
    }
    return "read";
  };
  const std::filesystem::path foam = folder.path() / "case", elmer = folder.path() / "elmer", other = folder.path() / "other";
  std::filesystem::create_directories(foam / "constant" / "polyMesh");
  for (const char* name : {"points", "faces", "owner"}) put(foam / "constant" / "polyMesh" / name, "FoamFile\n");
  for (const auto& path : {foam, foam / "constant", foam / "constant" / "polyMesh"})
    EXPECT_THAT(refused(path), ::testing::AllOf(HasSubstr("a mesh of OpenFOAM"), HasSubstr("foamToVTK"))) << path;
  std::filesystem::create_directories(elmer);
  for (const char* name : {"mesh.header", "mesh.nodes"}) put(elmer / name, "1 1 1\n");
  EXPECT_THAT(refused(elmer), ::testing::AllOf(HasSubstr("a mesh of Elmer"), HasSubstr("ElmerGrid")));
  std::filesystem::create_directories(other);
  EXPECT_THAT(refused(other), HasSubstr("directory"));
}

/// Formats that some builds read, whose readers report errors themselves.
TEST(ForeignFormat, LeavesToReadersWhatIsTheirs) {
  const std::vector<Known> all{{".bdf", "SOL 101\nCEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\n", "a Nastran", ""},
                               {".inp", "*Heading\n*Node\n1, 0., 0., 0.\n", "an Abaqus", ""},
                               {".2dm", "MESH2D\nE3T 1 1 2 3 1\n", "an SMS 2dm", ""},
                               {".xdmf", "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n", "an XDMF", ""},
                               {".cgns", "\x89HDF\r\n\x1a\n", "a CGNS", ""},
                               {".med", "\x89HDF\r\n\x1a\n", "a MED", ""},
                               {".e", "CDF\x02 num_el_blk", "an Exodus", ""}};
  for (const Known& known : all) {
    const std::string sentence = foreign_format(known.bytes, known.file);
    if (format_by_extension(known.file) != nullptr) {
      EXPECT_EQ(sentence.find(known.name), std::string::npos) << sentence;
    } else {
      EXPECT_THAT(sentence, HasSubstr(known.name));
    }
  }
}

TEST(ForeignFormat, IsNoneOfTheSamples) {
  for (const auto& sample : dmoscope::testing::samples()) {
    if (sample.format == "exodus" || sample.format == "cgns" || sample.format == "med")
      continue;  // recognised by their content before this check
    for (const char* extension : {".vtk", ".off", ".node", ".14", ".su2", ".vtu", ".dat", ""}) {
      EXPECT_EQ(foreign_format(sample.bytes, extension), "") << sample.format << " " << sample.name;
    }
  }
}

/// Errors in a file of the format itself are still reported with their line.
TEST(ForeignFormat, DoesNotHideTheReadersOwnWords) {
  expect_refused("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 zero 0\n", 6, "a coordinate");
  expect_refused("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", 6, "3");
}

}  // namespace
}  // namespace dmoscope::test
