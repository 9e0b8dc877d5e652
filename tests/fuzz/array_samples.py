#!/usr/bin/python3
"""Makes array_samples.h: small Exodus, CGNS, MED and HDF5 files, written by Debian's netCDF4, h5py and meshio; and cgnscheck's word on those
of CGNS.

    /usr/bin/python3 array_samples.py > array_samples.h
"""
import base64
import os
import re
import subprocess
import sys
import tempfile

import h5py
import meshio
import netCDF4
import numpy

# A wedge, a cube, a tetrahedron and a pyramid, apart from each other, of volumes 1/2, 1, 1/6 and 1/3.
SOLIDS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0, 1, 1), (2, 0, 0), (3, 0, 0), (3, 1, 0), (2, 1, 0), (2, 0, 1), (3, 0, 1),
          (3, 1, 1), (2, 1, 1), (4, 0, 0), (5, 0, 0), (4, 1, 0), (4, 0, 1), (6, 0, 0), (7, 0, 0), (7, 1, 0), (6, 1, 0), (6.5, 0.5, 1)]
WEDGE, CUBE, TETRAHEDRON, PYRAMID = [1, 2, 3, 4, 5, 6], list(range(7, 15)), [15, 16, 17, 18], [19, 20, 21, 22, 23]
folder = tempfile.mkdtemp()


def path(name):
    return os.path.join(folder, name)


def characters(texts, width):
    return numpy.array([list(t.ljust(width, "\0")) for t in texts], dtype="S1")


def exodus(name, kind, points, blocks, nodesets=(), sidesets=(), real="f8", together=False, steps=0, **packed):
    """blocks: (id, name, type, elements); nodesets: (id, name, nodes); sidesets: (id, name, elements, sides)."""
    points = numpy.array(points, dtype=real)
    f = netCDF4.Dataset(path(name), "w", format=kind)
    f.title = "made by netCDF4"
    for d, n in [("len_name", 33), ("num_dim", points.shape[1]), ("num_nodes", len(points)), ("num_el_blk", len(blocks)),
                 ("num_elem", sum(len(b[3]) for b in blocks))]:
        f.createDimension(d, n)
    f.createDimension("time_step", None)
    if together:
        f.createVariable("coord", real, ("num_dim", "num_nodes"), **packed)[:] = points.T
    else:
        for i, axis in enumerate("xyz"[:points.shape[1]]):
            f.createVariable("coord" + axis, real, ("num_nodes",), **packed)[:] = points[:, i]
    f.createVariable("eb_prop1", "i4", ("num_el_blk",))[:] = [b[0] for b in blocks]
    f.createVariable("eb_names", "S1", ("num_el_blk", "len_name"))[:] = characters([b[1] for b in blocks], 33)
    for i, (_, _, word, elements) in enumerate(blocks, 1):
        f.createDimension(f"num_el_in_blk{i}", len(elements))
        f.createDimension(f"num_nod_per_el{i}", len(elements[0]))
        v = f.createVariable(f"connect{i}", "i4", (f"num_el_in_blk{i}", f"num_nod_per_el{i}"))
        v.elem_type = word
        v[:] = elements
    if nodesets:
        f.createDimension("num_node_sets", len(nodesets))
        f.createVariable("ns_prop1", "i4", ("num_node_sets",))[:] = [s[0] for s in nodesets]
        f.createVariable("ns_names", "S1", ("num_node_sets", "len_name"))[:] = characters([s[1] for s in nodesets], 33)
    for i, (_, _, nodes) in enumerate(nodesets, 1):
        f.createDimension(f"num_nod_ns{i}", len(nodes))
        f.createVariable(f"node_ns{i}", "i4", (f"num_nod_ns{i}",))[:] = nodes
    if sidesets:
        f.createDimension("num_side_sets", len(sidesets))
        f.createVariable("ss_prop1", "i4", ("num_side_sets",))[:] = [s[0] for s in sidesets]
        f.createVariable("ss_names", "S1", ("num_side_sets", "len_name"))[:] = characters([s[1] for s in sidesets], 33)
    for i, (_, _, elements, sides) in enumerate(sidesets, 1):
        f.createDimension(f"num_side_ss{i}", len(elements))
        f.createVariable(f"elem_ss{i}", "i4", (f"num_side_ss{i}",))[:] = elements
        f.createVariable(f"side_ss{i}", "i4", (f"num_side_ss{i}",))[:] = sides
    if steps:
        time = f.createVariable("time_whole", "f8", ("time_step",))
        f.createDimension("num_nod_var", 2)
        f.createDimension("num_elem_var", 1)
        f.createVariable("name_nod_var", "S1", ("num_nod_var", "len_name"))[:] = characters(["depth", "heat"], 33)
        f.createVariable("name_elem_var", "S1", ("num_elem_var", "len_name"))[:] = characters(["stress"], 33)
        nodal = [f.createVariable(f"vals_nod_var{k}", "f8", ("time_step", "num_nodes")) for k in (1, 2)]
        of_block = f.createVariable("vals_elem_var1eb1", "f8", ("time_step", "num_el_in_blk1"))
        for step in range(steps):
            time[step] = 0.5 * step
            for k, v in enumerate(nodal, 1):
                v[step, :] = 1000 * step + 100 * k + numpy.arange(len(points))
            of_block[step, :] = 10 * step + 0.25 + numpy.arange(len(blocks[0][3]))
    f.close()


