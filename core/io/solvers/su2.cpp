// The native mesh format of SU2: KEY= value sections in any order, elements by VTK's numbers for their kinds and with its order of corners,
// markers. https://su2code.github.io/docs_v7/Mesh-File/

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/format.h"
#include "core/io/mesh_writer.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/vtk/vtk_cells.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

constexpr TextSyntax kSu2Syntax{.comment = '%'};
constexpr std::string_view kSu2Marker = "marker";
constexpr std::int64_t kVertexType = 1;
constexpr std::int64_t kLineType = 3;

/// Number of each ElementKind in VTK.
constexpr std::array<std::int64_t, kElementKindCount> kTypes{5, 9, 10, 12, 13, 14};

std::optional<ElementKind> kind_of_su2(std::int64_t type) {
  const auto* found = std::find(kTypes.begin(), kTypes.end(), type);
  if (found == kTypes.end()) return std::nullopt;
  return static_cast<ElementKind>(found - kTypes.begin());
}

/// Reads "KEY= value" up to the = at the begin of a line; empty if the line has no key. The value's tokens follow.
std::string_view read_key(Tokenizer& tokens) {
  const std::size_t begin = tokens.offset();
  const std::string_view word = tokens.token_on_line();
  const std::size_t equals = word.find('=');
  if (equals != std::string_view::npos && equals > 0) {
    tokens.seek(begin + equals + 1, tokens.line());
    return word.substr(0, equals);
  }
  const std::size_t after_word = tokens.offset();
  const std::string_view next = tokens.token_on_line();
  if (equals == std::string_view::npos && next.starts_with('=')) {
    tokens.seek(tokens.offset_of(next) + 1, tokens.line());
    return word;
  }
  tokens.seek(after_word, tokens.line());
  return {};
}

/// Byte offset of the line with a key, anywhere in the file; none if there is none. Sections may come in any order, but elements need the
/// number of points, and points the dimension.
std::optional<std::size_t> find_key(std::string_view text, std::string_view key) {
  for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    const std::size_t before = text.find_last_not_of(" \t", at == 0 ? 0 : at - 1);
    const bool begins = at == 0 || before == std::string_view::npos || text[before] == '\n' || text[before] == '\r';
    const std::size_t after = text.find_first_not_of(" \t", at + key.size());
    if (begins && after != std::string_view::npos && text[after] == '=') return at;
  }
  return std::nullopt;
}

bool recognises_su2(std::string_view bytes) {
  constexpr std::size_t kLook = 65536;  // bytes within which comments end and the first key must come
  Progress unwatched;
  Tokenizer tokens(bytes.substr(0, kLook), {}, kSu2Syntax, unwatched);
  if (tokens.at_end()) return false;
  const std::string_view key = read_key(tokens);
  return key == "NDIME" || key == "NZONE" || key == "NELEM" || key == "NPOIN";
}

class Su2Reader {
 public:
  Su2Reader(SourceFile& source, const IoContext& context)
      : source_(source), progress_(context.progress), tokens_(source.bytes(), source.path().string(), kSu2Syntax, context.progress) {}

  Mesh read() {
    const std::int64_t dimension = value_of("NDIME");
    if (dimension != 2 && dimension != 3) {
      throw InputError(source_.path().string(), 0, fmt::format("NDIME= {}: only 2 and 3 dimensions are read", dimension));
    }
    dimension_ = static_cast<int>(dimension);
    // Leaves the error for a negative count to its place. Without a count the elements are still read: their place says more about a
    // truncated file than the missing key does.
    vertices_ = find_key(source_.bytes(), "NPOIN") ? std::max<std::int64_t>(value_of("NPOIN"), 0) : kNoIndex;
    source_.set_layout({.components = dimension_, .syntax = kSu2Syntax});
    while (!tokens_.at_end()) section();
    finish();
    return std::move(mesh_);
  }

 private:
  std::int64_t value_of(std::string_view key) {
    const std::optional<std::size_t> at = find_key(source_.bytes(), key);
    if (!at) throw InputError(source_.path().string(), 0, fmt::format("{}= is missing", key));
    Tokenizer tokens(source_.bytes(), source_.path().string(), kSu2Syntax, progress_);
    tokens.seek(*at, tokens.line_at(*at));
    (void)read_key(tokens);
    return tokens.read_integer(key);
  }

