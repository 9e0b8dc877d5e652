// ADCIRC's grid file, fort.14 or .grd, and SCHISM's .gr3 and .ll, whose coordinates may be longitude and latitude: nodes with depth,
// elements, open and land boundaries.
// https://adcirc.org/home/documentation/users-manual-v53/input-file-descriptions/adcirc-grid-and-boundary-information-file-fort-14/

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/format.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/solvers/fort14_text.h"
#include "core/io/writing/one_line.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

/// Node numbers in the file: mostly 1, 2, ... but any are possible.
class NodeNumbers {
 public:
  void reserve(std::size_t count) { numbers_.reserve(count); }
  void add(std::int64_t number) {
    dense_ = dense_ && number == static_cast<std::int64_t>(numbers_.size()) + 1;
    numbers_.push_back({number, static_cast<Index>(numbers_.size())});
  }
  /// Completes the numbers, after all are added. Returns the second of two nodes with one number, if there is one.
  std::optional<Index> finish() {
    if (dense_) return std::nullopt;
    std::sort(numbers_.begin(), numbers_.end());
    const auto twice = std::adjacent_find(numbers_.begin(), numbers_.end(), [](auto a, auto b) { return a.first == b.first; });
    if (twice == numbers_.end()) return std::nullopt;
    return std::next(twice)->second;
  }
  [[nodiscard]] std::size_t size() const noexcept { return numbers_.size(); }
  /// Reads a node's number. Throws InputError if no node has it.
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
    source.set_layout({.components = 2, .syntax = kFort14Syntax});
  }

  Mesh read() {
    const Fort14Head head = read_fort14_head(tokens_);
    mesh_.title = head.title;
    read_nodes(head.nodes);
    read_elements(head.elements);
    mesh_.groups = read_fort14_boundaries(
        tokens_, [this](Tokenizer& tokens, std::string_view what) { return numbers_.read(tokens, what); }, &source_);
    return std::move(mesh_);
  }

 private:
  void read_nodes(std::size_t count) {
    Field depth{.name = "depth", .on = Field::On::Vertices, .type = "double", .role = "depth", .place = {.with_positions = true, .at = 2}};
    reserve_large(mesh_.positions, count);
    reserve_large(depth.values, count);
    numbers_.reserve(count);
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

  void read_elements(std::size_t count) {
    mesh_.elements.reserve(count, 3 * count);
    for (std::size_t e = 0; e < count; ++e) {
      const std::size_t corners = read_fort14_element(tokens_);
      std::array<Index, 4> corner{};
      const std::span<Index> used(corner.data(), corners);
      for (Index& c : used) c = numbers_.read(tokens_, "vertex index");
      add_element(mesh_, corners == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, used, source_);
      tokens_.end_numbers_of("an element");
    }
  }

  SourceFile& source_;
  Tokenizer tokens_;
  Mesh mesh_;
  NodeNumbers numbers_;
};

Mesh read_fort14(SourceFile& source, const IoContext& context) { return Reader(source, context.progress).read(); }

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

const FormatHandler& fort14_format() {
  static const FormatHandler handler{
      {"fort14", "ADCIRC fort.14", ".14 .grd .gr3 .ll", "x, y and depth, triangles and quadrilaterals, open and land boundaries"},
      nullptr,
      read_fort14,
      write_fort14};
  return handler;
}

}  // namespace dmoscope
