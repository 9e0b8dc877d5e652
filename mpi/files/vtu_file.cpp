// Reads and writes VTU with raw appended data by many ranks, each its parts of the arrays.

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/io/reading/binary.h"
#include "core/io/vtk/vtk_cells.h"
#include "core/io/vtu/vtu_document.h"
#include "mpi/files/shared_mesh_file.h"
#include "mpi/reading/byte_range.h"

namespace dmoscope {
namespace {

constexpr std::string_view kHowToSave = "save it as raw appended data without compression, or as PVTU (dmoscope convert IN OUT.pvtu)";

/// Numbers of an array: their place in the file, and their type.
struct RawArray {
  std::uint64_t begin = 0, count = 0;
  ScalarType type = ScalarType::Float64;
  bool big_endian = false;
  std::size_t components = 1;

  [[nodiscard]] std::uint64_t at(std::uint64_t i) const { return begin + i * size_of(type); }
  template <class Number>
  [[nodiscard]] std::vector<Number> read(const RangeFile& file, std::uint64_t first, std::uint64_t last) const {
    constexpr std::uint64_t kAtOnce = std::uint64_t{1} << 20U;  // numbers read at a time
    std::vector<Number> values;
    values.reserve(last - first);
    for (std::uint64_t i = first; i < last; i += kAtOnce) {
      const std::uint64_t end = std::min(i + kAtOnce, last);
      const std::string bytes = file.read(at(i), (end - i) * size_of(type));
      for (std::uint64_t k = 0; k < end - i; ++k) {
        const char* const number = bytes.data() + k * size_of(type);
        if constexpr (std::is_same_v<Number, double>)
          values.push_back(load_scalar(number, type, big_endian));
        else
          values.push_back(static_cast<Number>(load_whole(number, type, big_endian)));
      }
    }
    return values;
  }
};

class VtuFile final : public SharedMeshFile {
 public:
  VtuFile(const World& world, std::filesystem::path path) : world_(world), path_(std::move(path)) {}

  MeshBlock read(const FieldFilter& filter) override {
    world_.together([&] {
      file_.emplace(path_);
      stamp_ = file_->stamp();
      read_head(filter);
    });
    MeshBlock block;
    block.vertices = Ranges(points_count_, world_.size());
    block.elements = Ranges(cells_count_, world_.size());
    block.single_precision = points_.type == ScalarType::Float32;
    world_.together([&] {
      points(block);
      cells(block);
      for (const Wanted& one : wanted_) {
        const Ranges& rows = one.on == Field::On::Vertices ? block.vertices : block.elements;
        block.fields.push_back({one.name, one.on, one.array.read<double>(*file_, rows.begin(world_.rank()), rows.end(world_.rank()))});
      }
    });
    file_.reset();
    return block;
  }

  std::vector<std::string> write(const std::filesystem::path& target, std::span<const Vec3> positions) override {
    world_.together([&] {
      file_.emplace(path_);
      file_->require_unchanged(stamp_);
    });
    SharedOutput output(world_, target, file_->size());
    world_.together([&] { copy(output); });
    world_.together([&] { write_points(output, target, positions); });
    file_.reset();
    return output.commit();
  }
  std::vector<std::string> nodal_fields() const override { return nodal_fields_; }

 private:
  struct Wanted {
    std::string name;
    Field::On on;
    RawArray array;
  };
  static constexpr std::size_t kCopyBytes = std::size_t{8} << 20U;

  /// The XML, up to the appended data's underscore.
  [[nodiscard]] std::string head() const {
    constexpr std::uint64_t kFirst = std::uint64_t{1} << 16U;
    for (std::uint64_t size = kFirst;; size *= 4) {
      std::string text = file_->read(0, size);
      const std::size_t tag = text.find("<AppendedData");
      const std::size_t underscore = tag == std::string::npos ? tag : text.find('_', text.find('>', tag));
      if (underscore != std::string::npos) return text.substr(0, underscore + 1);
      if (text.size() == file_->size() || text.size() > (std::uint64_t{256} << 20U))
        throw InputError(path_.string(), 0, fmt::format("a VTU file without appended data: {}", kHowToSave));
    }
  }