def node(parent, name, label, kind="MT", data=None, **options):
    g = parent.create_group(name, track_order=True)
    g.attrs.create("name", numpy.bytes_(name.ljust(32, "\0")), dtype="S33")
    g.attrs.create("label", numpy.bytes_(label.ljust(32, "\0")), dtype="S33")
    g.attrs.create("type", numpy.bytes_(kind), dtype="S3")
    g.attrs.create("flags", numpy.array([1], dtype="i4"))
    if data is not None:
        if isinstance(data, str):
            data = numpy.frombuffer(data.encode(), dtype="i1")
        g.create_dataset(" data", data=numpy.asarray(data), **options)
    return g


def cgns(name, dimensions):
    f = h5py.File(path(name), "w", libver=("earliest", "v110"), track_order=True)
    for attribute, value, size in [("name", "HDF5 MotherNode", 33), ("label", "Root Node of HDF5 File", 33), ("type", "MT", 3)]:
        f.attrs.create(attribute, numpy.bytes_(value), dtype=f"S{size}")
    f.create_dataset(" format", data=numpy.frombuffer(b"IEEE_LITTLE_32\0", dtype="i1"))
    f.create_dataset(" hdf5version", data=numpy.frombuffer(b"HDF5 Version 1.10.8".ljust(33, b"\0"), dtype="i1"))
    node(f, "CGNSLibraryVersion", "CGNSLibraryVersion_t", "R4", numpy.array([3.4], dtype="f4"))
    return f, node(f, "Base", "CGNSBase_t", "I4", numpy.array(dimensions, dtype="i4"))


def coordinates(zone, points, real, **options):
    grid = node(zone, "GridCoordinates", "GridCoordinates_t")
    for axis, values in zip("XYZ", points):
        node(grid, "Coordinate" + axis, "DataArray_t", "R8" if real == "f8" else "R4", numpy.asarray(values, dtype=real), **options)


def section(zone, name, type, first, last, numbers):
    s = node(zone, name, "Elements_t", "I4", numpy.array([type, 0], dtype="i4"))
    node(s, "ElementRange", "IndexRange_t", "I4", numpy.array([first, last], dtype="i4"))
    node(s, "ElementConnectivity", "DataArray_t", "I4", numpy.array(numbers, dtype="i4"))


def condition(parent, name, where, numbers, location=None, family=None):
    c = node(parent, name, "BC_t", "C1", "FamilySpecified" if family else "BCWall")
    numbers = numpy.array(numbers, dtype="i4")
    node(c, where, "IndexRange_t" if where == "PointRange" else "IndexArray_t", "I4", numbers)
    if location:
        node(c, "GridLocation", "GridLocation_t", "C1", location)
    if family:
        node(c, "FamilyName", "FamilyName_t", "C1", family)


