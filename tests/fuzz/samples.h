#pragma once
// Small valid files of every format, from which mutation tests and the fuzzers start.

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/mesh_io.h"
#include "core/io/reading/binary.h"
#include "tests/fuzz/array_samples.h"
#include "tests/fuzz/selafin_samples.h"
#include "tests/fuzz/vtp_samples.h"
#include "tests/fuzz/vtu_samples.h"

namespace dmoscope::testing {

struct Sample {
  std::string name;
  std::string format;
  std::string bytes;
};

/// Appends numbers in a byte order.
template <class Number>
void put(std::string& bytes, bool big_endian, std::initializer_list<Number> numbers) {
  for (const Number number : numbers) {
    const auto raw = store_number(number, big_endian);
    bytes.append(raw.data(), raw.size());
  }
}

// A square of two triangles beside a quadrilateral:
//   3---2---5
//   | / |   |
//   0---1---4
inline constexpr std::string_view kVtkPoints = "0 0 0\n1 0 0\n1.0 1 0\n0 1.50 0\n2 0 0\n2 1e0 0\n";

inline std::string vtk_ascii() {
  return "# vtk DataFile Version 3.0\nthree elements\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n" + std::string(kVtkPoints) +
         "CELLS 4 16\n3 0 1 2\n3 0 2 3\n2 0 1\n4 1 4 5 2\nCELL_TYPES 4\n5 5 3 9\nPOINT_DATA 6\nSCALARS depth float 1\nLOOKUP_TABLE "
         "default\n"
         "1 2 3 4 5 6.25\nVECTORS flow double\n1 0 0  0 1 0  0 0 1\n1 1 0  0 1 1  1 0 1\nCELL_DATA 4\nSCALARS id int\nLOOKUP_TABLE "
         "default\n"
         "7 8 9 10\nFIELD FieldData 1\npair%20of 2 4 unsigned_char\n1 2 3 4 5 6 7 8\n";
}

inline std::string vtk_poly_ascii() {
  return "# vtk DataFile Version 5.1\r\npoly\r\nascii\r\ndataset polydata\r\npoints 6 float\r\n" + std::string(kVtkPoints) +
         "METADATA\nINFORMATION 0\n\nVERTICES 2 1\nOFFSETS vtktypeint64\n0 1\nCONNECTIVITY vtktypeint64\n5\n"
         "POLYGONS 4 10\nOFFSETS vtktypeint64\n0 3 6 10\nCONNECTIVITY vtktypeint64\n0 1 2 0 2 3 1 4\n5 2\n"
         "CELL_DATA 4\nCOLOR_SCALARS rgb 3\n0 0 0 1 0 0 0 1 0 0 0 1\nNORMALS n float\n0 0 0 0 0 1 0 0 1 0 0 1\n";
}

inline std::string vtk_binary(bool offsets) {
  std::string s = "# vtk DataFile Version ";
  s += offsets ? "5.1" : "4.2";
  s += "\nbinary\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n";
  put<float>(s, true, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1.5F, 0, 2, 0, 0, 2, 1, 0.5F});
  if (offsets) {
    s += "\nCELLS 4 10\nOFFSETS vtktypeint64\n";
    put<std::int64_t>(s, true, {0, 3, 6, 10});
    s += "\nCONNECTIVITY vtktypeint64\n";
    put<std::int64_t>(s, true, {0, 1, 2, 0, 2, 3, 1, 4, 5, 2});
  } else {
    s += "\nCELLS 3 13\n";
    put<std::int32_t>(s, true, {3, 0, 1, 2, 3, 0, 2, 3, 4, 1, 4, 2, 5});
  }
  s += "\nCELL_TYPES 3\n";
  put<std::int32_t>(s, true, {5, 7, offsets ? 9 : 8});
  s += "\nPOINT_DATA 6\nSCALARS flags bit 1\nLOOKUP_TABLE default\n\x2c\nLOOKUP_TABLE colours 1\nabcd\nCELL_DATA 3\nTEXTURE_COORDINATES uv "
       "2 short\n";
  put<std::int16_t>(s, true, {1, -2, 3, 4, 5, -6});
  s += "\n";
  return s;
}

inline std::string vtk_volume() {
  return "# vtk DataFile Version 2.0\nvolume\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 float\n"
         "0 0 0 1 0 0 1 1 0 0 1 0\n0 0 1 1 0 1 1 1 1 0 1 1\n.5 .5 2\nCELLS 3 20\n8 0 1 2 3 4 5 6 7\n5 4 5 6 7 8\n4 0 1 2 3\nCELL_TYPES "
         "3\n12 14 9\n";
}