  void read_head(const FieldFilter& filter) {
    const SourceFile source(path_, FileBytes(head()));
    Progress unwatched;
    const VtuDocument document(source, file_->size(), unwatched);
    if (document.structured() || document.compressed())
      document.fail(document.grid(), fmt::format("several ranks cannot read this: {}", kHowToSave));
    const auto pieces = document.grid().children("Piece");
    if (std::distance(pieces.begin(), pieces.end()) != 1)
      document.fail(document.grid(), fmt::format("it has several pieces: {}", kHowToSave));
    const pugi::xml_node piece = *pieces.begin();
    constexpr std::size_t kMost = std::size_t{1} << 48U;
    points_count_ = document.count(piece, "NumberOfPoints", kMost);
    cells_count_ = document.count(piece, "NumberOfCells", kMost);
    if (points_count_ == 0 || cells_count_ == 0) document.fail(piece, "the file holds no vertices or no elements");
    points_ = raw(document, piece.child("Points").child("DataArray"), 3 * points_count_);
    if (is_whole(points_.type)) document.fail(piece, "its points are whole numbers, which cannot be moved");
    for (const pugi::xml_node array : piece.child("Cells").children("DataArray")) {
      const std::string_view name = array.attribute("Name").value();
      if (name == "connectivity") corners_ = raw(document, array, std::nullopt);
      if (name == "offsets") ends_ = raw(document, array, cells_count_);
      if (name == "types") types_ = raw(document, array, cells_count_);
    }
    if (corners_.begin == 0 || ends_.begin == 0 || types_.begin == 0)
      document.fail(piece, "connectivity, offsets or types of its cells are missing");
    fields(document, piece.child("PointData"), Field::On::Vertices, points_count_, filter);
    fields(document, piece.child("CellData"), Field::On::Elements, cells_count_, filter);
    require_own_points(document);
  }

  /// Throws if another array shares the points' data, as the format allows: it would change with the points.
  void require_own_points(const VtuDocument& document) const {
    const std::uint64_t end = points_.at(3 * points_count_);
    for (const VtuDocument::Appended& other : document.appended())
      if (other.begin + size_of(document.header()) > points_.begin && other.begin < end)
        document.fail(other.node, "it shares its data with the points");
  }

  [[nodiscard]] RawArray raw(const VtuDocument& document, pugi::xml_node node, std::optional<std::uint64_t> numbers) const {
    const auto array = node ? document.array(node) : std::nullopt;
    if (!array) document.fail(document.grid(), "an array of its points or cells is missing");
    if (!array->appended || array->base64) document.fail(node, fmt::format("several ranks cannot read this: {}", kHowToSave));
    const std::uint64_t header = size_of(document.header());
    RawArray found{array->begin + header, 0, array->type, document.big_endian(), array->components};
    if (found.begin > array->limit) document.fail(node, "its data lie behind the end of the file");
    const std::string size = file_->read(array->begin, header);
    const auto bytes = static_cast<std::uint64_t>(load_whole(size.data(), document.header(), document.big_endian()));
    if (numbers && bytes != *numbers * size_of(array->type))
      document.fail(node, fmt::format("{} bytes, but its numbers take {}", bytes, *numbers * size_of(array->type)));
    if (bytes > array->limit - found.begin) document.fail(node, "its data end behind the end of the file");
    found.count = bytes / size_of(array->type);
    return found;
  }

  void fields(const VtuDocument& document, pugi::xml_node data, Field::On on, std::uint64_t count, const FieldFilter& filter) {
    for (const pugi::xml_node node : data.children("DataArray")) {
      const std::string name = node.attribute("Name").value();
      if (const auto any = document.array(node); any && on == Field::On::Vertices && !is_whole(any->type)) nodal_fields_.push_back(name);
      if (!filter.wants(name, on)) continue;
      const auto array = document.array(node);
      if (!array || array->components != 1) continue;
      wanted_.push_back({name, on, raw(document, node, count)});
    }
  }

  void points(MeshBlock& block) const {
    const std::uint64_t first = block.vertices.begin(world_.rank()), last = block.vertices.end(world_.rank());
    const std::vector<double> x = points_.read<double>(*file_, 3 * first, 3 * last);
    block.positions.reserve(last - first);
    for (std::uint64_t v = 0; v < last - first; ++v) {
      const Vec3 p{x[3 * v], x[3 * v + 1], x[3 * v + 2]};
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw InputError(path_.string(), 0, fmt::format("a coordinate of point {} is not a finite number", first + v));
      block.positions.push_back(p);
    }
  }

