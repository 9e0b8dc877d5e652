// TELEMAC's format for meshes and results, SELAFIN (also called SERAFIN): Fortran's records of numbers in either byte order, x and y in
// single or double precision, triangles or quadrilaterals in a plane, and the variables of each time step. http://wiki.opentelemac.org
// (SERAFIN format)

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
#include "core/io/format.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {
namespace {

constexpr std::size_t kTitleBytes = 80, kNameBytes = 32, kMark = 4;  // a record's size is before and behind it

bool begins_record_of_80(std::string_view bytes, bool big_endian) {
  return bytes.size() >= kTitleBytes + 2 * kMark && load_number<std::uint32_t>(bytes.data(), big_endian) == kTitleBytes &&
         load_number<std::uint32_t>(bytes.data() + kMark + kTitleBytes, big_endian) == kTitleBytes;
}
bool recognises_selafin(std::string_view bytes) { return begins_record_of_80(bytes, true) || begins_record_of_80(bytes, false); }

class SelafinReader {
 public:
  SelafinReader(SourceFile& source, const IoContext& context)
      : source_(source),
        big_endian_(!begins_record_of_80(source.bytes(), false)),
        in_(source.bytes(), 0, big_endian_, source.path().string(), context.progress) {}

  Mesh read() {
    if (!recognises_selafin(source_.bytes())) in_.fail("a SELAFIN file begins with a title of 80 characters");
    begin(kTitleBytes, "the title");
    const std::string_view title = text(kTitleBytes);
    if (title.ends_with("SERAFIND")) size_ = sizeof(double);
    mesh_.title = trimmed(title.substr(0, kTitleBytes - 8));
    end();
    read_head();
    read_mesh();
    read_last_step();
    return std::move(mesh_);
  }

 private:
  // --- Records ---
  void begin(std::uint64_t bytes, std::string_view what) {
    const auto said = in_.read<std::uint32_t>(what);
    if (said != bytes)
      in_.fail(fmt::format("byte {}: {} should be a record of {} bytes, which this is not ({})", in_.offset() - kMark, what, bytes, said));
    in_.require_count(bytes, 1, what);
    record_ = bytes;
  }
  void end() {
    if (in_.read<std::uint32_t>("the end of a record") != record_)
      in_.fail(fmt::format("byte {}: a record does not end where its size says", in_.offset() - kMark));
  }
  std::string_view text(std::size_t bytes) {
    const std::string_view found = source_.bytes().substr(in_.offset(), bytes);
    in_.skip(bytes, "a text");
    return found;
  }
  std::vector<std::int32_t> wholes(std::size_t count, std::string_view what) {
    begin(std::uint64_t{count} * sizeof(std::int32_t), what);
    std::vector<std::int32_t> values(count);
    for (std::int32_t& value : values) value = in_.read<std::int32_t>(what);
    end();
    return values;
  }
  std::vector<double> reals(std::size_t count, std::string_view what) {
    begin(std::uint64_t{count} * size_, what);
    std::vector<double> values(count);
    for (double& value : values) value = size_ == sizeof(double) ? in_.read<double>(what) : static_cast<double>(in_.read<float>(what));
    end();
    return values;
  }

  void read_head() {
    const auto counts = wholes(2, "the number of variables");
    for (const std::int32_t count : counts)
      if (count < 0) in_.fail(fmt::format("{} variables", count));
    const std::size_t variables = static_cast<std::size_t>(counts[0]) + static_cast<std::size_t>(counts[1]);
    in_.require_count(variables, kNameBytes + 2 * kMark, "names of variables");
    for (std::size_t i = 0; i < variables; ++i) {
      begin(kNameBytes, "the name of a variable");
      names_.emplace_back(trimmed(text(kNameBytes).substr(0, kNameBytes / 2)));
      end();
    }
    const auto parameters = wholes(10, "the parameters");
    if (parameters[6] > 1) in_.fail("a file of TELEMAC-3D, in layers: those of planar meshes are read");
    if (parameters[9] == 1) (void)wholes(6, "the date");
    if (parameters[2] != 0 || parameters[3] != 0) source_.add_only_in_file("the origin of its coordinates");
  }

  void read_mesh() {
    const auto sizes = wholes(4, "the size of the mesh");
    if (sizes[0] < 0 || sizes[1] < 0) in_.fail(fmt::format("{} elements and {} points", sizes[0], sizes[1]));
    if (sizes[2] != 3 && sizes[2] != 4) in_.fail(fmt::format("elements of {} corners: triangles and quadrilaterals are read", sizes[2]));
    const auto elements = static_cast<std::size_t>(sizes[0]), points = static_cast<std::size_t>(sizes[1]);
    const auto corners = static_cast<std::size_t>(sizes[2]);
    in_.require_count(std::uint64_t{elements} * corners + points, sizeof(std::int32_t), "numbers of points");
    add_elements(wholes(elements * corners, "the elements"), corners, points);
    (void)wholes(points, "the numbers of the boundary");
    source_.add_only_in_file("the numbers of its boundary points");
    in_.require_count(std::uint64_t{points} * 2, size_, "coordinates");
    const std::size_t first = in_.offset() + kMark;
    const std::vector<double> x = reals(points, "the x coordinates"), y = reals(points, "the y coordinates");
    reserve_large(mesh_.positions, points);
    for (std::size_t v = 0; v < points; ++v) {
      if (!std::isfinite(x[v]) || !std::isfinite(y[v])) in_.fail(fmt::format("a coordinate of point {} is not finite", v + 1));
      mesh_.positions.push_back({x[v], y[v], 0.0});
    }
    CoordinateLayout layout;
    layout.binary = true;
    layout.components = 2;
    layout.big_endian = big_endian_;
    layout.scalar.fill(size_ == sizeof(double) ? CoordinateScalar::Float64 : CoordinateScalar::Float32);
    layout.at = {0, static_cast<std::uint32_t>(points * size_ + 2 * kMark), 0};
    source_.set_layout(layout);
    source_.set_uniform_places(first, size_, points);
    if (points * size_ + 2 * kMark > 0xffffffffU) source_.set_not_patchable("its records are too long");
  }