/// Two cubes side by side.
inline std::string vtk_structured_grid() {
  return "# vtk DataFile Version 3.0\ngrid\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 3 2 2\nPOINTS 12 float\n0 0 0 1 0 0 2 0 0\n0 1 0 1 "
         "1.50 0 2 1 "
         "0\n0 0 1 1 0 1 2 0 1\n0 1 1 1 1 1 2 1 1\nCELL_DATA 2\nSCALARS id int\nLOOKUP_TABLE default\n4 7\nPOINT_DATA 12\nSCALARS depth "
         "double\n"
         "LOOKUP_TABLE default\n1 2 3 4 5 6 7 8 9 10 11 12\n";
}

/// Two rectangles that stand upright, y = 5.
inline std::string vtk_rectilinear() {
  std::string s = "# vtk DataFile Version 4.2\ngrid\nBINARY\nDATASET RECTILINEAR_GRID\nDIMENSIONS 3 1 2\nX_COORDINATES 3 float\n";
  put<float>(s, true, {0, 1, 3});
  s += "\nY_COORDINATES 1 double\n";
  put<double>(s, true, {5});
  s += "\nZ_COORDINATES 2 int\n";
  put<std::int32_t>(s, true, {0, 2});
  s += "\nPOINT_DATA 6\nSCALARS mark unsigned_char\nLOOKUP_TABLE default\nabcdef\n";
  return s;
}

inline std::string vtk_image() {
  return "# vtk DataFile Version 2.0\nimage\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 3 1\nORIGIN 1 2 3\nASPECT_RATIO 0.5 1 2\n"
         "CELL_DATA 4\nSCALARS id int\nLOOKUP_TABLE default\n4 7 8 9\n";
}

inline std::string ply_ascii() {
  return "ply\nformat ascii 1.0\ncomment a small mesh\nelement vertex 6\nproperty uchar red\nproperty double y\nproperty float x\nproperty "
         "double z\n"
         "element face 3\nproperty list uchar int vertex_indices\nproperty float quality\nelement edge 1\nproperty int vertex1\nproperty "
         "int vertex2\n"
         "end_header\n255 0 0 0\n0 0 1.0 0\n1 1 1 0\n2 1.5 0 0\n3 0 2 0\n4 1 2 -0.5\n3 0 1 2 0.25\n3 0 2 3 nan\n4 1 4 5 2 1\n0 1\n";
}

inline std::string ply_binary(bool big) {
  std::string s = "ply\r\nformat binary_";
  s += big ? "big" : "little";
  s += "_endian 1.0\r\nobj_info none\r\nelement face 2\r\nproperty short mark\r\nproperty list uint8 uint16 vertex_index\r\n"
       "element vertex 4\r\nproperty double x\r\nproperty float y\r\nproperty double z\r\nproperty list uint8 float more\r\nend_header\r\n";
  for (const std::uint16_t last : {std::uint16_t{2}, std::uint16_t{3}}) {
    put<std::int16_t>(s, big, {-7});
    put<std::uint8_t>(s, big, {3});
    put<std::uint16_t>(s, big, {0, static_cast<std::uint16_t>(last - 1), last});
  }
  for (int v = 0; v < 4; ++v) {
    put<double>(s, big, {v == 1 || v == 2 ? 1.0 : 0.0});
    put<float>(s, big, {v >= 2 ? 1.25F : 0.0F});
    put<double>(s, big, {0.1 * v});
    put<std::uint8_t>(s, big, {static_cast<std::uint8_t>(v)});
    for (int i = 0; i < v; ++i) put<float>(s, big, {1.0F});
  }
  return s;
}

inline std::string stl_ascii() {
  return "solid two facets\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1 1 0\n  endloop\n endfacet\n"
         " FACET NORMAL nan nan nan\n  OUTER LOOP\n   VERTEX -0.0 0 0\n   VERTEX 1.0 1 0\n   VERTEX 0 1e0 0\n  ENDLOOP\n "
         "ENDFACET\nendsolid two facets\n";
}

inline std::string stl_binary() {
  std::string s = "solid that is binary";
  s.resize(80, ' ');
  put<std::uint32_t>(s, false, {2});
  put<float>(s, false, {0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0.5F});
  put<std::uint16_t>(s, false, {0});
  put<float>(s, false, {0, 0, 1, -0.0F, 0, 0, 1, 1, 0.5F, 0, 1, 0});
  put<std::uint16_t>(s, false, {31});
  return s;
}

