// Reader of Exodus II: element blocks, node sets and side sets become groups, results of the last time step fields.

#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/exodus/exodus.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

constexpr std::uint64_t kMostBlocks = 1U << 16U;

/// Reader, see FormatHandler.
class ExodusReader {
 public:
  ExodusReader(SourceFile& source, const IoContext& context)
      : source_(source), progress_(context.progress), file_(open_netcdf(source, context)) {}

  Mesh read() {
    const CoordinateArrays coordinates = read_exodus_points(*file_, mesh_.positions);
    coordinates.describe(source_);
    space_ = source_.layout().components;
    if (file_->find("title")) mesh_.title = trimmed(file_->text("title"));
    blocks();
    rows_ = split_cells(cells_, labels_, mesh_, source_);
    if (cells_.dimension() < 2) fail("the file has no element of two or three dimensions");
    node_sets();
    side_sets();
    results();
    what_else();
    return std::move(mesh_);
  }

 private:
  struct Block {
    std::string called;                  // name in errors
    std::uint64_t first = 0, count = 0;  // range of cells, which include those of blocks with points
    bool shell = false;
  };

  [[noreturn]] void fail(const std::string& what) const { file_->fail(what); }

  std::uint64_t count(const std::string& dimension) const {
    const std::uint64_t found = file_->dimension(dimension).value_or(0);
    if (found > kMostBlocks) fail(fmt::format("damaged: {} is {}", dimension, found));
    return found;
  }

  /// The strings of an array, one for each row.
  std::vector<std::string> strings(const std::string& array) const {
    std::vector<std::string> rows;
    const auto info = file_->find(array);
    if (!info || !info->text || info->sizes.size() != 2) return rows;
    const std::string all = file_->text(array);
    const std::size_t length = info->sizes[1];
    for (std::uint64_t r = 0; r < info->sizes[0]; ++r) {
      const std::string_view row = std::string_view(all).substr(r * length, length);
      rows.emplace_back(trimmed(row.substr(0, row.find('\0'))));
    }
    return rows;
  }