def unstructured():
    f, base = cgns("solids.cgns", [3, 3])
    node(base, "Hull", "Family_t")
    zone = node(base, "Zone", "Zone_t", "I4", numpy.array([[23], [4], [0]], dtype="i4"))
    node(zone, "ZoneType", "ZoneType_t", "C1", "Unstructured")
    coordinates(zone, numpy.array(SOLIDS, dtype="f8").T, "f8")
    section(zone, "Inside", 20, 1, 3, [14] + WEDGE + [17] + CUBE + [10] + TETRAHEDRON)
    section(zone, "Tip", 12, 4, 4, PYRAMID)
    section(zone, "Floor", 5, 5, 6, [1, 3, 2, 15, 17, 16])
    section(zone, "Roof", 7, 7, 7, [11, 12, 13, 14])
    all = node(zone, "ZoneBC", "ZoneBC_t")
    condition(all, "ground", "PointRange", [[5], [6]], "FaceCenter", "Hull")
    condition(all, "peak", "PointList", [[23], [18]], "Vertex")
    solution = node(zone, "Flow", "FlowSolution_t")
    node(solution, "GridLocation", "GridLocation_t", "C1", "CellCenter")
    node(solution, "Pressure", "DataArray_t", "R8", numpy.array([1.5, 2.5, 3.5, 4.5]))
    f.close()


def structured():
    """Two zones of 2 x 1 and 1 x 1 squares that share an edge, and one of a patch."""
    f, base = cgns("zones.cgns", [2, 2])
    for name, size, shift, real, options in [("Left", 3, 0.0, "f4", {}), ("Right", 2, 2.0, "f8", {"chunks": (1, 2), "compression": "gzip"})]:
        zone = node(base, name, "Zone_t", "I4", numpy.array([[size, 2], [size - 1, 1], [0, 0]], dtype="i4"))
        node(zone, "ZoneType", "ZoneType_t", "C1", "Structured")
        y, x = numpy.mgrid[0:2, 0:size]
        coordinates(zone, [x + shift, y * 1.0], real, **options)
        all = node(zone, "ZoneBC", "ZoneBC_t")
        condition(all, "south", "PointRange", [[1, 1], [size, 1]])
        solution = node(zone, "Flow", "FlowSolution_t")
        node(solution, "Depth", "DataArray_t", "R8", x + shift + 10.0 * y)
    f.close()


def periodic(parent, translation):
    all = node(node(parent, "Property", "GridConnectivityProperty_t"), "Periodic", "Periodic_t")
    for name, values in [("RotationCenter", [0, 0]), ("RotationAngle", [0, 0]), ("Translation", translation)]:
        node(all, name, "DataArray_t", "R4", numpy.array(values, dtype="f4"))


def periodic_blocks():
    """A zone of 2 x 1 squares and one of 1 x 1 whose second index runs downwards, a period of 3 from west to east, told from both sides."""
    f, base = cgns("periodic.cgns", [2, 2])
    west, east = [[1, 1], [1, 2]], [[2, 2], [2, 1]]
    for name, other, size, shift, own, donor, period in [("Left", "Base/Right", 3, 0.0, west, east, 3), ("Right", "Left", 2, 2.0, east, west, -3)]:
        zone = node(base, name, "Zone_t", "I4", numpy.array([[size, 2], [size - 1, 1], [0, 0]], dtype="i4"))
        node(zone, "ZoneType", "ZoneType_t", "C1", "Structured")
        y, x = numpy.mgrid[0:2, 0:size]
        coordinates(zone, [x + shift, y * 1.0 if name == "Left" else 1.0 - y], "f8")
        link = node(node(zone, "ZoneGridConnectivity", "ZoneGridConnectivity_t"), "around", "GridConnectivity1to1_t", "C1", other)
        node(link, "PointRange", "IndexRange_t", "I4", numpy.array(own, dtype="i4"))
        node(link, "PointRangeDonor", "IndexRange_t", "I4", numpy.array(donor, dtype="i4"))
        node(link, "Transform", '"int[IndexDimension]"', "I4", numpy.array([1, -2], dtype="i4"))
        periodic(link, [period, 0])
    f.close()


