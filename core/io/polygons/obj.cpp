// Wavefront OBJ: vertices and faces; everything else is kept when the file is patched. http://www.martinreddy.net/gfx/3d/OBJ.spec

#include "core/io/polygons/obj.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/format.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {

namespace {

/// Statements that Mesh cannot hold, and their names for the user.
struct Statement {
  std::string_view word;
  std::string_view thing;
};
constexpr std::array<Statement, 8> kKept{{{"vt", "texture coordinates"},
                                          {"vn", "normals"},
                                          {"vp", "parameter space vertices"},
                                          {"o", "object names"},
                                          {"g", "group names"},
                                          {"s", "smoothing groups"},
                                          {"usemtl", "materials"},
                                          {"mtllib", "materials"}}};

class ObjReader {
 public:
  ObjReader(SourceFile& source, const IoContext& context)
      : source_(source), tokens_(source.bytes(), source.path().string(), kObjSyntax, context.progress) {
    source.set_layout({.syntax = kObjSyntax});
  }

  Mesh read() {
    while (!tokens_.at_end()) {
      const std::size_t line = tokens_.line();
      statement(tokens_.token_on_line(), line);
      tokens_.end_line();
    }
    check_forward_references();
    add_notes();
    return std::move(mesh_);
  }

 private:
  /// A corner whose vertex is further down in the file: checked after all are read.
  struct ForwardReference {
    std::size_t line;
    std::int64_t index;  // index from 1
  };

  void statement(std::string_view word, std::size_t line) {
    if (word == "v") {
      vertex();
    } else if (word == "f") {
      face();
    } else if (word == "l") {
      ++lines_;
    } else if (word == "p") {
      ++points_;
    } else if (const auto* kept = std::find_if(kKept.begin(), kKept.end(), [word](const Statement& s) { return s.word == word; });
               kept != kKept.end()) {
      source_.add_only_in_file(kept->thing);
    } else {
      unknown(word, line);
    }
  }

  void vertex() {
    if (mesh_.positions.size() + 1 >= kNoIndex) tokens_.fail(fmt::format("a mesh can have {} vertices at most", kNoIndex - 1));
    std::size_t place = 0;
    mesh_.positions.push_back(tokens_.read_point(3, place));
    source_.add_place(place);
    int extras = 0;
    while (!tokens_.token_on_line().empty()) ++extras;
    if (extras == 1 || extras == 4) source_.add_only_in_file("vertex weights");
    if (extras >= 3) source_.add_only_in_file("vertex colours");
  }

  void face() {
    std::array<std::int64_t, 4> named{};
    std::array<Index, 4> corners{};
    const std::size_t count = read_obj_face(tokens_, named);
    for (std::size_t i = 0; i < count; ++i) corners[i] = corner(named[i]);
    add_element(mesh_, count == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, {corners.data(), count}, source_);
  }

  /// Vertex of a corner; a negative index counts back from the vertex read last.
  Index corner(std::int64_t index) {
    const auto so_far = static_cast<std::int64_t>(mesh_.positions.size());
    if (index < 0) {
      if (-index > so_far) tokens_.fail(fmt::format("vertex index {} out of range ({} vertices come before it)", index, so_far));
      return static_cast<Index>(so_far + index);
    }
    if (index >= static_cast<std::int64_t>(kNoIndex)) tokens_.fail(fmt::format("vertex index {} out of range", index));
    if (index > so_far) forward_.push_back({tokens_.line(), index});
    return static_cast<Index>(index - 1);
  }

  void check_forward_references() const {
    for (const ForwardReference& reference : forward_) {
      if (static_cast<std::size_t>(reference.index) > mesh_.positions.size()) {
        tokens_.fail_at(reference.line,
                        fmt::format("vertex index {} out of range (the file has {} vertices)", reference.index, mesh_.positions.size()));
      }
    }
  }

