// OFF, the object file format of Geomview: ASCII and binary, with or without normals, colours and texture coordinates.
// http://www.geomview.org/docs/html/OFF.html

#include "core/io/polygons/off.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/format.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/line_chunks.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {

namespace {

/// Whether the file begins with the word, and a count or BINARY after it: "OFF coast" may be the title of another format's file.
bool recognises_off(std::string_view bytes) {
  const std::string_view word = bytes.substr(0, bytes.substr(0, 16).find_first_of(" \t\r\n#"));
  if (!parse_off_header(word)) return false;
  Progress unwatched;
  Tokenizer tokens(bytes.substr(word.size()), {}, {.comment = '#'}, unwatched);
  const std::string_view next = tokens.token();
  return next == "BINARY" || (!next.empty() && next.front() >= '0' && next.front() <= '9');
}

void name_extras(const OffHeader& header, SourceFile& source) {
  if (header.texture) source.add_only_in_file("texture coordinates");
  if (header.colours) source.add_only_in_file("vertex colours");
  if (header.normals) source.add_only_in_file("vertex normals");
}

ElementKind kind_of(std::int64_t corners) { return corners == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral; }

// --- ASCII ---

/// Columns of the lines of vertices.
struct Vertices {
  std::vector<Vec3> positions;
  std::vector<std::uint64_t> places;
  bool extras = false;
  void clear() {
    positions.clear();
    places.clear();
    extras = false;
  }
};

void read_vertices(Tokenizer& tokens, std::size_t count, const OffHeader& header, SourceFile& source, Mesh& mesh,
                   const IoContext& context) {
  reserve_large(mesh.positions, count);
  source.reserve_places(count);
  bool extras = false;
  std::size_t place = 0;
  read_in_chunks<Vertices>(
      tokens, context,
      [](Tokenizer& lines, Vertices& part) {
        for (std::size_t at = 0; !lines.at_end();) {
          part.positions.push_back(read_off_vertex(lines, at, part.extras));
          part.places.push_back(at);
        }
      },
      [&](const Vertices& part) {
        if (part.positions.size() > count - mesh.positions.size()) return false;
        mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
        source.add_places(part.places);
        extras = extras || part.extras;
        return true;
      });
  while (mesh.positions.size() < count) {
    if (tokens.at_end()) tokens.fail_at_end("x coordinate");
    mesh.positions.push_back(read_off_vertex(tokens, place, extras));
    source.add_place(place);
  }
  if (extras && !header.texture && !header.colours && !header.normals) source.add_only_in_file("vertex colours");
}

/// Columns of the lines of faces.
struct Faces {
  ElementTable elements;
  bool extras = false;
  void clear() {
    elements.clear();
    extras = false;
  }
};

void read_faces(Tokenizer& tokens, std::size_t count, SourceFile& source, Mesh& mesh, const IoContext& context) {
  const std::size_t vertices = mesh.positions.size();
  mesh.elements.reserve(count, 4 * count);
  bool extras = false;
  read_in_chunks<Faces>(
      tokens, context,
      [vertices](Tokenizer& lines, Faces& part) {
        for (std::array<Index, 4> corner{}; !lines.at_end();) {
          const auto corners = read_off_face(lines, vertices, corner, part.extras);
          part.elements.add(kind_of(static_cast<std::int64_t>(corners.size())), corners);
        }
      },
      [&](const Faces& part) {
        if (part.elements.size() > count - mesh.elements.size()) return false;
        if (mesh.elements.all_corners().size() + part.elements.all_corners().size() >= kNoIndex) return false;
        mesh.elements.append(part.elements);
        extras = extras || part.extras;
        return true;
      });
  for (std::array<Index, 4> corner{}; mesh.elements.size() < count;) {
    if (tokens.at_end()) tokens.fail_at_end("number of corners");
    const auto corners = read_off_face(tokens, vertices, corner, extras);
    add_element(mesh, kind_of(static_cast<std::int64_t>(corners.size())), corners, source);
  }
  if (extras) source.add_only_in_file("face colours");
}

void read_text(Tokenizer& tokens, const OffHeader& header, SourceFile& source, Mesh& mesh, const IoContext& context) {
  const auto [vertices, faces] = read_off_counts(tokens);
  source.set_layout({.syntax = {.comment = '#'}});
  read_vertices(tokens, vertices, header, source, mesh, context);
  read_faces(tokens, faces, source, mesh, context);
  if (source.bytes().find('#') != std::string_view::npos) source.add_only_in_file("comments");
  if (!tokens.at_end()) {
    source.add_note(fmt::format("The file goes on after its {} faces (line {}); the rest is not read.", faces, tokens.line()));
    source.add_only_in_file("what follows the last face");
  }
}

// --- Binary: big endian, 32-bit integers and floats ---

void read_binary_faces(BinaryReader& reader, std::size_t count, SourceFile& source, Mesh& mesh) {
  mesh.elements.reserve(count, 4 * count);
  for (std::size_t f = 0; f < count; ++f) {
    const auto corners = reader.read<std::int32_t>("the faces");
    if (corners != 3 && corners != 4) reader.fail(wrong_off_corners(corners));
    std::array<Index, 4> corner{};
    const std::span<Index> used(corner.data(), static_cast<std::size_t>(corners));
    for (Index& c : used) {
      const auto index = reader.read<std::int32_t>("the faces");
      if (index < 0 || static_cast<std::size_t>(index) >= mesh.positions.size()) {
        reader.fail(fmt::format("vertex index {} of face {} out of range (the file has {} vertices)", index, f, mesh.positions.size()));
      }
      c = static_cast<Index>(index);
    }
    add_element(mesh, kind_of(corners), used, source);
    const auto colours = reader.read<std::int32_t>("the faces");
    if (colours < 0) reader.fail(fmt::format("face {} has {} colour components", f, colours));
    if (colours > 0) source.add_only_in_file("face colours");
    reader.skip(static_cast<std::size_t>(colours) * sizeof(float), "the face colours");
  }
}

void read_binary(BinaryReader reader, const OffHeader& header, SourceFile& source, Mesh& mesh) {
  const auto vertices = reader.read<std::int32_t>("the number of vertices");
  const auto faces = reader.read<std::int32_t>("the number of faces");
  (void)reader.read<std::int32_t>("the number of edges");
  if (vertices < 0 || faces < 0) reader.fail(fmt::format("{} vertices and {} faces", vertices, faces));
  const std::size_t extra = (header.normals ? 12U : 0U) + (header.colours ? 16U : 0U) + (header.texture ? 8U : 0U);
  const auto count = static_cast<std::size_t>(vertices);
  reader.require_count(count, 12 + extra, "vertices");
  source.set_layout(CoordinateLayout::packed(CoordinateScalar::Float32, true));
  source.set_uniform_places(reader.offset(), 12 + extra, count);
  reserve_large(mesh.positions, count);
  for (std::size_t v = 0; v < count; ++v) {
    std::array<double, 3> x{};
    for (double& c : x) {
      c = static_cast<double>(reader.read<float>("the vertices"));
      if (!std::isfinite(c)) reader.fail(fmt::format("a coordinate of vertex {} is not a finite number", v));
    }
    mesh.positions.push_back({x[0], x[1], x[2]});
    reader.skip(extra, "the vertices");
  }
  reader.require_count(static_cast<std::size_t>(faces), 20, "faces");
  read_binary_faces(reader, static_cast<std::size_t>(faces), source, mesh);
  if (reader.remaining() != 0) source.add_only_in_file("what follows the last face");
}

Mesh read_off(SourceFile& source, const IoContext& context) {
  Progress& progress = context.progress;
  Tokenizer tokens(source.bytes(), source.path().string(), {.comment = '#'}, progress);
  Mesh mesh;
  const OffHeader header = read_off_word(tokens);
  name_extras(header, source);
  const std::size_t after_word = tokens.offset();
  if (tokens.token_on_line() == "BINARY") {
    tokens.end_line();
    read_binary(BinaryReader(source.bytes(), tokens.offset(), true, source.path().string(), progress), header, source, mesh);
  } else {
    tokens.seek(after_word, tokens.line());
    read_text(tokens, header, source, mesh, context);
  }
  return mesh;
}

Notes write_off(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  Notes notes;
  require_surface_elements(file, mesh, kOffFormat.info.title);
  note_dropped(mesh, {}, {}, kOffFormat.info.title, notes);
  TextWriter out(file, context);
  out << "OFF\n";
  if (!mesh.title.empty()) out << "# " << one_line(mesh.title) << '\n';
  out << positions.size() << ' ' << mesh.elements.size() << " 0\n";
  out.for_each(positions.size(),
               [&](TextBuffer& part, std::size_t v) { part << positions[v].x << ' ' << positions[v].y << ' ' << positions[v].z << '\n'; });
  out.for_each(mesh.elements.size(), [&](TextBuffer& part, std::size_t e) {
    const FileCorners corners = file_corners(mesh, e);
    part << corners.size();
    put_corners(part, corners, 0);
    part << '\n';
  });
  out.finish();
  return notes;
}

}  // namespace