inline std::string off_binary() {
  std::string s = "OFF BINARY\n";
  put<std::uint32_t>(s, true, {4, 2, 0});
  put<float>(s, true, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  put<std::uint32_t>(s, true, {3, 0, 1, 2, 0, 3, 0, 2, 3, 0});
  return s;
}

inline std::string medit_ascii() {
  return "MeshVersionFormatted 2\n# a comment\nDimension\n3\nVertices\n5\n0 0 0 1\n1 0 0 1\n0 1.50 0 2\n0 0 1 0\n1 1 1 0\n"
         "Triangles\n2\n1 3 2 7\n2 3 5 7\nEdges\n2\n1 2 3\n2 3 3\nTetrahedra\n2\n1 2 3 4 1\n2 3 4 5 0\n"
         "Corners\n1\n4\nRidges\n1\n2\nNormals\n1\n0 0 1\nEnd\n";
}

/// The mesh of medit_ascii() as one of the four binary versions.
inline std::string medit_binary(int version, bool big) {
  std::string s;
  std::size_t link = 0;  // place of the link to the next keyword
  const auto whole = [&](std::initializer_list<std::int64_t> numbers) {
    for (const std::int64_t n : numbers)
      version == 4 ? put<std::int64_t>(s, big, {n}) : put<std::int32_t>(s, big, {static_cast<std::int32_t>(n)});
  };
  const auto close = [&] {
    std::string place;
    if (version >= 3) {
      put<std::int64_t>(place, big, {static_cast<std::int64_t>(s.size())});
    } else {
      put<std::int32_t>(place, big, {static_cast<std::int32_t>(s.size())});
    }
    if (link > 0) s.replace(link, place.size(), place);
  };
  const auto keyword = [&](std::int32_t code) {
    close();
    put<std::int32_t>(s, big, {code});
    link = s.size();
    s.append(version >= 3 ? 8 : 4, '\0');
  };
  put<std::int32_t>(s, big, {1, version});
  keyword(3);
  put<std::int32_t>(s, big, {3});
  keyword(4);
  whole({5});
  const double xyz[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::int64_t references[5] = {1, 1, 2, 0, 0};
  for (int v = 0; v < 5; ++v) {
    for (const double x : xyz[v]) version == 1 ? put<float>(s, big, {static_cast<float>(x)}) : put<double>(s, big, {x});
    whole({references[v]});
  }
  keyword(6);
  whole({2, 1, 3, 2, 7, 2, 3, 5, 7});
  keyword(5);
  whole({2, 1, 2, 3, 2, 3, 3});
  keyword(8);
  whole({2, 1, 2, 3, 4, 1, 2, 3, 4, 5, 0});
  keyword(13);
  whole({1, 4});
  keyword(14);
  whole({1, 2});
  keyword(60);
  whole({1, 0});
  keyword(54);
  s.replace(link, s.size() - link, s.size() - link, '\0');
  return s;
}

// Two tetrahedra with a triangle, a line and a point of their boundary; the numbers of the nodes have gaps and are in no order.
inline std::string gmsh_2_ascii() {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 7 \"outer wall\"\n3 1 \"rock\"\n$EndPhysicalNames\n"
         "$Nodes\n5\n3 0 0 0\n1 1.0 0 0\n10 0 1.50 0\n20 0 0 1\n5 1 1 1\n$EndNodes\n"
         "$Elements\n5\n1 15 2 4 1 3\n2 1 2 0 2 3 1\n3 2 2 7 3 3 10 1\n4 4 2 1 1 3 1 10 20\n9 4 3 1 2 1 1 10 20 5\n$EndElements\n"
         "$Periodic\n0\n$EndPeriodic\n$NodeData\n1\n\"depth\"\n1\n0.5\n3\n0\n1\n5\n1 1\n3 2\n5 3\n10 4e0\n20 5\n$EndNodeData\n"
         "$ElementData\n1\n\"flow\"\n1\n0\n3\n0\n3\n2\n4 1 2 3\n9 0 0 nan\n$EndElementData\n";
}

inline std::string gmsh_2_binary(bool big) {
  std::string s = "$MeshFormat\n2.2 1 8\n";
  put<std::int32_t>(s, big, {1});
  s += "\n$EndMeshFormat\n$Nodes\n5\n";
  const double xyz[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}, {0, 0, 1}, {1, 1, 1}};
  for (std::int32_t v = 0; v < 5; ++v) {
    put<std::int32_t>(s, big, {v + 2});
    put<double>(s, big, {xyz[v][0], xyz[v][1], xyz[v][2]});
  }
  s += "\n$EndNodes\n$Elements\n3\n";
  put<std::int32_t>(s, big, {2, 1, 2, 1, 7, 3, 2, 4, 3});
  put<std::int32_t>(s, big, {4, 2, 2, 2, 1, 1, 2, 3, 4, 5, 3, 1, 1, 3, 4, 5, 6});
  s += "\n$EndElements\n$NodeData\n1\n\"depth\"\n1\n0\n3\n0\n1\n2\n";
  for (std::int32_t v = 2; v < 4; ++v) {
    put<std::int32_t>(s, big, {v});
    put<double>(s, big, {0.25 * v});
  }
  return s + "\n$EndNodeData\n";
}

inline std::string gmsh_4_ascii() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 \"plate\"\n$EndPhysicalNames\n"
         "$Entities\n1 1 2 0\n1 0 0 0 0\n1 0 0 0 1 0 0 1 6 2 1 -1\n1 0 0 0 1 1 0 2 5 8 1 1\n2 0 0 0 1 1 0 1 5 0\n$EndEntities\n"
         "$Nodes\n3 5 1 9\n0 1 0 1\n9\n0 0 0\n1 1 1 1\n2\n1.0 0 0 0.5\n2 1 0 3\n3\n4\n1\n1 1 0\n0 1.50 0\n2 0.5 0\n$EndNodes\n"
         "$Elements\n4 5 1 5\n0 1 15 1\n1 9\n1 1 1 1\n2 9 2\n2 1 2 2\n3 9 2 3\n4 9 3 4\n2 2 2 1\n5 2 1 3\n$EndElements\n";
}