  /// Numbers and names of blocks or sets: "eb_prop1", "eb_names".
  std::vector<GroupLabel> labels_of(const std::string& kind, std::string_view role, std::uint64_t count) const {
    std::vector<std::int64_t> ids;
    if (file_->find(kind + "_prop1")) ids = file_->wholes(kind + "_prop1");
    const std::vector<std::string> names = strings(kind + "_names");
    std::vector<GroupLabel> found;
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t id = i < ids.size() ? ids[i] : static_cast<std::int64_t>(i + 1);
      GroupLabel label{i < names.size() ? names[i] : "", std::string(role), 0};
      if (id > 0 && id <= std::numeric_limits<int>::max()) label.code = static_cast<int>(id);
      if (label.name.empty()) label.name = fmt::format("{} {}", role, id);
      found.push_back(std::move(label));
    }
    return found;
  }

  void blocks() {
    const std::uint64_t n = count("num_el_blk");
    const std::vector<GroupLabel> labels = labels_of("eb", kExodusBlock, n);
    for (std::uint64_t b = 0; b < n; ++b) {
      progress_.check();
      labels_.push_back({{labels[b]}, true});
      Block block{.called = fmt::format("element block {} ({})", b + 1, quote_token(labels[b].name)), .first = cells_.size()};
      if (file_->find(fmt::format("connect{}", b + 1))) {
        elements(block, b);
      } else if (file_->find(fmt::format("ebconn{}", b + 1)) || count(fmt::format("num_el_in_blk{}", b + 1)) > 0) {
        fail(fmt::format("{}: its elements are not given by their nodes, which is not read", block.called));
      }
      blocks_.push_back(std::move(block));
    }
  }

  void elements(Block& block, std::uint64_t number) {
    const std::string array = fmt::format("connect{}", number + 1);
    const auto info = file_->find(array);
    std::string word = file_->attribute(array, "elem_type");
    word.resize(std::min(word.find('\0'), word.size()));
    const std::uint64_t nodes = info->sizes.size() == 2 ? info->sizes[1] : 0;
    if (info->sizes.empty() || info->sizes[0] == 0) return;
    if (equal_ignoring_case(word.substr(0, 6), "nsided") || equal_ignoring_case(word.substr(0, 6), "nfaced")) {
      fail(fmt::format("{}: {} elements (polygons, polyhedra) are not read: convert them to triangles or tetrahedra", block.called,
                       quote_token(word)));
    }
    const auto shape = exodus_shape(word, nodes);
    if (!shape) {
      fail(fmt::format("{}: elements {} with {} nodes are not read: only elements without nodes beyond their corners are", block.called,
                       quote_token(word), nodes));
    }
    block.shell = is_exodus_shell(word);
    block.count = info->sizes[0];
    const std::vector<std::int64_t> all = file_->wholes(array);
    cells_.reserve_more(block.count, all.size());
    std::array<Index, 8> corners{};
    for (std::size_t e = 0; e < block.count; ++e) {
      for (std::size_t k = 0; k < nodes; ++k) corners[k] = vertex(all[e * nodes + k], block.called);
      cells_.add(*shape, corners.data(), static_cast<std::uint32_t>(number));
    }
  }

  [[nodiscard]] Index vertex(std::int64_t node, const std::string& of) const {
    if (node < 1 || static_cast<std::uint64_t>(node) > mesh_.positions.size()) {
      fail(fmt::format("{}: node {} out of range (the file has {} nodes)", of, node, mesh_.positions.size()));
    }
    return static_cast<Index>(node - 1);
  }

  void node_sets() {
    const std::uint64_t n = count("num_node_sets");
    const std::vector<GroupLabel> labels = labels_of("ns", kExodusNodeSet, n);
    for (std::uint64_t s = 0; s < n; ++s) {
      const std::string array = fmt::format("node_ns{}", s + 1);
      if (!file_->find(array)) continue;  // empty set
      Group group{.name = labels[s].name, .role = labels[s].role, .code = labels[s].code, .dimension = 0};
      for (const std::int64_t node : file_->wholes(array)) group.members.push_back(vertex(node, fmt::format("node set {}", s + 1)));
      if (!group.members.empty()) mesh_.groups.push_back(std::move(group));
    }
  }

  void side_sets() {
    const std::uint64_t n = count("num_side_sets");
    const std::vector<GroupLabel> labels = labels_of("ss", kExodusSideSet, n);
    corners_ = cells_.corners_by_cell();
    element_of_ = elements_of_cells(cells_, mesh_, rows_);
    shells_have_faces_ = space_ == 3;
    for (std::uint64_t s = 0; s < n && !shells_have_faces_; ++s) shells_have_faces_ = has_edge_behind_faces(s + 1);
    for (std::uint64_t s = 0; s < n; ++s) {
      const std::string elements = fmt::format("elem_ss{}", s + 1), sides = fmt::format("side_ss{}", s + 1);
      if (!file_->find(elements) || !file_->find(sides)) continue;  // empty set
      progress_.check();
      side_set(s + 1, labels[s], file_->wholes(elements), file_->wholes(sides));
    }
  }

  /// Whether a set has edges numbered behind two faces: writers differ about shells in a plane, whose edges may come first, or behind two
  /// faces, as in space. A side number beyond the number of corners proves the latter.
  [[nodiscard]] bool has_edge_behind_faces(std::uint64_t set) {
    const std::string elements = fmt::format("elem_ss{}", set), sides = fmt::format("side_ss{}", set);
    if (!file_->find(elements) || !file_->find(sides)) return false;
    const std::vector<std::int64_t> of = file_->wholes(elements), number = file_->wholes(sides);
    for (std::size_t i = 0; i < std::min(of.size(), number.size()); ++i) {
      if (of[i] < 1 || static_cast<std::uint64_t>(of[i]) > cells_.size()) continue;  // refused by side_set()
      const auto cell = static_cast<std::size_t>(of[i] - 1);
      const auto corners = static_cast<std::int64_t>(corners_of(cells_.shape(cell)));
      if (blocks_[cells_.origin(cell)].shell && number[i] > corners && number[i] <= corners + 2) return true;
    }
    return false;
  }

  void side_set(std::uint64_t number, const GroupLabel& label, const std::vector<std::int64_t>& elements,
                const std::vector<std::int64_t>& sides) {
    const std::string called = fmt::format("side set {}", number);
    if (elements.size() != sides.size()) fail(fmt::format("{}: {} elements, but {} sides", called, elements.size(), sides.size()));
    const auto group = [&](int dimension) {
      return Group{.name = label.name, .role = label.role, .code = label.code, .dimension = dimension};
    };
    Group edges = group(1), faces = group(2), whole = group(2);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (elements[i] < 1 || static_cast<std::uint64_t>(elements[i]) > cells_.size()) {
        fail(fmt::format("{}: element {} out of range (the file has {} elements)", called, elements[i], cells_.size()));
      }
      const auto cell = static_cast<std::size_t>(elements[i] - 1);
      const auto side = exodus_side(cells_.shape(cell), blocks_[cells_.origin(cell)].shell && shells_have_faces_, sides[i]);
      if (side.empty()) fail(fmt::format("{}: element {} has no side {}", called, elements[i], sides[i]));
      std::array<Index, 4> corners{};
      for (std::size_t k = 0; k < side.size(); ++k) corners[k] = corners_[cell][side[k]];
      if (side.size() == 2) {
        edges.members.insert(edges.members.end(), corners.begin(), corners.begin() + 2);
      } else if (cells_.dimension() == 2) {  // face of a shell in a mesh of shells
        whole.members.push_back(element_of_[cell]);
      } else {
        faces.faces.add(side.size() == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, {corners.data(), side.size()});
      }
    }
    for (Group* one : {&edges, &faces, &whole}) {
      if (!one->members.empty() || one->faces.size() > 0) mesh_.groups.push_back(std::move(*one));
    }
  }

  /// Reads results of the last time step.
  void results() {
    const std::vector<std::string> of_nodes = strings("name_nod_var"), of_elements = strings("name_elem_var");
    std::uint64_t steps = 0;
    if (const auto times = file_->find("time_whole"); times && !times->sizes.empty()) steps = times->sizes[0];
    if (of_nodes.empty() && of_elements.empty()) return;
    if (steps == 0) return source_.add_only_in_file("names of results without a time step");
    for (std::size_t i = 0; i < of_nodes.size(); ++i) node_results(of_nodes[i], i, steps - 1);
    for (std::size_t i = 0; i < of_elements.size(); ++i) element_results(of_elements[i], i, steps - 1);
    if (steps > 1) {
      source_.add_note(fmt::format("Its fields are those of the last of {} time steps.", steps));
      source_.add_only_in_file(fmt::format("{} earlier time steps", steps - 1));
    }
  }

  void node_results(const std::string& name, std::size_t i, std::uint64_t step) {
    std::string array = fmt::format("vals_nod_var{}", i + 1);
    std::vector<std::uint64_t> first{step};
    if (!file_->find(array)) {  // older files: all in one array
      array = "vals_nod_var";
      first.push_back(i);
    }
    const auto info = file_->find(array);
    if (!info || info->sizes.empty() || info->sizes[0] <= step) return source_.add_only_in_file("results without numbers");
    Field field = result(name, Field::On::Vertices, *info);
    field.values = file_->numbers(array, first);
    if (field.values.size() != mesh_.positions.size()) {
      fail(fmt::format("nodal variable {}: {} numbers for {} nodes", quote_token(name), field.values.size(), mesh_.positions.size()));
    }
    std::uint64_t row = 0;  // index of the row read, among rows of its size
    for (std::size_t k = 0; k < first.size(); ++k) row = row * info->sizes[k] + first[k];
    field.place.array = array;
    field.place.begin = row * field.values.size();
    mesh_.fields.push_back(std::move(field));
  }

  void element_results(const std::string& name, std::size_t i, std::uint64_t step) {
    std::vector<double> of_cells(cells_.size(), std::numeric_limits<double>::quiet_NaN());
    std::optional<Field> field;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      const std::string array = fmt::format("vals_elem_var{}eb{}", i + 1, b + 1);
      const auto info = file_->find(array);
      if (!info || info->sizes.empty() || info->sizes[0] <= step) continue;  // missing results of a block
      const std::vector<double> values = file_->numbers(array, std::vector<std::uint64_t>{step});
      if (values.size() != blocks_[b].count) {
        fail(fmt::format("{}: {} numbers of variable {} for {} elements", blocks_[b].called, values.size(), quote_token(name),
                         blocks_[b].count));
      }
      std::copy(values.begin(), values.end(), of_cells.begin() + static_cast<std::ptrdiff_t>(blocks_[b].first));
      if (!field) field = result(name, Field::On::Elements, *info);
    }
    if (!field) return source_.add_only_in_file("results without numbers");
    for (Index e = 0; e < mesh_.elements.size(); ++e) field->values.push_back(of_cells[rows_.empty() ? e : rows_[e]]);
    mesh_.fields.push_back(std::move(*field));
  }

  static Field result(const std::string& name, Field::On on, const ArrayInfo& info) {
    return {.name = name, .on = on, .type = std::string(vtk_word(info.type))};
  }

  /// Names data that stay in the file only.
  void what_else() {
    for (const char* name : {"num_fa_blk", "num_ed_blk", "num_elem_sets", "num_edge_sets", "num_face_sets"}) {
      if (count(name) > 0) source_.add_only_in_file("blocks and sets of edges and faces, sets of elements");
    }
    for (const auto& [array, thing] :
         {std::pair{"node_num_map", "numbers of its nodes"}, std::pair{"elem_num_map", "numbers of its elements"},
          std::pair{"elem_map", "an order of its elements"}, std::pair{"qa_records", "records of the programs that made it"},
          std::pair{"info_records", "information records"}, std::pair{"name_glo_var", "global results"},
          std::pair{"name_nset_var", "results on node sets"}, std::pair{"name_sset_var", "results on side sets"},
          std::pair{"attrib1", "attributes of elements"}, std::pair{"dist_fact_ns1", "distribution factors"},
          std::pair{"dist_fact_ss1", "distribution factors"}}) {
      if (file_->find(array)) source_.add_only_in_file(thing);
    }
  }

  SourceFile& source_;
  Progress& progress_;
  std::unique_ptr<ArrayFile> file_;
  Mesh mesh_;
  int space_ = 3;
  bool shells_have_faces_ = true;  // whether sides count the faces of shells before their edges
  CellTable cells_;
  std::vector<OriginLabels> labels_;
  std::vector<Block> blocks_;
  std::vector<Index> rows_;                      // cell of each element; empty: every cell is one
  std::vector<std::span<const Index>> corners_;  // corners of each cell
  std::vector<Index> element_of_;
};

}  // namespace