  void unknown(std::string_view word, std::size_t line) {
    const bool readable = std::all_of(word.begin(), word.end(), [](char c) { return c > ' ' && c < '\x7f'; });
    if (!readable) tokens_.fail(fmt::format("this is no OBJ file: {}", quote_token(word)));
    if (std::find(unknown_.begin(), unknown_.end(), word) != unknown_.end()) return;
    constexpr std::size_t kMostNamed = 20;  // limits the message for a file of another format
    if (unknown_.size() == kMostNamed) return;
    unknown_.emplace_back(word);
    source_.add_note(fmt::format("Statement {} (line {}) is not understood and was passed over.", quote_token(word), line));
    source_.add_only_in_file(fmt::format("statements {}", quote_token(word)));
  }

  void add_notes() {
    if (lines_ > 0) source_.add_note(fmt::format("{} line elements (l) were passed over.", lines_));
    if (lines_ > 0) source_.add_only_in_file("line elements");
    if (points_ > 0) source_.add_note(fmt::format("{} point elements (p) were passed over.", points_));
    if (points_ > 0) source_.add_only_in_file("point elements");
    if (source_.bytes().find('#') != std::string_view::npos) source_.add_only_in_file("comments");
  }

  SourceFile& source_;
  Tokenizer tokens_;
  Mesh mesh_;
  std::vector<ForwardReference> forward_;
  std::vector<std::string> unknown_;
  std::size_t lines_ = 0;
  std::size_t points_ = 0;
};

Notes write_obj(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  Notes notes;
  require_surface_elements(file, mesh, kObjFormat.info.title);
  note_dropped(mesh, {}, {}, kObjFormat.info.title, notes);
  TextWriter out(file, context);
  if (!mesh.title.empty()) out << "# " << one_line(mesh.title) << '\n';
  out.for_each(positions.size(), [&](TextBuffer& part, std::size_t v) {
    part << "v " << positions[v].x << ' ' << positions[v].y << ' ' << positions[v].z << '\n';
  });
  out.for_each(mesh.elements.size(), [&](TextBuffer& part, std::size_t e) {
    part << 'f';
    put_corners(part, file_corners(mesh, e), 1);
    part << '\n';
  });
  out.finish();
  return notes;
}

}  // namespace

constinit const FormatHandler kObjFormat{.info = {"obj", "Wavefront OBJ", ".obj", "positions, triangles and quadrilaterals"},
                                         .read = read_with<ObjReader>,
                                         .write = write_obj,
                                         .comment = {"# ", "\n"}};

namespace {

void check_references(const Tokenizer& tokens, std::string_view token, std::size_t slash) {
  for (int part = 0; slash != std::string_view::npos; ++part) {
    if (part == 2) tokens.fail(fmt::format("expected v, v/vt, v//vn or v/vt/vn, got {}", quote_token(token)));
    const std::size_t next = token.find('/', slash + 1);
    const std::string_view number = token.substr(slash + 1, next == std::string_view::npos ? next : next - slash - 1);
    if (!number.empty()) (void)tokens.parse_integer(number, part == 0 ? "texture coordinate index" : "normal index");
    slash = next;
  }
}

}  // namespace

std::size_t read_obj_face(Tokenizer& tokens, std::array<std::int64_t, 4>& corners) {
  std::size_t count = 0;
  for (std::string_view token = tokens.token_on_line(); !token.empty(); token = tokens.token_on_line()) {
    const std::size_t slash = token.find('/');
    const std::int64_t index = count < corners.size() ? tokens.parse_integer(token.substr(0, slash), "vertex index") : 1;
    if (count < corners.size()) check_references(tokens, token, slash);
    if (index == 0) tokens.fail("vertex index 0 out of range (OBJ counts from 1)");
    if (count < corners.size()) corners[count] = index;
    ++count;
  }
  if (count != 3 && count != 4) tokens.fail(fmt::format("face with {} corners: only triangles and quadrilaterals are read", count));
  return count;
}

}  // namespace dmoscope
