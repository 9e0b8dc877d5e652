// MED files of Salome and Code_Aster (.med, .rmed, .mmed): HDF5 files, whose arrays hold all first components before all second ones.
// https://docs.salome-platform.org/latest/dev/MEDCoupling/developer/med-file.html

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/io/array_patch.h"
#include "core/io/arrays/hdf5_file.h"
#include "core/io/cell_table.h"
#include "core/io/format.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

constexpr std::string_view kMedGroup = "group", kWhole = "MED_NO_PROFILE_INTERNAL";
/// Name of each CellShape. Volume elements are wound the other way round, which is taken from their places.
constexpr std::array<std::string_view, kCellShapeCount> kMedTypes{"PO1", "SE2", "TR3", "QU4", "TE4", "HE8", "PE6", "PY5"};

/// Words of a text of fixed length, without the blanks and zeros that fill it.
std::string without_padding(std::string_view text) {
  text = text.substr(0, text.find('\0'));
  const std::size_t end = text.find_last_not_of(' ');
  return std::string(text.substr(0, end == std::string_view::npos ? 0 : end + 1));
}

/// Mesh of a file: its place in the tree, and the number of coordinates of a point.
struct MedMesh {
  std::string name, path;
  int space = 3;
  std::size_t meshes = 0, steps = 1;
};

MedMesh find_mesh(Hdf5File& file) {
  MedMesh found;
  const std::vector<std::string> meshes = file.children("/ENS_MAA");
  if (meshes.empty()) file.fail("this is an HDF5 file, but it holds no mesh of MED (ENS_MAA)");
  found.name = meshes.front();
  found.meshes = meshes.size();
  const std::string root = "/ENS_MAA/" + found.name;
  if (file.whole_attribute(root, "TYP").value_or(0) == 1)
    file.fail(fmt::format("mesh {} is structured, which is not read", quote_token(found.name)));
  const std::int64_t space = file.whole_attribute(root, "ESP").value_or(file.whole_attribute(root, "DIM").value_or(3));
  if (space != 2 && space != 3) file.fail(fmt::format("it has coordinates of {} dimensions; those of 2 or 3 are read", space));
  found.space = static_cast<int>(space);
  const std::vector<std::string> steps = file.children(root);  // older files have the mesh itself here
  found.steps = std::ranges::find(steps, "NOE") != steps.end() ? 1 : steps.size();
  if (steps.empty()) file.fail(fmt::format("mesh {} has no nodes", quote_token(found.name)));
  found.path = found.steps == 1 && std::ranges::find(steps, "NOE") != steps.end() ? root : root + "/" + steps.front();
  return found;
}

CoordinateArrays read_points(Hdf5File& file, const MedMesh& mesh, std::vector<Vec3>& positions) {
  const std::string name = mesh.path + "/NOE/COO";
  const auto info = file.find(name);
  const auto each = static_cast<std::uint64_t>(mesh.space);
  if (!info || info->text || info->count() % each != 0)
    file.fail(fmt::format("array {}: it does not hold the coordinates of points", quote_token(name)));
  const std::uint64_t points = info->count() / each;
  if (points >= kNoIndex) file.fail("too many nodes");
  file.take_room(points, sizeof(Vec3));
  positions.assign(points, Vec3{0.0, 0.0, 0.0});
  CoordinateArrays coordinates;
  coordinates.read(file, {.name = name, .components = mesh.space, .by_axis = true, .count = static_cast<Index>(points)}, positions);
  return coordinates;
}

class MedReader {
 public:
  MedReader(SourceFile& source, const IoContext& context)
      : source_(source), progress_(context.progress), file_(source.bytes(), source.path().string(), context), from_(find_mesh(file_)) {}

  Mesh read() {
    read_points(file_, from_, mesh_.positions).describe(source_);
    mesh_.title = from_.name;
    for (const auto& [number, labels] : families("NOEUD")) groups_of_nodes_[number] = labels;
    groups_of_cells_ = families("ELEME");
    cells();
    if (cells_.dimension() < 2) file_.fail("the file has no element of two or three dimensions");
    rows_ = split_cells(cells_, labels_, mesh_, source_);
    node_groups();
    for (const std::string& field : file_.children("/CHA")) results(field);
    if (from_.meshes > 1) source_.add_only_in_file(fmt::format("{} other meshes", from_.meshes - 1));
    if (from_.steps > 1) source_.add_only_in_file(fmt::format("the mesh at {} later time steps", from_.steps - 1));
    if (file_.find(from_.path + "/NOE/NUM")) source_.add_only_in_file("numbers of its nodes");
    return std::move(mesh_);
  }

