// ADCIRC's grid file, fort.14 or .grd, and SCHISM's .gr3 and .ll, whose coordinates may be longitude and latitude: nodes with depth,
// elements, open and land boundaries.
// https://adcirc.org/home/documentation/users-manual-v53/input-file-descriptions/adcirc-grid-and-boundary-information-file-fort-14/

#include "core/io/solvers/fort14.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/number_in.h"
#include "core/io/format.h"
#include "core/io/numbered_mesh.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {

namespace {

/// Columns behind the node number in a line of a land boundary, by IBTYPE: the node on a weir's other side, then heights and coefficients.
struct WeirColumns {
  bool pair = false;
  int numbers = 0;
};
WeirColumns weir_columns(int type) {
  switch (type) {
    case 3:
    case 13:
    case 23:
      return {false, 2};
    case 4:
    case 24:
      return {true, 3};
    case 5:
    case 25:
      return {true, 5};  // a sixth, the pipe's diameter, is missing in some files
    default:
      return {};
  }
}

class BoundaryReader {
 public:
  BoundaryReader(Tokenizer& tokens, const std::function<Index(Tokenizer&, std::string_view)>& number, SourceFile* source)
      : tokens_(tokens), number_(number), source_(source) {}

  /// Reads the boundaries; a file may end before them, or after the open ones.
  std::vector<Group> read() {
    constexpr std::size_t kShortestBoundary = 2;  // bytes of "0\n"
    if (tokens_.at_end()) return std::move(groups_);
    const std::size_t open = tokens_.read_count("number of open boundaries", kShortestBoundary);
    tokens_.end_line();
    read_total(open, "number of open boundary vertices");
    for (std::size_t b = 0; b < open; ++b) read_open(b);
    if (tokens_.at_end()) return std::move(groups_);
    const std::size_t land = tokens_.read_count("number of land boundaries", kShortestBoundary);
    tokens_.end_line();
    read_total(land, "number of land boundary vertices");
    for (std::size_t b = 0; b < land; ++b) read_land(b);
    if (tokens_.at_end()) return std::move(groups_);
    if (source_ == nullptr) return std::move(groups_);
    source_->add_note(fmt::format("The file goes on after its boundaries (line {}); the rest is kept but not read.", tokens_.line()));
    source_->add_only_in_file("what follows the boundaries");
    return std::move(groups_);
  }

 private:
  void begin_line(std::string_view what) {
    if (tokens_.at_end()) tokens_.fail_at_end(what);
  }

  /// Skips the sum over all boundaries: nothing depends on it, and it is often wrong. Some files end before it if there are no boundaries.
  void read_total(std::size_t boundaries, std::string_view what) {
    if (boundaries == 0 && tokens_.at_end()) return;
    begin_line(what);
    (void)tokens_.read_integer(what);
    tokens_.end_line();
  }

  std::size_t read_size() {
    begin_line("number of vertices of a boundary");
    return tokens_.read_count("number of vertices of a boundary", 2);
  }

  void read_open(std::size_t b) {
    Group group{.name = fmt::format("{} {}", kFort14Open, b + 1), .role = std::string(kFort14Open), .code = 0, .dimension = 0};
    const std::size_t size = read_size();
    const std::string_view type = tokens_.token_on_line();  // IBTYPEE may be missing, with a remark in its place
    group.code = number_in<int>(type).value_or(0);
    tokens_.end_line();
    group.members.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      begin_line("vertex of an open boundary");
      group.members.push_back(number_(tokens_, "vertex index"));
      tokens_.end_numbers_of("a vertex of a boundary");
    }
    groups_.push_back(std::move(group));
  }

  /// Type of a land boundary. SCHISM's files may have a remark in its place, which tells an island (1) from a mainland (0).
  int read_land_type() {
    Tokenizer ahead = tokens_;
    const std::string_view word = ahead.token_on_line();
    if (word.starts_with('=') || word.starts_with('!')) return ahead.rest_of_line().find("sland") != std::string_view::npos ? 1 : 0;
    const std::int64_t type = tokens_.read_integer("type of a land boundary (IBTYPE)");
    if (type < -1000000 || type > 1000000) tokens_.fail(fmt::format("type of a land boundary (IBTYPE) out of range: {}", type));
    return static_cast<int>(type);
  }