inline std::string gmsh_4_partitioned() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 5 \"plate\"\n$EndPhysicalNames\n"
         "$Entities\n0 1 1 0\n7 0 0 0 1 0 0 0 0\n1 0 0 0 1 1 0 1 5 1 7\n$EndEntities\n"
         "$PartitionedEntities\n2\n1\n4 1\n0 2 2 0\n8 1 7 1 1 0 0 0 1 0 0 0 0\n9 2 1 2 1 2 0 0 0 1 1 0 0 0\n"
         "2 2 1 1 1 0 0 0 1 1 0 1 5 1 8\n3 2 1 1 2 0 0 0 1 1 0 1 5 1 9\n$EndPartitionedEntities\n"
         "$Nodes\n2 4 1 4\n2 2 0 3\n1\n2\n3\n0 0 0\n1 0 0\n1 1.50 0\n2 3 0 1\n4\n0 1 0\n$EndNodes\n"
         "$Elements\n4 4 1 4\n1 8 1 1\n1 1 2\n1 9 1 1\n2 1 3\n2 2 2 1\n3 1 2 3\n2 3 2 1\n4 1 3 4\n$EndElements\n"
         "$GhostElements\n1\n4 2 1 1\n$EndGhostElements\n";
}

inline std::string gmsh_4_binary(bool big) {
  std::string s = "$MeshFormat\n4.1 1 8\n";
  put<std::int32_t>(s, big, {1});
  s += "\n$EndMeshFormat\n$Entities\n";
  put<std::int64_t>(s, big, {0, 0, 1, 1});
  put<std::int32_t>(s, big, {3});
  put<double>(s, big, {0, 0, 0, 1, 1, 1});
  put<std::int64_t>(s, big, {1});
  put<std::int32_t>(s, big, {7});
  put<std::int64_t>(s, big, {0});
  put<std::int32_t>(s, big, {1});
  put<double>(s, big, {0, 0, 0, 1, 1, 1});
  put<std::int64_t>(s, big, {0, 1});
  put<std::int32_t>(s, big, {-3});
  s += "\n$EndEntities\n$Nodes\n";
  put<std::int64_t>(s, big, {2, 5, 1, 6});
  put<std::int32_t>(s, big, {2, 3, 1});
  put<std::int64_t>(s, big, {3, 1, 2, 3});
  put<double>(s, big, {0, 0, 0, 0.5, 0.5, 1, 0, 0, 0.5, 0.25, 0, 1.5, 0, 0, 0});
  put<std::int32_t>(s, big, {3, 1, 0});
  put<std::int64_t>(s, big, {2, 6, 5});
  put<double>(s, big, {0, 0, 1, 1, 1, 1});
  s += "\n$EndNodes\n$Elements\n";
  put<std::int64_t>(s, big, {2, 3, 1, 3});
  put<std::int32_t>(s, big, {2, 3, 2});
  put<std::int64_t>(s, big, {1, 1, 1, 3, 2});
  put<std::int32_t>(s, big, {3, 1, 4});
  put<std::int64_t>(s, big, {2, 2, 1, 2, 3, 6, 3, 2, 3, 6, 5});
  return s + "\n$EndElements\n";
}