  void section() {
    const std::string_view key = read_key(tokens_);
    if (key == "NDIME") {
      tokens_.end_line();
    } else if (key == "NELEM") {
      elements();
    } else if (key == "NPOIN") {
      points();
    } else if (key == "NMARK") {
      markers_expected_ = tokens_.read_count("NMARK", 1);
      tokens_.end_line();
      foreign_ = false;
    } else if (key == "MARKER_TAG") {
      tag_ = tokens_.read_token("name of a marker");
      tokens_.end_line();
      foreign_ = false;
    } else if (key == "MARKER_ELEMS") {
      marker();
    } else if (key == "NZONE") {
      if (tokens_.read_integer("NZONE") != 1) tokens_.fail("files of several zones are not read");
      tokens_.end_line();
    } else {
      other(key);
    }
  }

  /// Skips lines of an unknown key; anywhere else a line without a key is one too many.
  void other(std::string_view key) {
    if (key.empty() && !foreign_) tokens_.fail("expected KEY= value (more lines than the section's count says?)");
    if (!key.empty()) {
      foreign_ = true;
      source_.add_only_in_file(fmt::format("{}=", key));
    }
    tokens_.end_line();
  }

  void once(bool& done, std::string_view key) const {
    if (done) tokens_.fail(fmt::format("{}= a second time", key));
    done = true;
  }

  void begin_line(std::string_view what) {
    if (tokens_.at_end()) tokens_.fail_at_end(what);
  }

  /// Reads the end of an element's or a point's line, which may have its number, on all lines or on none. A repeated coordinate shifts
  /// those behind it: then there is one number too many, or one that is not whole.
  void end_numbered(std::optional<bool>& numbered, std::string_view thing) {
    const bool has = tokens_.more_on_line();
    if (has) (void)tokens_.read_integer(fmt::format("the number of {}, or the end of the line", thing));
    if (numbered.value_or(has) != has)
      tokens_.fail(fmt::format("{} with {} number of its own, other than those before: is there a number too {}?", thing, has ? "a" : "no",
                               has ? "many" : "few"));
    numbered = has;
    tokens_.end_line_of(thing);
  }

  Index vertex() { return tokens_.read_index("vertex index", static_cast<std::size_t>(vertices_), "vertices"); }

  void elements() {
    constexpr std::size_t kShortest = 8;  // bytes of "5 0 1 2\n"
    once(elements_read_, "NELEM");
    const std::size_t count = tokens_.read_count("NELEM", kShortest);
    tokens_.end_line();
    mesh_.elements.reserve(count, 4 * count);
    std::optional<bool> numbered;
    for (std::size_t e = 0; e < count; ++e) {
      begin_line("an element");
      const std::int64_t type = tokens_.read_integer("type of an element");
      const std::optional<ElementKind> kind = kind_of_su2(type);
      if (!kind || info(*kind).dimension > dimension_) {
        tokens_.fail(fmt::format("element of type {} in {} dimensions is not read", type, dimension_));
      }
      std::array<Index, 8> corners{};
      const std::span<Index> used(corners.data(), info(*kind).corners);
      for (Index& c : used) c = vertex();
      exchange_vtk_order(*kind, used.data());
      add_element(mesh_, *kind, used, source_);
      end_numbered(numbered, "an element");
    }
    foreign_ = false;
  }

  void points() {
    once(points_read_, "NPOIN");
    const std::size_t shortest = dimension_ == 2 ? 4 : 6;  // bytes of "0 0\n"
    const std::size_t count = tokens_.read_count("NPOIN", shortest);
    if (static_cast<std::int64_t>(count) != vertices_) tokens_.fail("NPOIN= a second time");
    tokens_.end_line();  // the number of points without those of neighbouring partitions may follow
    reserve_large(mesh_.positions, count);
    source_.reserve_places(count);
    std::optional<bool> numbered;
    bool flat_z = false;
    for (std::size_t v = 0; v < count; ++v) {
      begin_line("x coordinate");
      std::size_t place = 0;
      Vec3 p = tokens_.read_point(dimension_, place);
      source_.add_place(place);
      if (v == 0 && dimension_ == 2) flat_z = has_flat_z();
      if (flat_z) p.z = tokens_.read_double("z coordinate");
      if (flat_z && p.z != 0.0) tokens_.fail(fmt::format("z coordinate {} where 0 or the number of a point is expected", p.z));
      mesh_.positions.push_back(p);
      end_numbered(numbered, "a point");
    }
    foreign_ = false;
  }

