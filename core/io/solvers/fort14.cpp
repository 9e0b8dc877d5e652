// ADCIRC's grid file, fort.14 or .grd: nodes with depth, elements, open and land boundaries.
// https://adcirc.org/home/documentation/users-manual-v53/input-file-descriptions/adcirc-grid-and-boundary-information-file-fort-14/

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/format.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

// Fortran's list-directed input; whatever follows the numbers of a line is a remark.
constexpr TextSyntax kFort14Syntax{.comma_is_blank = true};
constexpr std::string_view kOpen = "open boundary";
constexpr std::string_view kLand = "land boundary";

/// What follows the node number in a line of a land boundary, by IBTYPE: the node on a weir's other side, then heights and
/// coefficients.
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
      return {true, 5};  // and a sixth, the pipe's diameter, that some files lack
    default:
      return {};
  }
}
bool is_weir(int type) { return weir_columns(type).numbers > 0; }

/// The numbers by which the file calls its nodes: mostly 1, 2, ... but any will do.
class NodeNumbers {
 public:
  void reserve(std::size_t count) { numbers_.reserve(count); }
  void add(std::int64_t number) {
    dense_ = dense_ && number == static_cast<std::int64_t>(numbers_.size()) + 1;
    numbers_.push_back({number, static_cast<Index>(numbers_.size())});
  }
  /// Call it when all are there. Returns the second of two nodes of one number, if there is one.
  std::optional<Index> finish() {
    if (dense_) return std::nullopt;
    std::sort(numbers_.begin(), numbers_.end());
    const auto twice = std::adjacent_find(numbers_.begin(), numbers_.end(), [](auto a, auto b) { return a.first == b.first; });
    if (twice == numbers_.end()) return std::nullopt;
    return std::next(twice)->second;
  }
  [[nodiscard]] std::size_t size() const noexcept { return numbers_.size(); }
  /// Reads a node's number; it is an error if no node has it.
  Index read(Tokenizer& tokens, std::string_view what) const {
    if (dense_) return tokens.read_index(what, numbers_.size(), "vertices", 1);
    const std::int64_t number = tokens.read_integer(what);
    const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), std::pair<std::int64_t, Index>(number, 0));
    if (found == numbers_.end() || found->first != number) tokens.fail(fmt::format("{} {}: no vertex has this number", what, number));
    return found->second;
  }

 private:
  std::vector<std::pair<std::int64_t, Index>> numbers_;
  bool dense_ = true;
};

class Reader {
 public:
  Reader(SourceFile& source, Progress& progress)
      : source_(source), tokens_(source.bytes(), source.path().string(), kFort14Syntax, progress) {
    CoordinateLayout layout;
    layout.components = 2;
    layout.syntax = kFort14Syntax;
    source.set_layout(layout);
  }

  Mesh read() {
    constexpr std::size_t kShortestElement = 10;  // "1 3 1 2 3\n"
    constexpr std::size_t kShortestNode = 8;      // "1 0 0 0\n"
    mesh_.title = trimmed(tokens_.rest_of_line());
    if (tokens_.at_end()) tokens_.fail_at_end("number of elements");
    const std::size_t elements = tokens_.read_count("number of elements", kShortestElement);
    const std::size_t nodes = tokens_.read_count("number of vertices", kShortestNode);
    tokens_.end_line();
    read_nodes(nodes);
    read_elements(elements);
    read_boundaries();
    return std::move(mesh_);
  }

 private:
  void begin_line(std::string_view what) {
    if (tokens_.at_end()) tokens_.fail_at_end(what);
  }

  void read_nodes(std::size_t count) {
    Field depth{.name = "depth", .on = Field::On::Vertices, .components = 1, .type = "double", .role = "depth", .values = {}};
    reserve_large(mesh_.positions, count);
    reserve_large(depth.values, count);
    numbers_.reserve(count);
    source_.reserve_places(count);
    for (std::size_t v = 0; v < count; ++v) {
      begin_line("number of a vertex");
      numbers_.add(tokens_.read_integer("number of a vertex"));
      const std::string_view x = tokens_.read_token("x coordinate");
      source_.add_place(tokens_.offset_of(x));
      Vec3 p;
      p.x = tokens_.parse_double(x, "x coordinate");
      p.y = tokens_.read_double("y coordinate");
      mesh_.positions.push_back(p);
      depth.values.push_back(tokens_.read_double("depth"));
      tokens_.end_numbers_of("a vertex");
    }
    if (const auto twice = numbers_.finish()) {
      tokens_.fail_at(tokens_.line_at(source_.place(*twice)), fmt::format("vertex {} has the number of one before it", *twice + 1));
    }
    mesh_.fields.push_back(std::move(depth));
  }

  void read_elements(std::size_t count) {
    mesh_.elements.reserve(count, 3 * count);
    for (std::size_t e = 0; e < count; ++e) {
      begin_line("number of an element");
      (void)tokens_.read_integer("number of an element");
      const std::int64_t corners = tokens_.read_integer("number of corners");
      if (corners != 3 && corners != 4) {
        tokens_.fail(fmt::format("element with {} corners: only triangles and quadrilaterals are read", corners));
      }
      std::array<Index, 4> corner{};
      const std::span<Index> used(corner.data(), static_cast<std::size_t>(corners));
      for (Index& c : used) c = numbers_.read(tokens_, "vertex index");
      add_element(mesh_, corners == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, used, source_);
      tokens_.end_numbers_of("an element");
    }
  }