inline std::string abaqus_volume() {
  return "*Heading\ntwo solids\n** a comment\n*Part, name=P\n*Node, nset=All\n1, 0., 0., 0.\n2,1.,0,0\n3, 1., 1.50, 0.\n4, 0, 1, 0\n"
         "11, 0., 0., 1e0\n12, 1., 0., 1.\n13, 1., 1., 1., 0., 0., 1.\n14, 0., 1., 1.\n20, .5, .5, 2.\n*Element, type=C3D8R, elset=Box\n"
         "1, 1, 2, 3, 4,\n11, 12, 13, 14\n*ELEMENT, TYPE=C3D5\n7, 11, 12, 13, 14, 20\n*Element, type=SFM3D4, elset=skin\n8, 1, 4, 3, 2\n"
         "*Element, type=MASS\n9, 20\n*Nset, nset=Tip\n20, 3\n*Elset, elset=More, generate\n1, 7, 6\n*Elset, elset=more\nBox, 8\n"
         "*Surface, type=ELEMENT, name=Top\nBox, S3\n7, S2\n*End Part\n*Assembly, name=A\n*Instance, name=P-1, part=P\n*End Instance\n"
         "*Nset, nset=Root, instance=P-1\n1, 2\n*End Assembly\n*Material, name=steel\n*Elastic\n2e5, .3\n";
}

inline std::string abaqus_planar() {
  return "*NODE\r\n1, 0, 0\r\n2, 1, 0\r\n3, 1, 1.\r\n4, 0, 1.50\r\n5, 2, 0\r\n6, 2, 1e0\r\n*ELEMENT, TYPE=CPS3, ELSET=\"a set\"\r\n1, 1, "
         "2, 3\r\n"
         "2, 1, 3, 4\r\n*ELEMENT, TYPE=CPE4R,\r\nELSET=right\r\n3, 2, 5, 6, 3\r\n*ELEMENT, TYPE=T2D2\r\n4, 1, 2\r\n"
         "*SURFACE, NAME=edge\r\n1, S1\r\nright, S2\r\n*SURFACE, NAME=n, TYPE=NODE\r\n5, 1.\r\n";
}

// One card of each form: free, free and large, small, large, tabs, with a continuation line.
inline std::string nastran_volume() {
  return "$ a comment\nSOL 101\nCEND\nTITLE = two solids\nBEGIN BULK\n$HMNAME PROP                   7\"rock\"2\n"
         "GRID,1,,0.,0.,0.\nGRID,2,0,1.,0.,0.,0,123\nGRID           3              1.    1.50      0.\n"
         "GRID*                  4                              0.              1.*       \n*                     0.               0\n"
         "GRID*,11,,0.,0.,\n*,1.\nGRID\t12\t\t1.\t0.\t1.+0\nGRID          13        1.0000001.0000001.000000\nGRID,14,,0.,1.,1.0D0\n"
         "GRID,20,,5.-1,.5,2.\nCHEXA          1       7       1       2       3       4      11      12+A\n+A            13      14\n"
         "CPYRAM,2,7,11,12,13,14,20\nCQUAD4         5       9       1       4       3       2\nCBAR,6,3,1,2,0.,0.,1.\nPLOTEL,9,3,4\n"
         "PSOLID,7,1\nMAT1,1,2.+5,,.3\nENDDATA\n";
}

inline std::string nastran_planar() {
  return "GRID,1,,0,0\r\nGRID,2,,1.,0.\r\nGRID,3,,1.,1.\r\nGRID,4,,0.,1.50\r\nGRID,5,,2.,0.\r\nGRID,6,,2.,1.,0.25\r\n"
         "CTRIA3,1,1,1,2,3\r\nCTRIA3,2,1,1,3,4\r\nCQUAD4,3,,2,5,6,3\r\nCROD,4,2,1,2\r\n";
}

/// A dataset of a universal file.
inline std::string unv_dataset(std::string_view number, std::string_view records) {
  constexpr std::string_view kMark = "    -1\n";
  return std::string(kMark) + std::string(6 - number.size(), ' ') + std::string(number) + "\n" + std::string(records) + std::string(kMark);
}