  void read_land(std::size_t b) {
    Group group{.name = fmt::format("{} {}", kFort14Land, b + 1), .role = std::string(kFort14Land), .code = 0, .dimension = 0};
    const std::size_t size = read_size();
    group.code = read_land_type();
    tokens_.end_line();
    const WeirColumns columns = weir_columns(group.code);
    if (is_fort14_weir(group.code) && source_ != nullptr)
      source_->add_only_in_file("heights, coefficients and pairs of vertices of the weirs");
    // Adds a group for the far bank of a weir: the file lists both banks in one string, the farther one beside the nearer.
    Group far_side{.name = group.name + ", far side", .role = group.role, .code = group.code, .dimension = 0};
    group.members.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      begin_line("vertex of a land boundary");
      group.members.push_back(number_(tokens_, "vertex index"));
      if (columns.pair) far_side.members.push_back(number_(tokens_, "vertex index"));
      for (int n = 0; n < columns.numbers; ++n) (void)tokens_.read_double("height or coefficient of a weir");
      tokens_.end_line();
    }
    groups_.push_back(std::move(group));
    if (columns.pair) groups_.push_back(std::move(far_side));
  }

  Tokenizer& tokens_;
  const std::function<Index(Tokenizer&, std::string_view)>& number_;
  SourceFile* source_;
  std::vector<Group> groups_;
};

}  // namespace

Fort14Head read_fort14_head(Tokenizer& tokens) {
  constexpr std::size_t kShortestElement = 10;  // bytes of "1 3 1 2 3\n"
  constexpr std::size_t kShortestNode = 8;      // bytes of "1 0 0 0\n"
  Fort14Head head;
  head.title = trimmed(tokens.rest_of_line());
  if (tokens.at_end()) tokens.fail_at_end("number of elements");
  head.elements = tokens.read_count("number of elements", kShortestElement);
  head.nodes = tokens.read_count("number of vertices", kShortestNode);
  tokens.end_line();
  return head;
}

Fort14Node read_fort14_node(Tokenizer& tokens) {
  if (tokens.at_end()) tokens.fail_at_end("number of a vertex");
  Fort14Node node;
  node.number = tokens.read_integer("number of a vertex");
  node.position = tokens.read_point(2, node.place);
  node.depth = tokens.read_double("depth");
  tokens.end_numbers_of("a vertex");
  return node;
}

std::size_t read_fort14_element(Tokenizer& tokens) {
  if (tokens.at_end()) tokens.fail_at_end("number of an element");
  (void)tokens.read_integer("number of an element");
  const std::int64_t corners = tokens.read_integer("number of corners");
  if (corners != 3 && corners != 4)
    tokens.fail(fmt::format("element with {} corners: only triangles and quadrilaterals are read", corners));
  return static_cast<std::size_t>(corners);
}

bool is_fort14_weir(int type) { return weir_columns(type).numbers > 0; }

std::vector<Group> read_fort14_boundaries(Tokenizer& tokens, const std::function<Index(Tokenizer&, std::string_view)>& number,
                                          SourceFile* source) {
  return BoundaryReader(tokens, number, source).read();
}

namespace {

class Reader {
 public:
  Reader(SourceFile& source, const IoContext& context)
      : source_(source), tokens_(source.bytes(), source.path().string(), kFort14Syntax, context.progress) {
    source.set_layout({.components = 2, .syntax = kFort14Syntax});
  }

  Mesh read() {
    const Fort14Head head = read_fort14_head(tokens_);
    mesh_.title = head.title;
    read_nodes(head.nodes);
    read_elements(head.elements);
    mesh_.groups = read_fort14_boundaries(
        tokens_, [this](Tokenizer& tokens, std::string_view what) { return vertex(tokens, what); }, &source_);
    return std::move(mesh_);
  }

 private:
  void read_nodes(std::size_t count) {
    Field depth{.name = "depth", .on = Field::On::Vertices, .type = "double", .role = "depth", .place = {.with_positions = true, .at = 2}};
    reserve_large(mesh_.positions, count);
    reserve_large(depth.values, count);
    source_.reserve_places(count);
    for (std::size_t v = 0; v < count; ++v) {
      const Fort14Node node = read_fort14_node(tokens_);
      numbers_.add(node.number);
      source_.add_place(node.place);
      mesh_.positions.push_back(node.position);
      depth.values.push_back(node.depth);
    }
    if (const auto twice = numbers_.finish()) {
      tokens_.fail_at(tokens_.line_at(source_.place(*twice)), fmt::format("vertex {} has the number of one before it", *twice + 1));
    }
    mesh_.fields.push_back(std::move(depth));
  }

  /// Reads a node's number. Throws InputError if no node has it.
  [[nodiscard]] Index vertex(Tokenizer& tokens, std::string_view what) const {
    if (numbers_.count_from_one()) return tokens.read_index(what, numbers_.size(), "vertices", 1);
    const std::int64_t number = tokens.read_integer(what);
    const Index found = numbers_.find(number);
    if (found == kNoIndex) tokens.fail(fmt::format("{} {}: no vertex has this number", what, number));
    return found;
  }

  void read_elements(std::size_t count) {
    mesh_.elements.reserve(count, 3 * count);
    for (std::size_t e = 0; e < count; ++e) {
      const std::size_t corners = read_fort14_element(tokens_);
      std::array<Index, 4> corner{};
      const std::span<Index> used(corner.data(), corners);
      for (Index& c : used) c = vertex(tokens_, "vertex index");
      add_element(mesh_, corners == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, used, source_);
      tokens_.end_numbers_of("an element");
    }
  }

