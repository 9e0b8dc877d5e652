#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/base/xml_text.h"
#include "core/io/mesh_writer.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/vtk/vtk_cells.h"
#include "core/io/vtu/vtu.h"
#include "core/io/vtu/vtu_document.h"
#include "core/io/writing/patch_writer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {

namespace {

constexpr bool kBigEndian = std::endian::native == std::endian::big;
constexpr std::size_t kBlockBytes = std::size_t{1} << 18;  // bytes in a compressed block

/// Word of VTU for a type of number.
std::string_view vtu_word(ScalarType type) {
  constexpr static std::array<std::string_view, 10> words{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                          "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  return words[static_cast<std::size_t>(type)];
}

/// The field's own type if that holds all its values; else double.
ScalarType type_of(const Field& field) {
  ScalarType type = ScalarType::Float64;
  if (field.type == "bit") type = ScalarType::UInt8;
  if (field.type != "bit" && !scalar_of_word(field.type, type)) return ScalarType::Float64;
  const bool fits = std::all_of(field.values.begin(), field.values.end(), [type](double v) { return holds_exactly(type, v); });
  return fits ? type : ScalarType::Float64;
}

class VtuWriter : MeshWriter {
 public:
  /// Begins a file. `poly`: as PolyData.
  VtuWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context, bool poly)
      : MeshWriter(file, mesh, positions, context, poly ? "VTP" : "VTU"), poly_(poly), file_(file), context_(context) {
    if (poly) require_surface_elements(file, mesh, title_);
  }

  Notes write() {
    const std::string_view dataset = poly_ ? "PolyData" : "UnstructuredGrid";
    xml_ = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"1.0\" byte_order=\"{1}\" header_type=\"UInt64\" "
        "compressor=\"vtkZLibDataCompressor\">\n  <{0}>\n    <Piece NumberOfPoints=\"{2}\" {3}=\"{4}\">\n",
        dataset, kBigEndian ? "BigEndian" : "LittleEndian", positions_.size(),
        poly_ ? "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys" : "NumberOfCells", mesh_.elements.size());
    data(Field::On::Vertices, "PointData");
    data(Field::On::Elements, "CellData");
    points();
    cells();
    xml_ += fmt::format("    </Piece>\n  </{}>\n  <AppendedData encoding=\"raw\">\n   _", dataset);
    out_ << xml_;
    for (const std::string& one : appended_) out_.bytes(one);
    out_ << "\n  </AppendedData>\n</VTKFile>\n";
    return finish();
  }

 private:
  /// Adds an array; `bytes` are in the machine's byte order.
  void array(std::string_view name, ScalarType type, std::size_t components, const std::vector<char>& bytes) {
    context_.progress.check();
    xml_ += fmt::format("        <DataArray type=\"{}\" Name=\"{}\"", vtu_word(type), xml_escaped(name));
    if (components != 1) xml_ += fmt::format(" NumberOfComponents=\"{}\"", components);
    xml_ += fmt::format(" format=\"appended\" offset=\"{}\"/>\n", offset_);
    appended_.push_back(vtu_encoded(file_.path().string(), {bytes.data(), bytes.size()}, encoding_, context_.pool));
    offset_ += appended_.back().size();
  }

  /// The bytes of `count` numbers: of(i) gives the i-th.
  template <class Of>
  static std::vector<char> bytes_of(ScalarType type, std::size_t count, Of of) {
    const std::size_t size = size_of(type);
    std::vector<char> bytes(count * size);
    for (std::size_t i = 0; i < count; ++i) store_scalar(bytes.data() + i * size, type, kBigEndian, of(i));
    return bytes;
  }

  void points() {
    xml_ += "      <Points>\n";
    const auto coordinate = [this](std::size_t i) {
      const Vec3 p = positions_[i / 3];
      return i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : p.z;
    };
    array("Points", ScalarType::Float64, 3, bytes_of(ScalarType::Float64, 3 * positions_.size(), coordinate));
    xml_ += "      </Points>\n";
  }

  void cells() {
    const Index n = mesh_.elements.size();
    std::vector<Index> corners;
    corners.reserve(mesh_.elements.all_corners().size());
    for (Index e = 0; e < n; ++e) {
      const FileCorners own = vtk_corners(mesh_, e);
      corners.insert(corners.end(), own.begin(), own.end());
    }
    const auto offsets = mesh_.elements.offsets();
    const std::string_view list = poly_ ? "Polys" : "Cells";
    xml_ += fmt::format("      <{}>\n", list);
    array("connectivity", ScalarType::Int64, 1,
          bytes_of(ScalarType::Int64, corners.size(), [&](std::size_t i) { return static_cast<double>(corners[i]); }));
    array("offsets", ScalarType::Int64, 1,
          bytes_of(ScalarType::Int64, n, [&](std::size_t e) { return static_cast<double>(offsets[e + 1]); }));
    const auto type = [&](std::size_t e) { return static_cast<double>(vtk_cell_type(mesh_.elements.kind(static_cast<Index>(e)))); };
    if (!poly_) array("types", ScalarType::UInt8, 1, bytes_of(ScalarType::UInt8, n, type));
    xml_ += fmt::format("      </{}>\n", list);
  }

