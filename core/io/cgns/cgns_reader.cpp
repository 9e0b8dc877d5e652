// Reader of CGNS: zones, sections, boundary conditions and families become groups, solutions fields.

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/cgns/cgns.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

/// The last solutions of a zone, at its vertices and at its cells.
struct CgnsSolutions {
  std::optional<CgnsNode> of_vertices, of_cells;
  std::size_t many = 0;
  bool elsewhere = false;
};

CgnsSolutions read_solutions(const CgnsTree& tree, const CgnsZone& zone) {
  CgnsSolutions found;
  for (const CgnsNode& node : tree.children(zone.node, "FlowSolution_t")) {
    const auto location = tree.child(node, "GridLocation_t");
    const std::string where = location ? tree.text(*location) : "Vertex";
    ++found.many;
    if (where == "Vertex")
      found.of_vertices = node;
    else if (where == "CellCenter")
      found.of_cells = node;
    else
      found.elsewhere = true;
  }
  return found;
}

bool has_rind(const CgnsTree& tree, const CgnsNode& solution) { return !tree.children(solution, "Rind_t").empty(); }

class CgnsReader {
 public:
  CgnsReader(SourceFile& source, const IoContext& context)
      : source_(source), progress_(context.progress), file_(source.bytes(), source.path().string(), context), tree_(file_) {}

  Mesh read() {
    CgnsPoints points = read_cgns_points(tree_, &source_);
    points.coordinates.describe(source_);
    mesh_.title = points.base;
    CgnsCells cells = read_cgns_cells(tree_, points, source_, progress_);
    if (cells.cells.dimension() < 2) file_.fail("the file has no element of two or three dimensions");
    mesh_.positions = std::move(points.positions);
    rows_ = split_cells(cells.cells, cells.labels, mesh_, source_);
    for (Group& group : cells.vertex_groups) {
      if (!group.members.empty()) mesh_.groups.push_back(std::move(group));
    }
    element_of_cells(cells);
    for (std::size_t z = 0; z < points.zones.size(); ++z) solutions(points, z);
    for (Field& field : fields_) mesh_.fields.push_back(std::move(field));
    mesh_.periodic = read_cgns_pairs(tree_, points);
    say(points);
    return std::move(mesh_);
  }

 private:
  /// Finds the elements of each zone, which are consecutive.
  void element_of_cells(const CgnsCells& cells) {
    Index element = 0;
    for (const std::size_t first : cells.first_cell) {
      while (element < mesh_.elements.size() && (rows_.empty() ? element : rows_[element]) < first) ++element;
      first_element_.push_back(element);
    }
  }

  void solutions(const CgnsPoints& points, std::size_t z) {
    const CgnsSolutions found = read_solutions(tree_, points.zones[z]);
    if (found.elsewhere) source_.add_only_in_file("solutions elsewhere than at vertices and cells");
    if (found.many > std::size_t{found.of_vertices.has_value()} + std::size_t{found.of_cells.has_value()})
      source_.add_only_in_file("earlier solutions");
    if (found.of_vertices) solution(points, z, *found.of_vertices, Field::On::Vertices);
    if (found.of_cells) solution(points, z, *found.of_cells, Field::On::Elements);
  }

  void solution(const CgnsPoints& points, std::size_t z, const CgnsNode& node, Field::On on) {
    if (has_rind(tree_, node)) return source_.add_only_in_file("solutions with rind cells");
    const CgnsZone& zone = points.zones[z];
    const std::size_t expected = on == Field::On::Vertices ? zone.count : first_element_[z + 1] - first_element_[z];
    for (const CgnsNode& array : tree_.children(node, "DataArray_t")) {
      const auto info = file_.find(CgnsTree::array(array));
      if (!info || info->text) {
        source_.add_only_in_file("parts of solutions");
        continue;
      }
      if (info->count() != expected) {
        tree_.fail(array, fmt::format("{} numbers for {} {}", info->count(), expected, on == Field::On::Vertices ? "points" : "cells"));
      }
      const std::vector<double> values = file_.numbers(CgnsTree::array(array));
      Field& field = field_of(array.name, on, *info);
      for (std::size_t i = 0; i < values.size(); ++i) {
        field.values[on == Field::On::Vertices ? points.vertex_of[zone.first + i] : first_element_[z] + i] = values[i];
      }
    }
  }