constinit const FormatHandler kOffFormat{.info = {"off", "OFF", ".off", "positions, triangles and quadrilaterals; ASCII and binary"},
                                         .recognises = recognises_off,
                                         .read = read_off,
                                         .write = write_off,
                                         .comment = {"# ", "\n"}};

std::optional<OffHeader> parse_off_header(std::string_view word) {
  OffHeader header;
  const auto eat = [&word](std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  header.texture = eat("ST");
  header.colours = eat("C");
  header.normals = eat("N");
  if (word != "OFF") return std::nullopt;
  return header;
}

OffHeader read_off_word(Tokenizer& tokens) {
  if (tokens.at_end()) tokens.fail_at_end("OFF");
  const std::size_t begin = tokens.offset();
  const std::string_view word = tokens.token_on_line();
  if (const auto found = parse_off_header(word)) return *found;
  if (word.front() < '0' || word.front() > '9' || word.find("OFF") != std::string_view::npos)
    tokens.fail(fmt::format("expected OFF (or a form of it such as COFF, NOFF, STOFF), got {}", quote_token(word)));
  tokens.seek(begin, tokens.line());  // the word may be missing
  return {};
}

OffCounts read_off_counts(Tokenizer& tokens) {
  constexpr std::size_t kShortestVertex = 6;  // bytes of "0 0 0\n"
  constexpr std::size_t kShortestFace = 8;    // bytes of "3 0 1 2\n"
  if (tokens.at_end()) tokens.fail_at_end("number of vertices");
  const std::size_t vertices = tokens.read_count("number of vertices", kShortestVertex);
  const std::size_t faces = tokens.read_count("number of faces", kShortestFace);
  tokens.end_line();  // the number of edges, which is unused and sometimes missing
  return {vertices, faces};
}

Vec3 read_off_vertex(Tokenizer& tokens, std::size_t& place, bool& extras) {
  const Vec3 p = tokens.read_point(3, place);
  extras = tokens.more_on_line() || extras;
  tokens.end_line();
  return p;
}

std::span<const Index> read_off_face(Tokenizer& tokens, std::size_t vertices, std::array<Index, 4>& corner, bool& extras) {
  const std::int64_t corners = tokens.read_integer("number of corners");
  if (corners != 3 && corners != 4) tokens.fail(wrong_off_corners(corners));
  const std::span<Index> used(corner.data(), static_cast<std::size_t>(corners));
  for (Index& c : used) c = tokens.read_index("vertex index", vertices, "vertices");
  extras = tokens.more_on_line() || extras;
  tokens.end_line();
  return used;
}

std::string wrong_off_corners(std::int64_t corners) {
  return fmt::format("face with {} corners: only triangles and quadrilaterals are read", corners);
}

}  // namespace dmoscope
