// STL: ASCII and binary. The file repeats a vertex in every facet around it: equal corners become one vertex, else there would be no mesh
// to smooth, and a moved vertex is written to all its places.

#include "core/io/polygons/stl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/rounding.h"
#include "core/base/same_bits.h"
#include "core/io/format.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/mixed_input.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {

namespace {

bool begins_with_solid(std::string_view bytes) noexcept { return equal_ignoring_case(bytes.substr(0, 5), "solid"); }

void expect(MixedInput& in, std::string_view keyword) {
  const std::string_view found = in.word(keyword);
  if (!equal_ignoring_case(found, keyword)) in.fail(fmt::format("expected \"{}\", got {}", keyword, quote_token(found)));
}

void read_number(MixedInput& in, StlFacet& facet, std::size_t i) {
  // Accepts any normal (degenerate facets have NaN in many files), since it follows from the corners.
  facet.numbers[i] = i < 3 ? in.number("a component of the normal") : in.coordinate();
  facet.places[i] = in.token();
  facet.sizes[i] = in.offset() - in.token();
}

/// Reads a facet behind the word "facet".
void read_facet(MixedInput& in, StlFacet& facet) {
  expect(in, "normal");
  for (std::size_t i = 0; i < 3; ++i) read_number(in, facet, i);
  expect(in, "outer");
  expect(in, "loop");
  for (std::size_t corner = 0; corner < 3; ++corner) {
    expect(in, "vertex");
    for (std::size_t k = 0; k < 3; ++k) read_number(in, facet, 3 + 3 * corner + k);
  }
  if (equal_ignoring_case(in.peek_word(), "vertex")) {
    in.word("endloop");
    in.fail("a facet of more than three corners");
  }
  expect(in, "endloop");
  expect(in, "endfacet");
}

void ascii_facets(MixedInput& in, const std::function<void(std::string_view)>& solid, const std::function<void(const StlFacet&)>& each) {
  StlFacet facet;
  while (!in.at_end()) {
    expect(in, "solid");
    solid(in.rest_of_line());
    for (;;) {
      const std::string_view keyword = in.word("\"facet\" or \"endsolid\"");
      if (equal_ignoring_case(keyword, "endsolid")) {
        in.rest_of_line();
        break;
      }
      if (!equal_ignoring_case(keyword, "facet")) in.fail("expected \"facet\" or \"endsolid\", got " + quote_token(keyword));
      read_facet(in, facet);
      each(facet);
    }
  }
}

void binary_facets(MixedInput& in, const std::function<void(std::string_view)>& solid, const std::function<void(const StlFacet&)>& each) {
  const std::string_view header = in.block(kStlHeaderBytes, "the header (a text file begins with \"solid\")");
  const auto n = load_number<std::uint32_t>(header.data() + 80, false);
  if (in.left() != std::size_t{n} * kStlFacetBytes) {
    in.fail_at(
        80, fmt::format("{}: {} facets take {} bytes, {} are left", in.left() < std::size_t{n} * kStlFacetBytes ? "truncated" : "too long",
                        n, std::size_t{n} * kStlFacetBytes, in.left()));
  }
  std::string_view name = header.substr(0, std::min<std::size_t>(80, header.find('\0')));
  while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
  solid(name);
  StlFacet facet;
  for (std::uint32_t f = 0; f < n; ++f) {
    const std::string_view data = in.block(kStlFacetBytes, "a facet");
    for (std::size_t i = 0; i < 12; ++i) {
      facet.numbers[i] = static_cast<double>(load_number<float>(data.data() + 4 * i, false));
      facet.places[i] = in.token() + 4 * i;
      facet.sizes[i] = 4;
      if (i >= 3 && !std::isfinite(facet.numbers[i])) {
        in.fail_at(facet.places[i], fmt::format("a coordinate of facet {} is not a finite number", f));
      }
    }
    facet.attribute = load_number<std::uint16_t>(data.data() + 48, false);
    each(facet);
  }
}

bool size_fits(std::string_view bytes) noexcept {
  if (bytes.size() < kStlHeaderBytes) return false;
  return bytes.size() == kStlHeaderBytes + std::size_t{load_number<std::uint32_t>(bytes.data() + 80, false)} * kStlFacetBytes;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) noexcept {
  // Detects a truncated binary file that begins with "solid" by its zero bytes.
  return size_fits(bytes) || !begins_with_solid(bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()))) ||
         bytes.substr(0, 512).find('\0') != std::string_view::npos;
}