// A hexahedron below a pyramid, a quadrilateral, a beam and a spring; two groups.
inline std::string unv_volume() {
  constexpr double kPlaces[9][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1.5, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {.5, .5, 2}};
  std::string nodes, line(128, ' ');
  for (int v = 0; v < 9; ++v) {
    const auto add = [&](const char* form, auto... numbers) {
      nodes.append(line.data(), static_cast<std::size_t>(std::snprintf(line.data(), line.size(), form, numbers...)));
    };
    add("%10d%10d%10d%10d\n", v < 4 ? v + 1 : v + 7, 1, 1, 11);
    const std::size_t begin = nodes.size();
    add("%25.16E%25.16E%25.16E\n", kPlaces[v][0], kPlaces[v][1], kPlaces[v][2]);
    for (std::size_t i = begin; i < nodes.size(); ++i)
      if (nodes[i] == 'E') nodes[i] = 'D';
  }
  return unv_dataset("164", "         1SI: Meters (newton)          2\n    1.0000000000000000D+0\n") + unv_dataset("2411", nodes) +
         unv_dataset("2412",
                     "         1       115         7         1         7         8\n         1         2         3         4        11"
                     "        12        13        14\n"
                     "         2       114         7         1         7         5\n        11        12        13        14        15\n"
                     "         5        94         9         1         7         4\n         1         4         3         2\n"
                     "         6        21         9         1         7         2\n         0         1         1\n         3         4\n"
                     "         7       136         9         1         7         1\n        15\n") +
         unv_dataset("2477",
                     "         1         0         0         0         0         0         0         2\nrock\n"
                     "         8         1         0         0         8         2         0         0\n"
                     "         4         0         0         0         0         0         0         3\nskin and a node\n"
                     "         8         5         0         0         8         6         0         0\n"
                     "         7         3         0         0\n");
}

inline std::string unv_planar() {
  return unv_dataset("15",
                     "         1         0         0        11  0.00000E+00  0.00000E+00  0.00000E+00\n"
                     "         2         0         0        11  1.00000E+00  0.00000E+00  0.00000E+00\n"
                     "         3         0         0        11  1.00000E+00  1.00000E+00  0.00000E+00\n"
                     "         4         0         0        11  0.00000E+00  1.50000E+00  0.00000E+00\n"
                     "         5         0         0        11  2.00000E+00  5.00000E-01  0.00000E+00\n") +
         unv_dataset("2412",
                     "         1        44         1         1         7         4\n         1         2         3         4\n"
                     "         2        41         2         1         7         3\n         2         5         3\n");
}

inline std::string sms_2dm() {
  return "MESH2D\nMESHNAME \"a square\"\nNUM_MATERIALS_PER_ELEM 1\nE3T 1 1 2 3 1\nE3T 2 1 3 4 2\nE4Q 9 2 5 6 3 1\nE2L 10 1 2 4\n"
         "ND 1 0.0 0.0 -10.5\nND 2 1.0 0 -11\nND 3 1 1 12.\nND 4 0 1.50 1.3e1\nND 5 2 0 0\nND 6 2 1 0\nNS 1 2\nNS -5 3 \"sea side\"\nNS 4 "
         "3 -6\n"
         "NS -6 7\nBEGPARAMDEF\nGM  \"Mesh\"\nENDPARAMDEF\nBEG2DMBC\nMAT  2 \"reed bed\"\nEND2DMBC\n";
}

// A hexahedron below a pyramid, a quadrilateral and a point beside them.
inline std::string xdmf_mixed() {
  return "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"3.0\">\n<!-- two solids -->\n<Domain>\n"
         "<Grid Name=\"two &amp; more\" GridType=\"Uniform\">\n<Geometry GeometryType=\"XYZ\"><DataItem DataType=\"Float\" Dimensions=\"9 "
         "3\" "
         "Format=\"XML\" Precision=\"8\">0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1.50\n0 1 1\n.5 5e-1 2</DataItem></Geometry>\n"
         "<Topology TopologyType=\"Mixed\" NumberOfElements=\"4\"><DataItem DataType=\"Int\" Dimensions=\"23\" Format=\"XML\">9 0 1 2 3 4 "
         "5 6 7\n"
         "5 0 3 2 1 1 1 8\n7 4 5 6 7 8</DataItem></Topology>\n<Attribute Name=\"depth\" AttributeType=\"Scalar\" Center=\"Node\">"
         "<DataItem Dimensions=\"9\">1 2 3 4 5 6 7 nan 9</DataItem></Attribute>\n<Attribute Name=\"flow\" Center=\"Cell\"><DataItem "
         "NumberType=\"Int\" Precision=\"8\" Dimensions=\"4 2\">1 2 3 4 5 6 7 8</DataItem></Attribute>\n<Set Name=\"top\" SetType=\"Node\">"
         "<DataItem Dimensions=\"2\">8 7</DataItem></Set>\n<Set Name=\"tip\" SetType=\"Cell\"><DataItem>1 3</DataItem></Set>\n"
         "<Information Name=\"x\"/></Grid></Domain></Xdmf>\n";
}

inline std::string xdmf_planar() {
  return "<Xdmf>\n<Domain><Grid GridType=\"Collection\"><Grid><Topology Type=\"Triangle\" Dimensions=\"2\" BaseOffset=\"1\">\n<DataItem>1 "
         "2 3 1 3 "
         "4</DataItem></Topology><Geometry Type=\"XY\"><DataItem>\n0 0\n1 0\n1 1\n0 "
         "1.50\n</DataItem></Geometry></Grid></Grid></Domain></Xdmf>";
}