  void data(Field::On on, std::string_view element) {
    xml_ += fmt::format("      <{}", element);
    for (const VtuRole& role : kVtuRoles) {
      const auto active = std::find_if(mesh_.fields.begin(), mesh_.fields.end(),
                                       [&](const Field& field) { return is_of(field, on) && equal_ignoring_case(field.role, role.role); });
      if (active != mesh_.fields.end()) xml_ += fmt::format(" {}=\"{}\"", role.attribute, xml_escaped(active->name));
    }
    xml_ += ">\n";
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) {
      const Field& field = mesh_.fields[i];
      if (!is_of(field, on)) continue;
      kept_fields_.push_back(i);
      const ScalarType type = type_of(field);
      array(field.name, type, static_cast<std::size_t>(field.components),
            bytes_of(type, field.values.size(), [&](std::size_t k) { return field.values[k]; }));
    }
    xml_ += fmt::format("      </{}>\n", element);
  }

  bool poly_;
  AtomicFile& file_;
  const IoContext& context_;
  const VtuEncoding encoding_{kBigEndian, ScalarType::UInt64, true, false, kBlockBytes};
  std::string xml_;
  std::vector<std::string> appended_;  // arrays as they will be behind the underscore
  std::size_t offset_ = 0;
};

}  // namespace

std::string_view vtu_type_word(const Field& field) { return vtu_word(type_of(field)); }

Notes write_vtu(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return VtuWriter(file, mesh, positions, context, false).write();
}

Notes write_vtp(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return VtuWriter(file, mesh, positions, context, true).write();
}

namespace {

/// The numbers of an array before and after, row by row.
struct ArrayChange {
  std::span<const double> before, after;
  bool of_points = false;
};

/// Writes arrays again whose numbers changed: points, and fields of points. Moves the offsets of arrays behind them in appended data.
class VtuPatcher {
 public:
  VtuPatcher(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context)
      : file_(file),
        mesh_(mesh),
        moved_(moved),
        context_(context),
        document_(*mesh.source, context.progress),
        appended_(document_.appended()),
        budget_(mesh.source->size_on_disk(), context.most_memory) {}

  Notes write() {
    std::size_t first = 0;
    for (const pugi::xml_node piece : document_.grid().children("Piece")) {
      const std::size_t count = document_.count(piece, "NumberOfPoints", mesh_.positions.size() - first);
      if (count > 0) {
        points(piece.child("Points").child("DataArray"), first, count);
        fields(piece.child("PointData"), first, count);
      }
      first += count;
    }
    move_offsets();
    apply();
    if (rounded_ > 0)
      notes_.push_back(fmt::format("{} moved coordinates were rounded to 32-bit floats, which is what the file holds.", rounded_));
    return std::move(notes_);
  }

 private:
  /// A range of the source, and the bytes that replace it.
  struct Replacement {
    std::size_t begin, end;
    std::string bytes;
    bool appended;
  };

  void points(pugi::xml_node node, std::size_t first, std::size_t count) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    const auto numbers = [&](std::span<const Vec3> all) { return std::span<const double>(&all[first].x, 3 * count); };
    replace(*document_.array(node), {numbers(mesh_.positions), numbers(moved_.positions), true});
  }

  /// Replaces the fields of points. As in the reader, an array belongs to the first field of its name that was not met in this piece.
  void fields(pugi::xml_node data, std::size_t first, std::size_t count) {
    std::vector<std::uint8_t> met(mesh_.fields.size(), 0);
    for (const pugi::xml_node node : data.children("DataArray")) {
      const auto array = document_.array(node);
      if (!array) continue;
      std::size_t f = 0;
      const auto is_its = [&](const Field& field) { return field.on == Field::On::Vertices && field.name == array->name; };
      while (f < met.size() && (met[f] != 0 || !is_its(mesh_.fields[f]))) ++f;
      if (f == met.size()) continue;
      met[f] = 1;
      const auto changed = std::ranges::find(moved_.fields, f, &FieldValues::field);
      if (changed == moved_.fields.end()) continue;
      const std::size_t n = array->components;
      const auto numbers = [&](const std::vector<double>& all) { return std::span<const double>(all).subspan(first * n, count * n); };
      replace(*array, {numbers(mesh_.fields[f].values), numbers(changed->values), false});
    }
  }