  SourceFile& source_;
  Tokenizer tokens_;
  Mesh mesh_;
  TagPlaces numbers_;  // numbers of the nodes, mostly 1, 2, ...
};

// --- Writing new files ---

/// Whether a field is an elevation (of a 2dm file), which counts upwards; a depth counts downwards.
bool is_elevation(const Field& field) { return field.role == "elevation"; }

/// The field that becomes the depth: the one of that name, else an elevation, else the first with one number for each vertex. Throws
/// OutputError for a depth that cannot be read back: nan and inf are no numbers there.
std::optional<std::size_t> depth_field(const AtomicFile& file, const Mesh& mesh, Notes& notes) {
  std::optional<std::size_t> chosen;
  const auto finite = [](const Field& field) { return std::ranges::all_of(field.values, [](double v) { return std::isfinite(v); }); };
  for (std::size_t i = 0; i < mesh.fields.size(); ++i) {
    const Field& field = mesh.fields[i];
    if (field.on != Field::On::Vertices || field.components != 1) continue;
    if (field.name == "depth" && !finite(field))
      throw OutputError(file.path().string(), "the field \"depth\" has values that are no numbers, which this format cannot hold");
    if (field.name == "depth") return i;
    if (!finite(field)) continue;
    if (!chosen || (is_elevation(field) && !is_elevation(mesh.fields[*chosen]))) chosen = i;
  }
  if (chosen) {
    notes.push_back(fmt::format("Field \"{}\" was written as the depth{}.", mesh.fields[*chosen].name,
                                is_elevation(mesh.fields[*chosen]) ? ", with its sign turned" : ""));
  } else {
    notes.emplace_back("The mesh has no depth: 0 was written for every vertex.");
  }
  return chosen;
}

/// The groups that can be written as boundaries. Those with weirs cannot: their further columns are in the original file only.
std::vector<std::size_t> boundaries(const Mesh& mesh) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    const Group& group = mesh.groups[i];
    if (group.dimension != 0) continue;
    if (group.role == kFort14Open || (group.role == kFort14Land && !is_fort14_weir(group.code))) kept.push_back(i);
  }
  return kept;
}

void write_boundaries(TextWriter& out, const Mesh& mesh, std::span<const std::size_t> kept, std::string_view role) {
  std::size_t count = 0;
  std::size_t total = 0;
  for (const std::size_t i : kept) {
    if (mesh.groups[i].role != role) continue;
    ++count;
    total += mesh.groups[i].members.size();
  }
  out << count << " = Number of " << (role == kFort14Open ? "open" : "land") << " boundaries\n";
  out << total << " = Total number of " << role << " nodes\n";
  count = 0;
  for (const std::size_t i : kept) {
    const Group& group = mesh.groups[i];
    if (group.role != role) continue;
    out << group.members.size() << ' ' << group.code << " = Number of nodes for " << role << ' ' << ++count << '\n';
    for (const Index v : group.members) out << v + 1 << '\n';
  }
}

Notes write_fort14(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  Notes notes;
  const std::string_view title = kFort14Format.info.title;
  require_surface_elements(file, mesh, title);
  require_constant_z(file, positions, title, notes);
  const std::optional<std::size_t> depth = depth_field(file, mesh, notes);
  const std::vector<std::size_t> kept = boundaries(mesh);
  const std::array<std::size_t, 1> kept_fields{depth.value_or(0)};
  note_dropped(mesh, std::span(kept_fields).first(depth ? 1 : 0), kept, title, notes);

  const auto depth_of = [&](std::size_t v) {
    const double value = depth ? mesh.fields[*depth].values[v] : 0.0;
    return depth && is_elevation(mesh.fields[*depth]) && value != 0.0 ? -value : value;
  };

  TextWriter out(file, context);
  out << without_line_ends(mesh.title.empty() ? mesh.name : mesh.title) << '\n';
  out << mesh.elements.size() << ' ' << positions.size() << '\n';
  out.for_each(positions.size(), [&](TextBuffer& part, std::size_t v) {
    part << v + 1 << ' ' << positions[v].x << ' ' << positions[v].y << ' ' << depth_of(v) << '\n';
  });
  out.for_each(mesh.elements.size(), [&](TextBuffer& part, std::size_t e) {
    const FileCorners corners = file_corners(mesh, e);
    part << e + 1 << ' ' << corners.size();
    put_corners(part, corners, 1);
    part << '\n';
  });
  write_boundaries(out, mesh, kept, kFort14Open);
  write_boundaries(out, mesh, kept, kFort14Land);
  out.finish();
  return notes;
}

}  // namespace

constinit const FormatHandler kFort14Format{
    .info = {"fort14", "ADCIRC fort.14", ".14 .grd .gr3 .ll", "x, y and depth, triangles and quadrilaterals, open and land boundaries"},
    .read = read_with<Reader>,
    .write = write_fort14};

}  // namespace dmoscope