/// VTK XML's grids without a list of cells, `kind` and `grid` being its dataset: two squares side by side. `where`: the element with the
/// points.
inline std::string vtk_xml_grid(const std::string& kind, const std::string& grid, const std::string& where) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + kind + "\" version=\"0.1\" byte_order=\"LittleEndian\">\n<" + kind +
         " WholeExtent=\"0 2 0 1 0 0\"" + grid + ">\n<Piece Extent=\"0 2 0 1 0 0\">\n" + where +
         "<PointData Scalars=\"depth\"><DataArray type=\"Float64\" Name=\"depth\" format=\"ascii\">1 2 3 4 5 6.25</DataArray></PointData>\n"
         "<CellData><DataArray type=\"Int32\" Name=\"id\" format=\"ascii\">7 8</DataArray></CellData>\n</Piece>\n</" +
         kind + ">\n</VTKFile>\n";
}

inline std::string vts_ascii() {
  return vtk_xml_grid("StructuredGrid", "",
                      "<Points><DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 2 0 0 "
                      "0 1.50 0 1 1 0 2 1 0</DataArray></Points>\n");
}
/// The points in base64, as Python's struct and base64 pack them: their size in four bytes is in front.
inline std::string vts_base64() {
  return vtk_xml_grid(
      "StructuredGrid", "",
      "<Points><DataArray type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\" format=\"binary\">"
      "SAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAMA/AAAAAAAAgD8AAIA/AAAAAAAAAEAAAIA/AAAAAA==</DataArray></Points>\n");
}
inline std::string vtr_ascii() {
  const auto axis = [](const std::string& numbers) { return "<DataArray type=\"Float64\" format=\"ascii\">" + numbers + "</DataArray>"; };
  return vtk_xml_grid("RectilinearGrid", "", "<Coordinates>" + axis("0 1 3") + axis("0 1.50") + axis("5") + "</Coordinates>\n");
}
inline std::string vti_ascii() { return vtk_xml_grid("ImageData", " Origin=\"1 2 3\" Spacing=\"0.5 1 2\"", ""); }

/// Packed by Python's gzip: a triangle as OFF with the file's name in the head; the same in two files that were joined, zeros behind them.
inline std::string gzip_off(bool joined) {
  using namespace std::string_view_literals;
  constexpr std::string_view kNamed =
      "\037\213\010\010\000\000\000\000\002\377a.off\000\363ws\3432V0T0\3402P\000B.C0i\240`\250g\012b\030\003\271\206\012F\134\000\314\215\014j'\000\000\000"sv;
  constexpr std::string_view kHalf =
      "\037\213\010\000\000\000\000\000\002\377\363ws\3432V0T0\3402P\000B. K\001\000lJ\305I\024\000\000\000"sv;
  constexpr std::string_view kRest =
      "\037\213\010\000\000\000\000\000\002\3773\3402P0\32435P0\3402V\0002\025\214\270\000\314\010 \251\023\000\000\000"sv;
  return joined ? std::string(kHalf) + std::string(kRest) + std::string(20, '\0') : std::string(kNamed);
}