  void cells(MeshBlock& block) const {
    const std::uint64_t first = block.elements.begin(world_.rank()), last = block.elements.end(world_.rank());
    if (first == last) return;
    std::vector<std::int64_t> ends = ends_.read<std::int64_t>(*file_, first == 0 ? 0 : first - 1, last);
    if (first == 0) ends.insert(ends.begin(), 0);
    for (std::size_t c = 1; c < ends.size(); ++c)
      if (ends[c] < ends[c - 1] || ends[0] < 0 || static_cast<std::uint64_t>(ends[c]) > corners_.count)
        throw InputError(path_.string(), 0, fmt::format("the offset of cell {} is {}", first + c - 1, ends[c]));
    const auto types = types_.read<std::int64_t>(*file_, first, last);
    const auto corners =
        corners_.read<std::int64_t>(*file_, static_cast<std::uint64_t>(ends.front()), static_cast<std::uint64_t>(ends.back()));
    block.corners.reserve(corners.size());
    std::array<Index, 8> order{};
    for (std::size_t c = 0; c < types.size(); ++c) {
      const auto begin = static_cast<std::size_t>(ends[c] - ends[0]), count = static_cast<std::size_t>(ends[c + 1] - ends[c]);
      const std::size_t here = std::min(count, order.size());
      for (std::size_t i = 0; i < here; ++i) order[i] = static_cast<Index>(i);
      const VtkElement element = element_of_vtk_cell(types[c], std::span(order).first(here));
      const auto fail = [&](const std::string& what) { throw InputError(path_.string(), 0, fmt::format("cell {}: {}", first + c, what)); };
      if (!element.fault.empty()) fail(element.fault);
      if (count > order.size() || element.kind >= kElementKindCount)
        fail("several ranks read meshes of elements alone: no lines, no points");
      block.kinds.push_back(static_cast<ElementKind>(element.kind));
      for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t corner = corners[begin + order[i]];
        if (corner < 0 || static_cast<std::uint64_t>(corner) >= points_count_)
          fail(fmt::format("it names point {}, but there are {} points (0 to {})", corner, points_count_, points_count_ - 1));
        block.corners.push_back(static_cast<WholeIndex>(corner));
      }
    }
  }

  /// Copies all but the points, which others write: on a shared disk no byte may be written twice.
  void copy(SharedOutput& output) const {
    const std::uint64_t begin = points_.begin, end = points_.at(3 * points_count_);
    const Ranges bytes(file_->size() - (end - begin), world_.size());
    for (std::uint64_t at = bytes.begin(world_.rank()); at < bytes.end(world_.rank());) {
      const std::uint64_t stop = std::min(bytes.end(world_.rank()), at < begin ? begin : bytes.end(world_.rank()));
      const std::uint64_t count = std::min<std::uint64_t>(kCopyBytes, stop - at), offset = at < begin ? at : at + (end - begin);
      output.write(offset, file_->read(offset, count));
      at += count;
    }
  }

  void write_points(SharedOutput& output, const std::filesystem::path& target, std::span<const Vec3> positions) const {
    const std::size_t size = size_of(points_.type), at_once = kCopyBytes / (3 * size);
    const std::uint64_t first = Ranges(points_count_, world_.size()).begin(world_.rank());
    std::vector<char> bytes;
    for (std::size_t v = 0; v < positions.size(); v += at_once) {
      const std::size_t count = std::min(at_once, positions.size() - v);
      bytes.resize(3 * size * count);
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = positions[v + i];
        std::size_t k = 3 * i;
        for (const double x : {p.x, p.y, p.z}) {
          if (points_.type == ScalarType::Float32 && !std::isfinite(static_cast<float>(x)))
            throw OutputError(target.string(), fmt::format("coordinate {} of vertex {} is too large for a 32-bit float", x, first + v + i));
          store_scalar(bytes.data() + size * k++, points_.type, points_.big_endian, x);
        }
      }
      output.write(points_.at(3 * (first + v)), {bytes.data(), bytes.size()});
    }
  }

  const World& world_;
  std::filesystem::path path_;
  std::optional<RangeFile> file_;
  std::int64_t stamp_ = 0;
  std::uint64_t points_count_ = 0, cells_count_ = 0;
  RawArray points_, corners_, ends_, types_;
  std::vector<Wanted> wanted_;
  std::vector<std::string> nodal_fields_;
};

}  // namespace

std::unique_ptr<SharedMeshFile> open_shared_vtu(const World& world, const std::filesystem::path& path) {
  return std::make_unique<VtuFile>(world, path);
}

}  // namespace dmoscope