  /// The field of this name; created without numbers if it is new: zones need not all have it.
  Field& field_of(const std::string& name, Field::On on, const ArrayInfo& info) {
    for (Field& field : fields_) {
      if (field.name == name && field.on == on) return field;
    }
    const std::size_t things = on == Field::On::Vertices ? mesh_.positions.size() : mesh_.elements.size();
    file_.take_room(things, sizeof(double));
    fields_.push_back({.name = name,
                       .on = on,
                       .type = std::string(vtk_word(info.type)),
                       .values = std::vector<double>(things, std::numeric_limits<double>::quiet_NaN())});
    return fields_.back();
  }

  void say(const CgnsPoints& points) {
    if (points.zones.size() > 1) {
      source_.add_note(fmt::format("{} zones were read as one mesh; {} points that lie on one of another zone are one vertex with it.",
                                   points.zones.size(), points.joined));
      source_.add_only_in_file(fmt::format("division into {} zones", points.zones.size()));
    }
    if (std::ranges::any_of(points.zones, &CgnsZone::structured)) source_.add_only_in_file("order of its points in blocks");
    for (const CgnsZone& zone : points.zones) {
      for (const auto& [label, thing] :
           {std::pair{"ZoneGridConnectivity_t", "connections of its zones"}, std::pair{"DiscreteData_t", "discrete data"},
            std::pair{"ZoneSubRegion_t", "regions of its zones"}, std::pair{"ZoneIterativeData_t", "what it says of time steps"}}) {
        if (tree_.child(zone.node, label)) source_.add_only_in_file(thing);
      }
    }
  }

  SourceFile& source_;
  Progress& progress_;
  Hdf5File file_;
  CgnsTree tree_;
  Mesh mesh_;
  std::vector<Index> rows_;           // cell of each element; empty: every cell is one
  std::vector<Index> first_element_;  // first element of each zone, and the number of elements
  std::vector<Field> fields_;
};

/// Whether it is an older kind of CGNS file, without HDF5.
bool is_adf(std::string_view bytes) { return bytes.substr(0, 32).find("ADF Database") != std::string_view::npos; }

/// Arrays of solutions at vertices whose fields changed.
std::vector<ArrayValues> changed_solutions(Hdf5File& file, const CgnsPoints& points, const Mesh& mesh,
                                           std::span<const FieldValues> fields) {
  const CgnsTree tree(file);
  std::vector<ArrayValues> changed;
  for (const CgnsZone& zone : points.zones) {
    const std::optional<CgnsNode> solution = read_solutions(tree, zone).of_vertices;
    if (!solution || has_rind(tree, *solution)) continue;
    for (const CgnsNode& array : tree.children(*solution, "DataArray_t")) {
      const auto found = std::ranges::find_if(fields, [&](const FieldValues& one) {
        return mesh.fields[one.field].name == array.name && mesh.fields[one.field].on == Field::On::Vertices;
      });
      if (found == fields.end()) continue;
      changed.push_back({CgnsTree::array(array), std::vector<double>(zone.count)});
      for (std::size_t i = 0; i < zone.count; ++i) changed.back().values[i] = found->values[points.vertex_of[zone.first + i]];
    }
  }
  return changed;
}

Notes patch_cgns(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  Notes notes;
  Hdf5File arrays(mesh.source->bytes(), mesh.source->path().string(), context);
  const CgnsPoints points = read_cgns_points(CgnsTree(arrays), nullptr);
  file.write(points.coordinates.replaced(arrays, mesh.positions, moved.positions, file.path().string(), notes,
                                         changed_solutions(arrays, points, mesh, moved.fields)));
  return notes;
}

bool recognises_cgns(std::string_view bytes) {
  constexpr std::size_t kLook = std::size_t{1} << 18U;
  return is_adf(bytes) || (is_hdf5(bytes) && bytes.substr(0, kLook).find("CGNSLibraryVersion") != std::string_view::npos);
}

Mesh read_cgns(SourceFile& source, const IoContext& context) {
  if (is_adf(source.bytes())) {
    throw InputError(source.path().string(), 0,
                     "this is a CGNS file of the older kind (ADF), which is not read: convert it with adf2hdf or cgnsconvert -h");
  }
  if (!is_hdf5(source.bytes())) throw InputError(source.path().string(), 0, "this is no HDF5 file, which a CGNS file is");
  return CgnsReader(source, context).read();
}

}  // namespace

constinit const FormatHandler kCgnsFormat{
    .info = {"cgns", "CGNS", ".cgns",
             "unstructured and structured zones in HDF5, boundary conditions, families, solutions; only written where it was read"},
    .recognises = recognises_cgns,
    .read = read_cgns,
    .patch = patch_cgns,
    .not_written = "CGNS files are written only where one was read: write it as .vtu or .msh"};

}  // namespace dmoscope