def periodic_lists():
    """Two squares in an unstructured zone, whose east end is its west end; and lists of faces and of points that overlap, which say nothing."""
    f, base = cgns("periodic_lists.cgns", [2, 2])
    zone = node(base, "Zone", "Zone_t", "I4", numpy.array([[6], [2], [0]], dtype="i4"))
    node(zone, "ZoneType", "ZoneType_t", "C1", "Unstructured")
    y, x = numpy.mgrid[0:2, 0:3]
    coordinates(zone, [x.ravel() * 1.0, y.ravel() * 1.0], "f8")
    section(zone, "Squares", 7, 1, 2, [1, 2, 5, 4, 2, 3, 6, 5])
    all = node(zone, "ZoneGridConnectivity", "ZoneGridConnectivity_t")
    for name, kind, location, own, donor in [("around", "Abutting1to1", "Vertex", [1, 4], [3, 6]),
                                             ("faces", "Abutting1to1", "FaceCenter", [1], [2]), ("over", "Overset", "Vertex", [2], [5])]:
        link = node(all, name, "GridConnectivity_t", "C1", "Zone")
        node(link, "GridConnectivityType", "GridConnectivityType_t", "C1", kind)
        node(link, "GridLocation", "GridLocation_t", "C1", location)
        node(link, "PointList", "IndexArray_t", "I4", numpy.array([own], dtype="i4"))
        node(link, "PointListDonor", "IndexArray_t", "I4", numpy.array([donor], dtype="i4"))
        periodic(link, [2, 0])
    f.close()


def linked():
    f, base = cgns("linked.cgns", [3, 3])
    base["Zone"] = h5py.ExternalLink("solids.cgns", "/Base/Zone")
    f.close()


def numbers_of_xdmf():
    with h5py.File(path("numbers.h5"), "w") as f:
        f["points"] = numpy.array(SOLIDS, dtype="f8")
        f.create_dataset("mesh/cells", data=numpy.array([8] + [n - 1 for n in WEDGE] + [9] + [n - 1 for n in CUBE], dtype="i4"))
        f.create_dataset("flat", data=numpy.array([(0, 0), (1, 0), (1, 1), (0, 1.5)], dtype="f4"), chunks=(2, 2), compression="gzip", shuffle=True)
        f["triangles"] = numpy.array([(0, 1, 2), (0, 2, 3)], dtype="u8")
        f["depth"] = numpy.array([1.0, 2.0, 3.0, 4.5])


def med_solids():
    """By meshio, with families of nodes and of cells, and fields."""
    kinds = [("wedge", WEDGE), ("hexahedron", CUBE), ("tetra", TETRAHEDRON), ("pyramid", PYRAMID), ("triangle", [1, 3, 2]), ("line", [22, 23])]
    mesh = meshio.Mesh(numpy.array(SOLIDS, dtype=float), [(kind, numpy.array([nodes]) - 1) for kind, nodes in kinds])
    mesh.point_tags = {1: ["peak"], 2: ["peak", "corners"]}
    mesh.cell_tags = {-1: ["left", "all"], -2: ["all"], -3: ["ground"]}
    mesh.point_data["point_tags"] = numpy.array([2] + 21 * [0] + [1])
    mesh.cell_data["cell_tags"] = [numpy.array([tag]) for tag in (-1, -2, -2, 0, -3, 0)]
    mesh.point_data["heat"] = numpy.arange(23.0)
    mesh.point_data["way"] = numpy.array([[i, 100.0 + i] for i in range(23)])
    mesh.cell_data["stress"] = [numpy.array([1.5 + k]) for k in range(6)]
    meshio.write(path("solids.med"), mesh)


def med_plane():
    """A mesh of the plane as MED 2 has it, without time steps, and another one behind it."""
    with h5py.File(path("plane.med"), "w") as f:
        for name, dimension in (("plate", 2), ("spare", 2)):
            mesh = f.create_group("ENS_MAA/" + name)
            mesh.attrs["DIM"] = mesh.attrs["ESP"] = dimension
            mesh.attrs["TYP"] = 0
            mesh["NOE/COO"] = numpy.array([0, 1, 1, 0, 2, 2, 0, 0, 1, 1.5, 0, 1], dtype="f8")
            mesh["MAI/TR3/NOD"] = numpy.array([1, 1, 2, 3, 3, 4], dtype="i4")
            mesh["MAI/QU4/NOD"] = numpy.array([2, 5, 6, 3], dtype="i4")


