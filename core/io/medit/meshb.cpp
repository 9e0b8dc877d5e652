// MEDIT's binary format (.meshb, also called GMF): the sections of the text format by numbers, each with the offset of the next one.
// https://github.com/LoicMarechal/libMeshb

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/format.h"
#include "core/io/medit/medit.h"
#include "core/io/reading/binary.h"

namespace dmoscope {
namespace {

constexpr std::int32_t kDimension = 3, kVertices = 4, kEnd = 54;
constexpr std::array<std::int32_t, 5> kHigherOrderKeys{24, 25, 27, 30,
                                                       33};  // TrianglesP2, EdgesP2, QuadrilateralsQ2, TetrahedraP2, HexahedraQ2

/// Whether the bytes begin with the number 1 in either byte order, then a version of 1 to 4.
bool recognises_meshb(std::string_view bytes) {
  constexpr std::string_view kLittle("\x01\0\0\0", 4);
  constexpr std::string_view kBig("\0\0\0\x01", 4);
  if (bytes.size() < 8) return false;
  const bool big = bytes.starts_with(kBig);
  if (!big && !bytes.starts_with(kLittle)) return false;
  const auto version = load_number<std::int32_t>(bytes.data() + 4, big);
  return version >= 1 && version <= 4;
}

class MeshbReader {
 public:
  MeshbReader(SourceFile& source, const IoContext& context)
      : source_(source),
        progress_(context.progress),
        big_endian_(source.bytes().starts_with('\0')),
        in_(source.bytes(), 0, big_endian_, source.path().string(), context.progress),
        contents_(source) {}

  Mesh read() {
    if (!recognises_meshb(source_.bytes()))
      in_.fail("a binary MEDIT file begins with the number 1 and a version of 1 to 4, this one does not");
    in_.skip(4, "the head");
    version_ = in_.read<std::int32_t>("the version");
    while (in_.remaining() > 0 && section()) {
    }
    if (dimension_ == 0) in_.fail("the file has no Dimension");
    if (contents_.mesh.positions.empty()) in_.fail("the file has no Vertices");
    check_corners();
    Mesh mesh = contents_.finish();
    read_solutions_beside(source_, mesh, progress_);
    return mesh;
  }

 private:
  [[nodiscard]] std::size_t whole_bytes() const noexcept { return version_ == 4 ? 8 : 4; }
  [[nodiscard]] std::size_t real_bytes() const noexcept { return version_ == 1 ? 4 : 8; }

  std::int64_t whole(std::string_view what) { return version_ == 4 ? in_.read<std::int64_t>(what) : in_.read<std::int32_t>(what); }
  double real(std::string_view what) {
    const double value = version_ == 1 ? static_cast<double>(in_.read<float>(what)) : in_.read<double>(what);
    if (!std::isfinite(value)) in_.fail(fmt::format("{} of vertex {} is not a finite number", what, contents_.mesh.positions.size() + 1));
    return value;
  }
  int reference() {
    const std::int64_t value = whole("a reference");
    if (!std::in_range<int>(value)) in_.fail(fmt::format("reference {} is too large", value));
    return static_cast<int>(value);
  }
  std::size_t count(std::size_t bytes_each, std::string_view what) {
    const std::int64_t n = whole(what);
    if (n < 0) in_.fail(fmt::format("the number of {} is negative: {}", what, n));
    in_.require_count(static_cast<std::uint64_t>(n), bytes_each, what);
    if (static_cast<std::uint64_t>(n) >= kNoIndex) in_.fail(fmt::format("{} {}: this program can hold {} at most", n, what, kNoIndex - 1));
    return static_cast<std::size_t>(n);
  }

  /// Reads one keyword with all its data; false at the end.
  bool section() {
    const auto code = in_.read<std::int32_t>("a keyword");
    if (code == kEnd) return false;
    const std::int64_t next =
        version_ >= 3 ? in_.read<std::int64_t>("the place of the next keyword") : in_.read<std::int32_t>("the place of the next keyword");
    const std::size_t size = source_.bytes().size();
    if (next != 0 && (next < static_cast<std::int64_t>(in_.offset()) || static_cast<std::uint64_t>(next) > size)) {
      in_.fail(fmt::format("keyword {} says that the next one is at byte {} of {}", code, next, size));
    }
    const std::size_t end = next == 0 ? size : static_cast<std::size_t>(next);
    if (contents_of(code)) {
      if (next != 0 && in_.offset() != end) {
        in_.fail(fmt::format("keyword {} ends at byte {}, but says that the next one is at byte {}", code, in_.offset(), end));
      }
    } else {
      source_.add_only_in_file(fmt::format("what stands under keyword {}", code));
      in_.skip(end - in_.offset(), "a section");
    }
    return next != 0;
  }