CoordinateArrays read_exodus_points(ArrayFile& file, std::vector<Vec3>& positions) {
  const auto nodes = file.dimension("num_nodes");
  const auto space = file.dimension("num_dim");
  if (!space || !nodes) file.fail("this is a netCDF file, but no Exodus file: it has no num_dim or no num_nodes");
  if (*space != 2 && *space != 3) file.fail(fmt::format("it has coordinates of {} dimensions; those of 2 or 3 are read", *space));
  const auto d = static_cast<int>(*space);
  if (*nodes >= kNoIndex) file.fail("too many nodes");
  const auto info = file.find(file.find("coord") ? "coord" : "coordx");
  if (!info || info->count() / (file.find("coord") ? *space : 1) != *nodes)
    file.fail("its coordinates are missing, or not as many as its nodes");
  file.take_room(*nodes, sizeof(Vec3));
  positions.assign(*nodes, Vec3{0.0, 0.0, 0.0});
  CoordinateArrays coordinates;
  const auto n = static_cast<Index>(*nodes);
  if (file.find("coord")) {
    coordinates.read(file, {.name = "coord", .components = d, .by_axis = true, .count = n}, positions);
    return coordinates;
  }
  for (int axis = 0; axis < d; ++axis) {
    const std::string name = fmt::format("coord{}", "xyz"[axis]);
    coordinates.read(file, {.name = name, .axis = axis, .count = n}, positions);
  }
  return coordinates;
}