exodus("solids.e", "NETCDF3_CLASSIC", SOLIDS,
       [(7, "wood", "WEDGE", [WEDGE]), (9, "", "HEX", [CUBE]), (11, "rest", "TETRA", [TETRAHEDRON]), (12, "tip", "PYRAMID", [PYRAMID]),
        (13, "rods", "BEAM", [[2, 7], [8, 15]])],
       [(3, "corners", [1, 23])], [(5, "skin", [1, 1, 2, 3, 4], [4, 5, 1, 3, 5]), (6, "", [2], [6])], steps=3)
exodus("plane.e", "NETCDF3_64BIT_DATA", [(0, 0), (1, 0), (1, 1), (0, 1.5), (2, 0), (2, 1)],
       [(1, "left", "TRI3", [[1, 2, 3], [1, 3, 4]]), (2, "right", "quad", [[2, 5, 6, 3]])], (), [(1, "below", [1, 3], [1, 1])], real="f4",
       together=True)
exodus("plane4.e", "NETCDF4", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1.5, 0)], [(1, "sheet", "SHELL4", [[1, 2, 3, 4]])], [(2, "end", [2])],
       [(4, "top", [1, 1], [1, 3])], zlib=True)
unstructured()
structured()
periodic_blocks()
periodic_lists()
linked()
numbers_of_xdmf()
med_solids()
med_plane()
for name in ("solids.cgns", "zones.cgns", "periodic.cgns", "periodic_lists.cgns"):
    words = subprocess.run(["cgnscheck", path(name)], capture_output=True, text=True).stdout
    problems = [line for line in words.splitlines() if re.match(r"(ERROR|error|FATAL)", line.strip())]
    print(name, "cgnscheck:", problems or "no errors", file=sys.stderr)

print('''#pragma once
// Small files of named arrays. Made by array_samples.py with Python's netCDF4, h5py and meshio; not by hand.
// clang-format off

#include <array>
#include <string>
#include <string_view>

#include "core/base/base64.h"

namespace dmoscope::testing {

/// A file in base64, with [N] for N times the letter A.
inline std::string array_file(std::string_view text) {
  std::string letters;
  while (!text.empty()) {
    if (text.front() != '[') {
      letters += text.front();
      text.remove_prefix(1);
      continue;
    }
    const std::size_t end = text.find(']');
    letters.append(std::stoul(std::string(text.substr(1, end - 1))), 'A');
    text.remove_prefix(end + 1);
  }
  const auto bytes = from_base64(letters).value();
  return {bytes.begin(), bytes.end()};
}
''')
for name, file, what in [
        ("exodus_solids", "solids.e", "classic (CDF-1): a wedge, a cube, a tetrahedron, a pyramid and two rods; three time steps"),
        ("exodus_plane", "plane.e", "CDF-5, coordinates in one array of floats: two triangles and a square of the plane"),
        ("exodus_netcdf4", "plane4.e", "netCDF-4, packed: a shell"),
        ("cgns_solids", "solids.cgns", "the same solids as exodus_solids, in an unstructured zone"),
        ("cgns_zones", "zones.cgns", "two structured zones of the plane that share an edge: floats, and packed doubles"),
        ("cgns_periodic", "periodic.cgns", "two structured zones of the plane that share an edge, and the ends of which are one"),
        ("cgns_periodic_lists", "periodic_lists.cgns", "an unstructured zone of the plane whose ends are one, by a list of points"),
        ("cgns_linked", "linked.cgns", "a zone that is a link into another file"),
        ("med_solids", "solids.med", "MED, written by meshio: a wedge, a cube, a tetrahedron, a pyramid, a triangle and a line, with groups and fields"),
        ("med_plane", "plane.med", "MED 2: two meshes of the plane"),
        ("xdmf_numbers", "numbers.h5", "HDF5: what XDMF files refer to")]:
    text = base64.b64encode(open(path(file), "rb").read()).decode()
    text = re.sub(r"A{6,}", lambda run: f"[{len(run.group())}]", text)
    print(f"/// {what[0].upper()}{what[1:]}.\ninline std::string {name}() {{\n  return array_file(")
    print("\n".join(f'    "{text[i:i + 138]}"' for i in range(0, len(text), 138)) + ");\n}\n")
print("}  // namespace dmoscope::testing")