/// At least one file of each format of format_table(); of a format of two files, both, with the byte 0x1e between them.
inline std::vector<Sample> samples() {
  std::vector<Sample> all{
      {"ascii", "off", "OFF\n# a comment\n5 2 0\n0 0 0\n1 0 0 # here\n1 1 0\n0 1.50 0\n2 0 0\n3 0 1 2\n4 0 2 3 4\n"},
      {"binary", "off", off_binary()},
      {"groups", "obj", "# square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1.50 0\nvt 0 0\ng left\nf 1/1 2/1 3/1\nf -4 -2 -1\n"},
      {"ascii", "ply", ply_ascii()},
      {"little", "ply", ply_binary(false)},
      {"big", "ply", ply_binary(true)},
      {"ascii", "stl", stl_ascii()},
      {"binary", "stl", stl_binary()},
      {"ascii", "vtk", vtk_ascii()},
      {"poly", "vtk", vtk_poly_ascii()},
      {"binary", "vtk", vtk_binary(false)},
      {"offsets", "vtk", vtk_binary(true)},
      {"volume", "vtk", vtk_volume()},
      {"structured", "vtk", vtk_structured_grid()},
      {"rectilinear", "vtk", vtk_rectilinear()},
      {"image", "vtk", vtk_image()},
      {"depth", "fort14",
       "grid\n2 4\n1 0.0 0.0 10.5\n2 1.0 0 11\n3 1 1 12.\n4 0 1 1.3D1\n1 3 1 2 3\n2 3 1 3 4\n1\n2\n2\n1\n2\n1\n2\n2 0\n3\n4\n"},
      {"marker", "su2",
       "NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 0 2 3 1\nNPOIN= 4\n0 0 0\n1 0 1\n1 1 2\n0 1.50 3\nNMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 2\n3 "
       "0 1\n3 1 2\n"},
      {"faces", "su2",
       "NDIME= 3\nNELEM= 1\n10 0 1 2 3\nNPOIN= 4\n0 0 0\n1 0 0\n0 1.50 0\n0 0 1\nNMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 2\n5 "
       "0 2 1\n5 0 1 3\n"},
      {"2_ascii", "gmsh", gmsh_2_ascii()},
      {"2_little", "gmsh", gmsh_2_binary(false)},
      {"2_big", "gmsh", gmsh_2_binary(true)},
      {"4_ascii", "gmsh", gmsh_4_ascii()},
      {"4_partitioned", "gmsh", gmsh_4_partitioned()},
      {"4_little", "gmsh", gmsh_4_binary(false)},
      {"4_big", "gmsh", gmsh_4_binary(true)},
      {"triangle", "tetgen",
       "# Triangle\n4 2 1 1\n0 0 0 0.5 1\n1 1 0 0.25 1\n2 1 1 1e-3 1 # corner\n3 0 1.50 0 0\n\x1e\n2 3 0\n0 0 1 2\n1 0 2 3\n"},
      {"tetgen", "tetgen", "5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1.0\n5 1 1 1\n\x1e\n2 4 1\n1 1 2 3 4 7\n2 2 3 4 5 -8.5\n# end\n"},
      {"volume", "medit", medit_ascii()},
      {"1_little", "meshb", medit_binary(1, false)},
      {"2_big", "meshb", medit_binary(2, true)},
      {"3_little", "meshb", medit_binary(3, false)},
      {"4_big", "meshb", medit_binary(4, true)},
      {"planar", "medit",
       "MeshVersionFormatted 1\nDimension 2\nTriangles 2 1 2 3 5 1 3 4 0\nEdges 1 1 2 4\nQuadrilaterals 1\n2 5 6 3 5\n"
       "Vertices 6\n0 0 0\n1 0 0\n1 1 0\n0 1.50 0\n2 0 0\n2 1e0 0\nRequiredVertices 1 1\nEnd\n"},
      {"volume", "abaqus", abaqus_volume()},
      {"planar", "abaqus", abaqus_planar()},
      {"strings", "2dm", sms_2dm()},
      {"volume", "nastran", nastran_volume()},
      {"planar", "nastran", nastran_planar()},
      {"volume", "unv", unv_volume()},
      {"planar", "unv", unv_planar()},
      {"mixed", "mike",
       "100079 1000 5 UTM-33\n1 0 0 -5.5 1\n2 1 0 -5 1\n3 1 1 -4 0\n4 0 1.50 -3 2\n5 2 0.5 -2 1\n2 4 25\n1 1 2 3 4\n2 2 5 3 0\n"},
      {"single_big", "selafin", selafin_sample(true, false)},
      {"double_little", "selafin", selafin_sample(false, true)},
      {"solids", "exodus", exodus_solids()},
      {"plane", "exodus", exodus_plane()},
  };
  if (format_by_extension(".cgns") != nullptr) {  // not in every build
    all.push_back({"netcdf4", "exodus", exodus_netcdf4()});
    all.push_back({"solids", "cgns", cgns_solids()});
    all.push_back({"zones", "cgns", cgns_zones()});
    all.push_back({"periodic", "cgns", cgns_periodic()});
    all.push_back({"periodic_lists", "cgns", cgns_periodic_lists()});
    all.push_back({"solids", "med", med_solids()});
    all.push_back({"plane", "med", med_plane()});
  }
  if (format_by_extension(".vtu") != nullptr) {  // not in every build
    all.push_back({"structured", "vtu", vts_ascii()});
    all.push_back({"structured_base64", "vtu", vts_base64()});
    all.push_back({"rectilinear", "vtu", vtr_ascii()});
    all.push_back({"image", "vtu", vti_ascii()});
    all.push_back({"mixed", "xdmf", xdmf_mixed()});
    all.push_back({"planar", "xdmf", xdmf_planar()});
    for (const auto& [name, bytes] : vtu_samples()) all.push_back({std::string(name), "vtu", std::string(bytes)});
    for (const auto& [name, bytes] : vtp_samples()) all.push_back({std::string(name), "vtp", std::string(bytes)});
  }
  return all;
}

}  // namespace dmoscope::testing