  /// Whether another coordinate comes behind x and y and before the point's number: some programs write it in 2 dimensions, too.
  bool has_flat_z() {
    const std::size_t offset = tokens_.offset(), line = tokens_.line();
    const std::string_view first = tokens_.token_on_line(), second = tokens_.token_on_line();
    tokens_.seek(offset, line);
    return !second.empty() || first.find_first_of(".eE") != std::string_view::npos;
  }

  void marker() {
    constexpr std::size_t kShortest = 4;  // bytes of "1 0\n"
    if (tag_.empty()) tokens_.fail("MARKER_ELEMS= without a MARKER_TAG= before it");
    const std::size_t count = tokens_.read_count("MARKER_ELEMS", kShortest);
    tokens_.end_line();
    MarkerElements found;
    for (std::size_t i = 0; i < count; ++i) {
      std::optional<bool> numbered;  // for each element: points may have the number of a transformation where edges have none
      begin_line("an element of a marker");
      skip_send_recv();
      marker_element(found);
      end_numbered(numbered, "an element of a marker");
    }
    add_marker(std::move(found));
    tag_.clear();
    foreign_ = false;
  }

  /// Skips SEND_RECV=, which is between MARKER_ELEMS= and the elements in the markers of partitioned files.
  void skip_send_recv() {
    const std::size_t offset = tokens_.offset();
    const std::size_t line = tokens_.line();
    if (read_key(tokens_) == "SEND_RECV") {
      tokens_.end_line();
      source_.add_only_in_file("SEND_RECV=");
      begin_line("an element of a marker");
    } else {
      tokens_.seek(offset, line);
    }
  }

  struct MarkerElements {
    std::vector<Index> points;
    std::vector<Index> edges;  // two vertices for each edge
    ElementTable faces;
  };

  void marker_element(MarkerElements& found) {
    const std::int64_t type = tokens_.read_integer("type of an element");
    const std::optional<ElementKind> kind = kind_of_su2(type);
    if (type == kVertexType) {
      found.points.push_back(vertex());
    } else if (type == kLineType) {
      found.edges.push_back(vertex());
      found.edges.push_back(vertex());
    } else if (kind && info(*kind).dimension == 2 && dimension_ == 3) {
      std::array<Index, 4> corners{};
      const std::span<Index> used(corners.data(), info(*kind).corners);
      for (Index& c : used) c = vertex();
      found.faces.add(*kind, used);
    } else {
      tokens_.fail(fmt::format("element of type {} in a marker is not read", type));
    }
  }

  /// Adds a marker. A Group holds only one kind of members: those of fewer dimensions beside others stay in the file only.
  void add_marker(MarkerElements found) {
    ++markers_;
    Group group{.name = tag_, .role = std::string(kSu2Marker), .code = 0, .dimension = 1};
    if (found.faces.size() > 0) {
      group.dimension = 2;
      group.faces = std::move(found.faces);
      if (!found.edges.empty()) source_.add_only_in_file(fmt::format("edges of marker \"{}\"", tag_));
    } else if (found.edges.empty() && !found.points.empty()) {
      group.dimension = 0;
      group.members = std::move(found.points);
    } else {
      group.members = std::move(found.edges);
    }
    if (group.dimension > 0 && !found.points.empty()) source_.add_only_in_file(fmt::format("points of marker \"{}\"", tag_));
    mesh_.groups.push_back(std::move(group));
  }

  void finish() {
    if (!elements_read_) throw InputError(source_.path().string(), 0, "NELEM= is missing");
    if (!points_read_) throw InputError(source_.path().string(), 0, "NPOIN= is missing");
    if (!tag_.empty()) tokens_.fail_at_end("MARKER_ELEMS=");
    if (markers_ < markers_expected_) tokens_.fail_at_end(fmt::format("marker {} of {}", markers_ + 1, markers_expected_));
    if (source_.bytes().find('%') != std::string_view::npos) source_.add_only_in_file("comments");
  }