namespace {

Notes patch_exodus(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  Notes notes;
  const std::unique_ptr<ArrayFile> arrays = open_netcdf(*mesh.source, context);
  std::vector<Vec3> before;
  const CoordinateArrays coordinates = read_exodus_points(*arrays, before);
  const auto steps = arrays->find("time_whole");
  if (!moved.fields.empty() && steps && steps->count() > 1)
    notes.emplace_back("Fields of earlier time steps were carried: those of the last one alone were taken anew.");
  file.write(coordinates.replaced(*arrays, mesh.positions, moved.positions, file.path().string(), notes,
                                  changed_arrays(*arrays, mesh, moved.fields, notes)));
  return notes;
}

/// Whether the bytes begin an Exodus file: names of dimensions are in the header of a classic file; an HDF5 file has them anywhere.
bool recognises_exodus(std::string_view bytes) {
  constexpr std::size_t kLook = std::size_t{1} << 18U;
  if (!is_netcdf_classic(bytes) && !is_hdf5(bytes)) return false;
  return bytes.substr(0, kLook).find("num_el_blk") != std::string_view::npos;
}

}  // namespace

constinit const FormatHandler kExodusFormat{
    .info = {"exodus", "Exodus II", ".e .exo .g .ex2",
#ifdef DMOSCOPE_HDF5
             "2D and 3D elements, element blocks, node and side sets, results of the last time step; only written "
             "where it was read"},
#else
             "2D and 3D elements, element blocks, node and side sets, results of the last time step; only written "
             "where it was read; without netCDF-4, for this build was made without HDF5"},
#endif
    .recognises = recognises_exodus,
    .read = read_with<ExodusReader>,
    .patch = patch_exodus,
    .not_written = "Exodus files are written only where one was read: write it as .vtu or .msh"};

}  // namespace dmoscope