  /// A file may end before the boundaries, or after the open ones.
  void read_boundaries() {
    constexpr std::size_t kShortestBoundary = 2;  // "0\n"
    if (tokens_.at_end()) return;
    const std::size_t open = tokens_.read_count("number of open boundaries", kShortestBoundary);
    tokens_.end_line();
    read_total(open, "number of open boundary vertices");
    for (std::size_t b = 0; b < open; ++b) read_open(b);
    if (tokens_.at_end()) return;
    const std::size_t land = tokens_.read_count("number of land boundaries", kShortestBoundary);
    tokens_.end_line();
    read_total(land, "number of land boundary vertices");
    for (std::size_t b = 0; b < land; ++b) read_land(b);
    if (tokens_.at_end()) return;
    source_.add_note(fmt::format("The file goes on after its boundaries (line {}); the rest is kept but not read.", tokens_.line()));
    source_.add_only_in_file("what follows the boundaries");
  }

  /// The sum over all boundaries: nothing depends on it, and files often have it wrong. Some end before it if there are none.
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
    Group group{.name = fmt::format("{} {}", kOpen, b + 1), .role = std::string(kOpen), .code = 0, .dimension = 0, .members = {}};
    const std::size_t size = read_size();
    const std::string_view type = tokens_.token_on_line();  // IBTYPEE may be left out; a remark may be there instead
    int code = 0;
    if (const auto [end, error] = std::from_chars(type.data(), type.data() + type.size(), code);
        error == std::errc() && end == type.data() + type.size()) {
      group.code = code;
    }
    tokens_.end_line();
    group.members.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      begin_line("vertex of an open boundary");
      group.members.push_back(numbers_.read(tokens_, "vertex index"));
      tokens_.end_numbers_of("a vertex of a boundary");
    }
    mesh_.groups.push_back(std::move(group));
  }

  void read_land(std::size_t b) {
    Group group{.name = fmt::format("{} {}", kLand, b + 1), .role = std::string(kLand), .code = 0, .dimension = 0, .members = {}};
    const std::size_t size = read_size();
    const std::int64_t type = tokens_.read_integer("type of a land boundary (IBTYPE)");
    if (type < -1000000 || type > 1000000) tokens_.fail(fmt::format("type of a land boundary (IBTYPE) out of range: {}", type));
    group.code = static_cast<int>(type);
    tokens_.end_line();
    const WeirColumns columns = weir_columns(group.code);
    if (is_weir(group.code)) source_.add_only_in_file("heights, coefficients and pairs of vertices of the weirs");
    // A weir has two banks; the file lists both in one string, the farther one beside the nearer.
    Group far_side{.name = group.name + ", far side", .role = group.role, .code = group.code, .dimension = 0, .members = {}};
    group.members.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      begin_line("vertex of a land boundary");
      group.members.push_back(numbers_.read(tokens_, "vertex index"));
      if (columns.pair) far_side.members.push_back(numbers_.read(tokens_, "vertex index"));
      for (int n = 0; n < columns.numbers; ++n) (void)tokens_.read_double("height or coefficient of a weir");
      tokens_.end_line();
    }
    mesh_.groups.push_back(std::move(group));
    if (columns.pair) mesh_.groups.push_back(std::move(far_side));
  }

  SourceFile& source_;
  Tokenizer tokens_;
  Mesh mesh_;
  NodeNumbers numbers_;
};

Mesh read_fort14(SourceFile& source, const IoContext& context) { return Reader(source, context.progress).read(); }

// --- Writing anew ---

/// A depth counts downwards, an elevation (of a 2dm file) upwards.
bool is_elevation(const Field& field) { return field.role == "elevation"; }

/// The field that becomes the depth: the one of that name, else an elevation, else the first with one number per vertex.
/// Throws OutputError for a depth that cannot be read back: nan and inf are no numbers there.
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

/// The groups that can be written as boundaries. Those with weirs cannot: their columns are in the file they came from alone.
std::vector<std::size_t> boundaries(const Mesh& mesh) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    const Group& group = mesh.groups[i];
    if (group.dimension != 0) continue;
    if (group.role == kOpen || (group.role == kLand && !is_weir(group.code))) kept.push_back(i);
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
  out << count << " = Number of " << (role == kOpen ? "open" : "land") << " boundaries\n";
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
  const std::string_view title = fort14_format().info.title;
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
  std::string name = mesh.title.empty() ? mesh.name : mesh.title;
  std::ranges::replace_if(
      name, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  out << name << '\n';
  out << mesh.elements.size() << ' ' << positions.size() << '\n';
  out.for_each(positions.size(), [&](TextBuffer& part, std::size_t v) {
    part << v + 1 << ' ' << positions[v].x << ' ' << positions[v].y << ' ' << depth_of(v) << '\n';
  });
  out.for_each(mesh.elements.size(), [&](TextBuffer& part, std::size_t e) {
    std::array<Index, 8> buffer{};
    const auto corners = file_corners(mesh, static_cast<Index>(e), buffer);
    part << e + 1 << ' ' << corners.size();
    for (const Index c : corners) part << ' ' << c + 1;
    part << '\n';
  });
  write_boundaries(out, mesh, kept, kOpen);
  write_boundaries(out, mesh, kept, kLand);
  out.finish();
  return notes;
}

}  // namespace

const FormatHandler& fort14_format() {
  static const FormatHandler handler{
      {"fort14", "ADCIRC fort.14", ".14 .grd", "x, y and depth, triangles and quadrilaterals, open and land boundaries"},
      nullptr,
      read_fort14,
      write_fort14};
  return handler;
}

}  // namespace dmoscope