  SourceFile& source_;
  Progress& progress_;
  Tokenizer tokens_;
  Mesh mesh_;
  int dimension_ = 2;
  std::int64_t vertices_ = 0;
  bool elements_read_ = false;
  bool points_read_ = false;
  bool foreign_ = false;  // whether the present lines belong to an unknown key
  std::string tag_;       // name of the marker whose elements come next
  std::size_t markers_ = 0;
  std::size_t markers_expected_ = 0;
};

// --- Writing new files ---

/// A marker to be written.
struct Marker {
  std::string tag;
  std::vector<Index> edges;             // two vertices for each edge
  const ElementTable* faces = nullptr;  // faces of a volume mesh
};

/// The groups that SU2 can hold; `kept` gets their indices.
std::vector<Marker> markers_of(const Mesh& mesh, std::vector<std::size_t>& kept, Notes& notes) {
  std::vector<Marker> markers;
  std::vector<const Group*> strings;
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    const Group& group = mesh.groups[i];
    const bool chain = is_boundary_string(group);
    if (group.dimension != 1 && !chain && group.faces.size() == 0) continue;
    kept.push_back(i);
    Marker marker{group.name, chain ? chain_edges(group) : group.members, group.faces.size() > 0 ? &group.faces : nullptr};
    std::replace_if(
        marker.tag.begin(), marker.tag.end(), [](char c) { return c == ' ' || c == '\t' || c == '%' || c == '\n' || c == '\r'; }, '_');
    if (chain) strings.push_back(&group);
    markers.push_back(std::move(marker));
  }
  note_boundary_strings(strings, "marker", "markers", notes);
  return markers;
}

void write_points(TextWriter& out, std::span<const Vec3> positions, bool volume) {
  out << "NPOIN= " << positions.size() << '\n';
  out.for_each(positions.size(), [&](TextBuffer& part, std::size_t v) {
    part << positions[v].x << ' ' << positions[v].y << ' ';
    if (volume) part << positions[v].z << ' ';
    part << v << '\n';
  });
}

void write_marker(TextWriter& out, const Marker& marker) {
  const Index faces = marker.faces != nullptr ? marker.faces->size() : 0;
  out << "MARKER_TAG= " << marker.tag << "\nMARKER_ELEMS= " << marker.edges.size() / 2 + faces << '\n';
  for (std::size_t i = 0; i + 1 < marker.edges.size(); i += 2) {
    out << kLineType << ' ' << marker.edges[i] << ' ' << marker.edges[i + 1] << '\n';
  }
  for (Index f = 0; f < faces; ++f) {
    out << kTypes[static_cast<std::size_t>(marker.faces->kind(f))];
    for (const Index c : marker.faces->corners(f)) out << ' ' << c;
    out << '\n';
  }
}

Notes write_su2(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  Notes notes;
  const auto kinds = mesh.elements.kinds();
  const bool volume = std::any_of(kinds.begin(), kinds.end(), [](ElementKind kind) { return info(kind).dimension == 3; });
  if (!volume) require_constant_z(file, positions, kSu2Format.info.title, notes);
  std::vector<std::size_t> kept;
  const std::vector<Marker> markers = markers_of(mesh, kept, notes);
  note_dropped(mesh, {}, kept, kSu2Format.info.title, notes);

  TextWriter out(file, context);
  if (!mesh.title.empty()) out << "% " << one_line(mesh.title) << '\n';
  out << "NDIME= " << (volume ? 3 : 2) << "\nNELEM= " << mesh.elements.size() << '\n';
  out.for_each(mesh.elements.size(), [&](TextBuffer& part, std::size_t e) {
    part << kTypes[static_cast<std::size_t>(kinds[e])];
    put_corners(part, vtk_corners(mesh, e), 0);
    part << ' ' << e << '\n';
  });
  write_points(out, positions, volume);
  out << "NMARK= " << markers.size() << '\n';
  for (const Marker& marker : markers) write_marker(out, marker);
  out.finish();
  return notes;
}

}  // namespace

constinit const FormatHandler kSu2Format{.info = {"su2", "SU2", ".su2", "positions, elements of all kinds, markers"},
                                         .recognises = recognises_su2,
                                         .read = read_with<Su2Reader>,
                                         .write = write_su2,
                                         .comment = {"% ", "\n"}};

}  // namespace dmoscope