 private:
  using Families = std::map<std::int64_t, std::vector<GroupLabel>>;
  struct Block {
    std::string type;
    std::size_t first, count;
  };

  /// Groups of each family of nodes (NOEUD) or cells (ELEME), which is the set of those in the same groups.
  Families families(std::string_view of) {
    Families found;
    const std::string root = fmt::format("/FAS/{}/{}", from_.name, of);
    for (const std::string& family : file_.children(root)) {
      const std::string path = root + "/" + family, names = path + "/GRO/NOM";
      const auto number = file_.whole_attribute(path, "NUM");
      if (!number || !file_.find(names)) continue;
      const ArrayInfo info = *file_.find(names);
      const std::string text = file_.text(names);
      const std::size_t each = info.sizes.empty() ? text.size() : info.sizes.back();
      for (std::size_t at = 0; each > 0 && at + each <= text.size(); at += each)
        found[*number].push_back({without_padding(std::string_view(text).substr(at, each)), std::string(kMedGroup), 0});
    }
    return found;
  }

  /// Reads the cells of each type, in our order of the types.
  void cells() {
    const std::string root = from_.path + "/MAI";
    const std::vector<std::string> types = file_.children(root);
    for (const std::string& type : types)
      if (std::ranges::find(kMedTypes, type) == kMedTypes.end())
        file_.fail(
            fmt::format("elements of type {}: only linear ones with straight sides are read; make others linear in Salome "
                        "(Modification, Convert to/from quadratic)",
                        quote_token(type)));
    std::map<std::int64_t, std::uint32_t> origins;
    for (std::size_t shape = 0; shape < kCellShapeCount; ++shape) {
      progress_.check();
      const std::string type(kMedTypes[shape]);
      if (std::ranges::find(types, type) != types.end()) block(type, root + "/" + type, static_cast<CellShape>(shape), origins);
    }
  }