  void replace(const VtuArray& array, const ArrayChange& change) {
    if (same_numbers(change.before, change.after)) return;
    const bool shared =
        array.appended && std::ranges::count(appended_, array.begin, &VtuDocument::Appended::begin) > 1;  // set by find_shared_data()
    if (shared && !change.of_points)
      return notes_.push_back(fmt::format("Field \"{}\" was carried: other data share its bytes.", array.name));
    if (array.ascii) return replace_text(array, change);
    const std::size_t size = size_of(array.type);
    const VtuData before = vtu_data(document_, array, change.after.size() * size);
    std::string bytes(before.bytes);
    for (std::size_t i = 0; i < change.after.size(); ++i) {
      if (same_bits(change.before[i], change.after[i])) continue;
      if (change.of_points) require_float(array.type, change.after[i], i / 3);
      store_scalar(bytes.data() + i * size, array.type, document_.big_endian(), change.after[i]);
    }
    const VtuEncoding encoding{document_.big_endian(), document_.header(), document_.compressed(), array.base64, before.block};
    const std::size_t blanks = array.appended ? 0 : document_.bytes().find_first_not_of(" \t\r\n", array.begin) - array.begin;
    replacements_.push_back(
        {array.begin + blanks, before.end, vtu_encoded(file_.path().string(), bytes, encoding, context_.pool), array.appended});
  }

  void replace_text(const VtuArray& array, const ArrayChange& change) {
    std::size_t end = array.begin;
    std::vector<std::uint64_t> places;
    (void)vtu_numbers(document_, array, change.after.size(), end, budget_, &places);
    Progress unwatched;
    Tokenizer words(document_.bytes().substr(0, array.limit), document_.file(), vtu_text_syntax(), unwatched);
    TextBuffer text;
    std::size_t copied = array.begin;
    for (std::size_t i = 0; i < change.after.size(); ++i) {
      if (same_bits(change.before[i], change.after[i])) continue;
      text << document_.bytes().substr(copied, places[i] - copied);
      put_number(text, change.after[i], change.of_points ? ScalarType::Float64 : array.type);
      words.seek(places[i]);
      copied = places[i] + words.token().size();
    }
    replacements_.push_back({array.begin, copied, std::string(text.text()), false});
  }

  [[nodiscard]] static bool same_numbers(std::span<const double> a, std::span<const double> b) {
    return std::ranges::equal(a, b, [](double x, double y) { return same_bits(x, y); });
  }

  void require_float(ScalarType type, double value, std::size_t vertex) {
    if (type != ScalarType::Float32) return;
    if (!std::isfinite(static_cast<float>(value)))
      throw OutputError(file_.path().string(), fmt::format("coordinate {} of vertex {} is too large for a 32-bit float", value, vertex));
    if (static_cast<double>(static_cast<float>(value)) != value) ++rounded_;
  }

  /// Moves the offsets of appended arrays by the changes in size of those before them.
  void move_offsets() {
    const auto by_begin = [](const Replacement& a, const Replacement& b) { return a.begin < b.begin; };
    std::sort(replacements_.begin(), replacements_.end(), by_begin);
    std::vector<std::size_t> ends;    // ends of replaced appended data, ascending
    std::vector<std::size_t> growth;  // growth up to each end; below zero it wraps around, and back when it is added
    for (const Replacement& one : replacements_) {
      if (!one.appended) continue;
      ends.push_back(one.end);
      growth.push_back((growth.empty() ? 0 : growth.back()) + one.bytes.size() - (one.end - one.begin));
    }
    for (const auto& array : appended_) {
      const auto before = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), array.begin) - ends.begin());
      if (before == 0 || growth[before - 1] == 0) continue;
      const auto [begin, size] = document_.attribute_place(array.node, "offset");
      replacements_.push_back({begin, begin + size, std::to_string(array.offset + growth[before - 1]), false});
    }
    std::sort(replacements_.begin(), replacements_.end(), by_begin);
  }

  void apply() {
    TextWriter out(file_, context_);
    std::size_t copied = 0;
    for (const Replacement& one : replacements_) {
      out.bytes(document_.bytes().substr(copied, one.begin - copied));
      out.bytes(one.bytes);
      copied = one.end;
    }
    out.bytes(document_.bytes().substr(copied));
  }

  AtomicFile& file_;
  const Mesh& mesh_;
  const MovedMesh& moved_;
  const IoContext& context_;
  VtuDocument document_;
  std::vector<VtuDocument::Appended> appended_;
  UnpackBudget budget_;
  Notes notes_;
  std::vector<Replacement> replacements_;
  std::size_t rounded_ = 0;
};

}  // namespace

Notes patch_vtu(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  if (mesh.source->place_count() == moved.positions.size() && moved.fields.empty()) return write_patched(file, mesh, moved, context);
  return VtuPatcher(file, mesh, moved, context).write();
}

}  // namespace dmoscope