  bool contents_of(std::int32_t code) {
    if (std::ranges::find(kHigherOrderKeys, code) != kHigherOrderKeys.end()) {
      in_.fail(fmt::format("elements of higher order (keyword {}), of which only the linear ones are read: export linear elements", code));
    }
    const auto cells = std::ranges::find(kMeditCells, code, &MeditCells::code);
    const auto marks = std::ranges::find(kMeditMarks, code, &MeditMark::code);
    const bool known = code == kDimension || code == kVertices || cells != kMeditCells.end() || marks != kMeditMarks.end();
    if (!known) return false;
    if (std::ranges::find(met_, code) != met_.end()) in_.fail(fmt::format("keyword {} a second time", code));
    met_.push_back(code);
    if (code == kDimension) {
      dimension_ = in_.read<std::int32_t>("the dimension");
      if (dimension_ != 2 && dimension_ != 3) in_.fail(fmt::format("Dimension {}: only 2 and 3 dimensions are read", dimension_));
    } else if (code == kVertices) {
      vertices();
    } else if (cells != kMeditCells.end()) {
      read_cells(*cells);
    } else {
      read_marks(marks->keyword);
    }
    return true;
  }

  void vertices() {
    if (dimension_ == 0) in_.fail("Vertices before Dimension");
    const std::size_t stride = static_cast<std::size_t>(dimension_) * real_bytes() + whole_bytes();
    const std::size_t n = count(stride, "vertices");
    const auto type = version_ == 1 ? CoordinateScalar::Float32 : CoordinateScalar::Float64;
    source_.set_layout(CoordinateLayout::packed(type, big_endian_, dimension_));
    source_.set_uniform_places(in_.offset(), stride, n);
    reserve_large(contents_.mesh.positions, n);
    contents_.references.reserve(n);
    for (std::size_t v = 0; v < n; ++v) {
      Vec3 p;
      p.x = real("x");
      p.y = real("y");
      if (dimension_ == 3) p.z = real("z");
      contents_.mesh.positions.push_back(p);
      contents_.references.push_back(reference());
    }
  }

  void read_cells(const MeditCells& section) {
    const Index corners = corners_of(section.shape);
    const std::size_t n = count((corners + 1) * whole_bytes(), section.keyword);
    contents_.reserve_cells(section.shape, n);
    for (std::size_t i = 0; i < n; ++i) {
      std::array<Index, 8> of_cell{};
      for (Index k = 0; k < corners; ++k) {
        const std::int64_t vertex = whole("a vertex of a cell");
        if (vertex < 1 || vertex >= std::int64_t{kNoIndex}) in_.fail(fmt::format("{} name vertex {}", section.keyword, vertex));
        of_cell[k] = static_cast<Index>(vertex - 1);
        largest_ = std::max(largest_, vertex);
      }
      contents_.add_cell(section.shape, of_cell.data(), reference());
    }
  }

  void read_marks(std::string_view keyword) {
    MeditMarks marks{std::string(keyword), {}, {}};
    marks.numbers.resize(count(whole_bytes(), keyword));
    for (std::int64_t& number : marks.numbers) number = whole(keyword);
    contents_.add_marks(std::move(marks));
  }

  /// Checks the corners of cells, which may come before the vertices.
  void check_corners() const {
    const std::size_t n = contents_.mesh.positions.size();
    if (largest_ > static_cast<std::int64_t>(n)) in_.fail(fmt::format("a cell names vertex {}, but the file has {} vertices", largest_, n));
  }

  SourceFile& source_;
  Progress& progress_;
  bool big_endian_;
  BinaryReader in_;
  MeditContents contents_;
  std::int32_t version_ = 0;
  int dimension_ = 0;
  std::int64_t largest_ = 0;  // greatest vertex that a cell names
  std::vector<std::int32_t> met_;
};

}  // namespace

constinit const FormatHandler kMeshbFormat{
    .info = {"meshb", "MEDIT binary", ".meshb", "as MEDIT, versions 1 to 4, either byte order; only written where it was read"},
    .recognises = recognises_meshb,
    .read = read_with<MeshbReader>,
    .further = solutions_beside,
    .not_written = "binary MEDIT files are written only where one was read: write it as .mesh"};

}  // namespace dmoscope