  void block(const std::string& type, const std::string& path, CellShape shape, std::map<std::int64_t, std::uint32_t>& origins) {
    const std::vector<std::int64_t> nodes = file_.wholes(path + "/NOD");
    const std::size_t corners = corners_of(shape), count = nodes.size() / corners;
    if (nodes.size() % corners != 0)
      file_.fail(fmt::format("array {}: {} numbers for elements of {} corners", quote_token(path + "/NOD"), nodes.size(), corners));
    const std::vector<std::int64_t> family = file_.find(path + "/FAM") ? file_.wholes(path + "/FAM") : std::vector<std::int64_t>(count, 0);
    if (family.size() != count)
      file_.fail(fmt::format("array {}: {} numbers for {} elements", quote_token(path + "/FAM"), family.size(), count));
    file_.take_room(count, sizeof(Index) * (corners + 2));
    cells_.reserve_more(count, count * corners);
    blocks_.push_back({type, cells_.size(), count});
    std::array<Index, 8> at{};
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < corners; ++k) {
        const std::int64_t node = nodes[k * count + i];
        if (node < 1 || node > static_cast<std::int64_t>(mesh_.positions.size()))
          file_.fail(
              fmt::format("array {}: element {} names node {}, of {}", quote_token(path + "/NOD"), i + 1, node, mesh_.positions.size()));
        at[k] = static_cast<Index>(node - 1);
      }
      const auto [origin, is_new] = origins.try_emplace(family[i], static_cast<std::uint32_t>(labels_.size()));
      if (is_new) labels_.push_back({groups_of_cells_[family[i]]});
      cells_.add(shape, at.data(), origin->second);
    }
  }

  void node_groups() {
    const std::string name = from_.path + "/NOE/FAM";
    if (!file_.find(name)) return;
    const std::vector<std::int64_t> family = file_.wholes(name);
    if (family.size() != mesh_.positions.size())
      file_.fail(fmt::format("array {}: {} numbers for {} nodes", quote_token(name), family.size(), mesh_.positions.size()));
    std::map<std::string, Group> groups;
    for (Index v = 0; v < family.size(); ++v) {
      const auto found = groups_of_nodes_.find(family[v]);
      if (found == groups_of_nodes_.end()) continue;
      for (const GroupLabel& label : found->second)
        groups.try_emplace(label.name, Group{.name = label.name, .role = label.role}).first->second.members.push_back(v);
    }
    for (auto& [key, group] : groups) mesh_.groups.push_back(std::move(group));
  }

  /// Reads the last time step of a field, each component as a field of its own, since the file has them one after the other.
  void results(const std::string& name) {
    const std::string root = "/CHA/" + name;
    const std::vector<std::string> steps = file_.children(root);
    if (steps.empty()) return;
    if (steps.size() > 1) source_.add_only_in_file(fmt::format("earlier time steps of {}", quote_token(name)));
    const auto components = static_cast<std::size_t>(std::clamp<std::int64_t>(file_.whole_attribute(root, "NCO").value_or(1), 1, 1000));
    const std::string names = file_.attribute(root, "NOM");
    for (std::size_t c = 0; c < components; ++c) {
      constexpr std::size_t kLetters = 16;
      const std::string part = c * kLetters < names.size() ? without_padding(std::string_view(names).substr(c * kLetters, kLetters)) : "";
      component(root + "/" + steps.back(), components == 1 ? name : fmt::format("{}.{}", name, part.empty() ? std::to_string(c + 1) : part),
                c, components);
    }
  }

  void component(const std::string& step, const std::string& name, std::size_t c, std::size_t components) {
    std::vector<double> of_cells;
    std::optional<ArrayInfo> type;
    for (const std::string& support : file_.children(step)) {
      const std::string array = fmt::format("{}/{}/{}/CO", step, support, kWhole);
      const auto info = file_.find(array);
      const auto block = std::ranges::find_if(blocks_, [&](const Block& one) { return support == "MAI." + one.type; });
      const std::size_t rows = support == "NOE" ? mesh_.positions.size() : block != blocks_.end() ? block->count : 0;
      if (!info || info->text || rows == 0 || info->count() != rows * components) {
        source_.add_only_in_file(fmt::format("parts of field {}", quote_token(name)));
        continue;
      }
      const std::vector<double> values = file_.numbers(array);
      const auto from = values.begin() + static_cast<std::ptrdiff_t>(c * rows), to = from + static_cast<std::ptrdiff_t>(rows);
      if (support == "NOE") {
        mesh_.fields.push_back({.name = name, .type = std::string(vtk_word(info->type)), .values = {from, to}});
        mesh_.fields.back().place.array = array;
        mesh_.fields.back().place.begin = c * rows;
      } else {
        of_cells.resize(cells_.size(), std::numeric_limits<double>::quiet_NaN());
        std::copy(from, to, of_cells.begin() + static_cast<std::ptrdiff_t>(block->first));
        type = info;
      }
    }
    if (!type) return;
    Field field{.name = name, .on = Field::On::Elements, .type = std::string(vtk_word(type->type))};
    for (Index e = 0; e < mesh_.elements.size(); ++e) field.values.push_back(of_cells[rows_.empty() ? e : rows_[e]]);
    mesh_.fields.push_back(std::move(field));
  }

  SourceFile& source_;
  Progress& progress_;
  Hdf5File file_;
  MedMesh from_;
  Mesh mesh_;
  Families groups_of_nodes_, groups_of_cells_;
  CellTable cells_;
  std::vector<OriginLabels> labels_;
  std::vector<Block> blocks_;
  std::vector<Index> rows_;  // cell of each element; empty: every cell is one
};

Mesh read_med(SourceFile& source, const IoContext& context) {
  if (!is_hdf5(source.bytes())) throw InputError(source.path().string(), 0, "this is no HDF5 file, which a MED file is");
  return MedReader(source, context).read();
}

Notes patch_med(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  Notes notes;
  if (same_bits(mesh.positions, moved.positions) && moved.fields.empty()) {
    file.write(mesh.source->bytes());
    return notes;
  }
  Hdf5File arrays(mesh.source->bytes(), mesh.source->path().string(), context);
  std::vector<Vec3> before;
  const CoordinateArrays coordinates = read_points(arrays, find_mesh(arrays), before);
  file.write(coordinates.replaced(arrays, mesh.positions, moved.positions, file.path().string(), notes,
                                  changed_arrays(arrays, mesh, moved.fields, notes)));
  return notes;
}

bool recognises_med(std::string_view bytes) {
  constexpr std::size_t kLook = std::size_t{1} << 18U;
  return is_hdf5(bytes) && bytes.substr(0, kLook).find("ENS_MAA") != std::string_view::npos;
}

}  // namespace

constinit const FormatHandler kMedFormat{
    .info = {"med", "MED", ".med .mmed .rmed", "one mesh in HDF5, groups, results of the last time step; only written where it was read"},
    .recognises = recognises_med,
    .read = read_med,
    .patch = patch_med,
    .not_written = "MED files are written only where one was read: write it as .vtu or .msh"};

}  // namespace dmoscope