bool recognises_stl(std::string_view bytes) {
  if (size_fits(bytes)) return bytes.size() > kStlHeaderBytes;
  if (!begins_with_solid(bytes)) return false;
  const std::string_view begin = bytes.substr(0, 1024);
  return begin.find("facet") != std::string_view::npos || begin.find("FACET") != std::string_view::npos;
}

void for_each_stl_facet(const SourceFile& source, Progress& progress, const std::function<void(std::string_view)>& solid,
                        const std::function<void(const StlFacet&)>& facet) {
  MixedInput in(source, progress);
  if (is_binary_stl(source.bytes())) {
    binary_facets(in, solid, facet);
  } else {
    ascii_facets(in, solid, facet);
  }
}

namespace {

/// Numbers positions in order of first appearance. Positions that compare equal are one: -0.0 is 0.0.
class Welder {
 public:
  /// Adds a position; returns its number, and whether it is new.
  std::pair<Index, bool> add(Vec3 p) {
    if (2 * positions_.size() >= slots_.size()) grow();
    Index& slot = slots_[slot_of(p)];
    if (slot != kNoIndex) return {slot, false};
    slot = static_cast<Index>(positions_.size());
    positions_.push_back(p);
    return {slot, true};
  }
  /// Takes out all distinct positions.
  [[nodiscard]] std::vector<Vec3> take() noexcept { return std::move(positions_); }

 private:
  static std::uint64_t hash(Vec3 p) noexcept {
    std::uint64_t h = 0;
    for (const double c : {p.x, p.y, p.z}) {
      h = (h ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15U;  // + 0.0: -0.0 becomes 0.0
      h ^= h >> 29;
    }
    return h;
  }
  /// The slot with the position's number, or the free slot for it.
  [[nodiscard]] std::size_t slot_of(Vec3 p) const noexcept {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = hash(p) & mask;
    while (slots_[i] != kNoIndex && !(positions_[slots_[i]] == p)) i = (i + 1) & mask;
    return i;
  }
  void grow() {
    constexpr std::size_t kFirst = 1024;  // a power of two, like all later sizes
    slots_ = large_vector<Index>(std::max(kFirst, 2 * slots_.size()), kNoIndex);
    for (std::size_t i = 0; i < positions_.size(); ++i) slots_[slot_of(positions_[i])] = static_cast<Index>(i);
  }

  std::vector<Vec3> positions_;
  std::vector<Index> slots_;  // numbers of positions by their hash, at most half of the slots used
};

Vec3 corner_of(const StlFacet& facet, std::size_t corner) {
  return {facet.numbers[3 + 3 * corner], facet.numbers[4 + 3 * corner], facet.numbers[5 + 3 * corner]};
}

/// Unit normal of a triangle, or 0 0 0 if it has no area.
Vec3 facet_normal(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  // Scales first, so that neither tiny nor huge triangles lose their normal.
  const double su = std::max({std::abs(u.x), std::abs(u.y), std::abs(u.z)});
  const double sv = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(su > 0.0) || !(sv > 0.0) || !std::isfinite(su) || !std::isfinite(sv)) return {};
  const Vec3 n = cross(Vec3{u.x / su, u.y / su, u.z / su}, Vec3{v.x / sv, v.y / sv, v.z / sv});
  const double size = length(n);
  return size > 0.0 ? Vec3{n.x / size, n.y / size, n.z / size} : Vec3{};
}

Mesh read_stl(SourceFile& source, const IoContext& context) {
  Mesh mesh;
  Welder welder;
  std::vector<Index> place_vertices;
  Field attributes{.name = "attribute", .on = Field::On::Elements, .type = "ushort", .role = "attribute"};
  bool any_attribute = false;
  std::size_t solids = 0;
  const auto solid = [&](std::string_view name) {
    if (++solids == 1) mesh.title = name;
  };
  const auto facet = [&](const StlFacet& read) {
    std::array<Index, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = welder.add(corner_of(read, k)).first;
      source.add_place(read.places[3 + 3 * k]);
      place_vertices.push_back(corners[k]);
    }
    add_element(mesh, ElementKind::Triangle, corners, source);
    attributes.values.push_back(read.attribute);
    any_attribute = any_attribute || read.attribute != 0;
  };
  for_each_stl_facet(source, context.progress, solid, facet);
  mesh.positions = welder.take();
  source.set_layout(is_binary_stl(source.bytes()) ? CoordinateLayout::packed(CoordinateScalar::Float32, false)
                                                  : CoordinateLayout{.syntax = {.free_form = true}});
  source.set_place_vertices(std::move(place_vertices));
  if (any_attribute) mesh.fields.push_back(std::move(attributes));
  if (solids > 1) source.add_only_in_file(fmt::format("division into {} solids", solids));
  return mesh;
}