  void add_elements(const std::vector<std::int32_t>& numbers, std::size_t corners, std::size_t points) {
    mesh_.elements.reserve(numbers.size() / corners, numbers.size());
    std::array<Index, 4> own{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i] < 1 || static_cast<std::size_t>(numbers[i]) > points)
        in_.fail(fmt::format("element {} names point {}, but there are {}", i / corners + 1, numbers[i], points));
      own[i % corners] = static_cast<Index>(numbers[i] - 1);
      if (i % corners == corners - 1)
        add_element(mesh_, corners == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, std::span(own).first(corners), source_);
    }
  }

  /// Reads the variables of the last complete time step.
  void read_last_step() {
    const std::size_t points = mesh_.positions.size(), time = size_ + 2 * kMark, one = points * size_ + 2 * kMark;
    const std::size_t step = time + names_.size() * one, steps = in_.remaining() / step;
    if (names_.empty() || steps == 0) return;
    in_.skip((steps - 1) * step, "time steps");
    (void)reals(1, "the time");
    for (const std::string& name : names_) {
      const std::uint64_t begin = in_.offset() + kMark;
      mesh_.fields.push_back({.name = name,
                              .on = Field::On::Vertices,
                              .type = size_ == sizeof(double) ? "double" : "float",
                              .values = reals(points, "a variable"),
                              .place = {.begin = begin, .bytes = static_cast<std::uint32_t>(size_)}});
    }
    if (steps == 1) return;
    source_.add_note(fmt::format("Fields are those of the last of {} time steps.", steps));
    source_.add_only_in_file("earlier time steps");
  }

  SourceFile& source_;
  bool big_endian_;
  BinaryReader in_;
  Mesh mesh_;
  std::size_t size_ = sizeof(float);  // bytes of a real number
  std::uint64_t record_ = 0;
  std::vector<std::string> names_;
};

/// Patches the coordinates: all x come before all y, not vertex by vertex.
Notes patch_selafin(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext&) {
  const std::span<const Vec3> positions = moved.positions;
  const SourceFile& source = *mesh.source;
  const CoordinateLayout& layout = source.layout();
  std::string bytes(source.bytes());
  std::size_t rounded = 0;
  const auto put_at = [&](std::size_t byte, std::size_t vertex, double before, double after) {
    if (std::bit_cast<std::uint64_t>(before) == std::bit_cast<std::uint64_t>(after)) return;
    char* const at = bytes.data() + byte;
    if (layout.scalar[0] == CoordinateScalar::Float64) {
      std::ranges::copy(store_number(after, layout.big_endian), at);
      return;
    }
    const auto single = static_cast<float>(after);
    if (!std::isfinite(single))
      throw OutputError(file.path().string(), fmt::format("{} of vertex {} is too large for a 32-bit float", after, vertex));
    if (static_cast<double>(single) != after) ++rounded;
    std::ranges::copy(store_number(single, layout.big_endian), at);
  };
  const auto put = [&](std::size_t vertex, std::size_t axis, double before, double after) {
    put_at(source.place(vertex) + layout.at[axis], vertex, before, after);
  };
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (positions[v].z != mesh.positions[v].z)
      throw OutputError(file.path().string(), fmt::format("vertex {} has z = {}, but the file holds only x and y", v, positions[v].z));
    put(v, 0, mesh.positions[v].x, positions[v].x);
    put(v, 1, mesh.positions[v].y, positions[v].y);
  }
  for (const FieldValues& changed : moved.fields) {
    const Field& field = mesh.fields[changed.field];
    for (std::size_t v = 0; v < positions.size(); ++v)
      put_at(field.place.begin + v * field.place.bytes, v, field.values[v], changed.values[v]);
  }
  file.write(bytes);
  if (rounded == 0) return {};
  return {fmt::format("{} moved numbers were rounded to 32-bit floats, which is what the file holds.", rounded)};
}

}  // namespace

constinit const FormatHandler kSelafinFormat{.info = {"selafin", "TELEMAC SELAFIN", ".slf .sel .ser",
                                                      "triangles or quadrilaterals in a plane, variables; only written where it was read"},
                                             .recognises = recognises_selafin,
                                             .read = read_with<SelafinReader>,
                                             .patch = patch_selafin,
                                             .not_written = "SELAFIN files are written only where one was read: write it as .2dm"};

}  // namespace dmoscope