/// Number of vertices of `positions`, among those of elements, that share their place with another one.
std::size_t count_coincident(const Mesh& mesh, std::span<const Vec3> positions, bool as_float) {
  Welder welder;
  std::vector<bool> seen(positions.size(), false);
  std::size_t coincident = 0;
  for (const Index v : mesh.elements.all_corners()) {
    if (seen[v]) continue;
    seen[v] = true;
    Vec3 p = positions[v];
    if (as_float) p = {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
    if (!welder.add(p).second) ++coincident;
  }
  return coincident;
}

void note_coincident(std::size_t coincident, Notes& notes) {
  if (coincident == 0) return;
  notes.push_back(fmt::format("{} vertices lie exactly where another one does: reading the file joins them.", coincident));
}

/// Copies the source, with moved coordinates and the normals of their facets replaced.
class StlPatcher {
 public:
  StlPatcher(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : file_(file), mesh_(mesh), positions_(positions), binary_(is_binary_stl(mesh.source->bytes())), out_(file, context) {}

  Notes write(Progress& progress) {
    const SourceFile& source = *mesh_.source;
    for_each_stl_facet(
        source, progress, [](std::string_view) {}, [this](const StlFacet& facet) { add(facet); });
    copy_until(source.bytes().size());
    out_.finish();
    Notes notes;
    if (rounded_ > 0) {
      notes.push_back(fmt::format("{} moved coordinates were rounded to 32-bit floats, which is what the file holds.", rounded_));
    }
    if (moved_) note_coincident(count_coincident(mesh_, positions_, binary_), notes);
    return notes;
  }

 private:
  void add(const StlFacet& facet) {
    std::array<Index, 3> vertices{};
    for (Index& vertex : vertices) vertex = static_cast<Index>(mesh_.source->vertex_at(place_++));
    const auto moved = [this](Index v) { return !same_bits(mesh_.positions[v], positions_[v]); };
    if (!moved(vertices[0]) && !moved(vertices[1]) && !moved(vertices[2])) return;
    moved_ = true;
    const Vec3 normal = facet_normal(positions_[vertices[0]], positions_[vertices[1]], positions_[vertices[2]]);
    replace(facet, 0, normal);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 before = mesh_.positions[vertices[k]];
      const Vec3 after = positions_[vertices[k]];
      if (!same_bits(before.x, after.x)) replace(facet, 3 + 3 * k, after.x);
      if (!same_bits(before.y, after.y)) replace(facet, 4 + 3 * k, after.y);
      if (!same_bits(before.z, after.z)) replace(facet, 5 + 3 * k, after.z);
    }
  }

  void replace(const StlFacet& facet, std::size_t i, Vec3 v) {
    replace(facet, i, v.x);
    replace(facet, i + 1, v.y);
    replace(facet, i + 2, v.z);
  }

  void replace(const StlFacet& facet, std::size_t i, double value) {
    copy_until(facet.places[i]);
    if (binary_) {
      const auto rounded = static_cast<float>(value);
      if (!std::isfinite(rounded)) {
        throw OutputError(file_.path().string(), fmt::format("coordinate {} is too large for a 32-bit float", value));
      }
      if (i >= 3 && static_cast<double>(rounded) != value) ++rounded_;
      const auto raw = store_number(rounded, false);
      out_ << std::string_view(raw.data(), raw.size());
    } else {
      out_ << value;
    }
    copied_ += facet.sizes[i];
  }

  void copy_until(std::size_t offset) {
    constexpr std::size_t kPiece = std::size_t{1} << 20;  // piece size, so that a cancel is noticed in time
    while (copied_ < offset) {
      const std::size_t size = std::min(kPiece, offset - copied_);
      out_ << mesh_.source->bytes().substr(copied_, size);
      copied_ += size;
    }
  }

  AtomicFile& file_;
  const Mesh& mesh_;
  std::span<const Vec3> positions_;
  bool binary_;
  TextWriter out_;
  std::size_t place_ = 0;   // place of the next corner
  std::size_t copied_ = 0;  // number of the source's bytes that were copied or replaced
  std::size_t rounded_ = 0;
  bool moved_ = false;
};

Notes patch_stl(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  return StlPatcher(file, mesh, moved.positions, context).write(context.progress);
}

void note_vertices(const Mesh& mesh, std::span<const Vec3> positions, Notes& notes) {
  std::vector<bool> used(positions.size(), false);
  std::size_t next = 0;
  bool in_order = true;
  for (const Index v : mesh.elements.all_corners()) {
    if (used[v]) continue;
    used[v] = true;
    in_order = in_order && v == next;
    ++next;
  }
  if (next < positions.size())
    notes.push_back(fmt::format("Dropped: {} vertices that no element uses; STL holds only facets.", positions.size() - next));
  if (!in_order) notes.push_back("Dropped: the order of the vertices; STL holds only facets.");
  note_coincident(count_coincident(mesh, positions, false), notes);
}

Notes write_stl(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  for (const ElementKind kind : mesh.elements.kinds()) {
    if (kind == ElementKind::Triangle) continue;
    throw OutputError(file.path().string(), fmt::format("STL holds only triangles, and the mesh has {}: choose VTK{}", info(kind).plural,
                                                        info(kind).dimension == 2 ? ", PLY, OBJ or OFF" : " legacy"));
  }
  TextWriter out(file, context);
  const std::string name = one_line(mesh.title);  // without NUL, which would make it a binary file
  out << "solid " << name << '\n';
  out.for_each(mesh.elements.size(), [&](TextBuffer& part, std::size_t e) {
    const FileCorners corners = file_corners(mesh, e);
    const Vec3 normal = facet_normal(positions[corners[0]], positions[corners[1]], positions[corners[2]]);
    part << "  facet normal " << normal.x << ' ' << normal.y << ' ' << normal.z << "\n    outer loop\n";
    for (const Index v : corners) {
      part << "      vertex " << positions[v].x << ' ' << positions[v].y << ' ' << positions[v].z << '\n';
    }
    part << "    endloop\n  endfacet\n";
  });
  out << "endsolid " << name << '\n';
  out.finish();
  Notes notes;
  note_vertices(mesh, positions, notes);
  note_dropped(mesh, {}, {}, "STL", notes);
  return notes;
}

}  // namespace

constinit const FormatHandler kStlFormat{.info = {"stl", "STL", ".stl", "triangles; ASCII and binary; equal corners are one vertex"},
                                         .recognises = recognises_stl,
                                         .read = read_stl,
                                         .write = write_stl,
                                         .patch = patch_stl};

}  // namespace dmoscope
