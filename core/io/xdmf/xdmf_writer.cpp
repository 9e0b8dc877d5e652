#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/same_bits.h"
#include "core/base/xml_text.h"
#include "core/io/mesh_writer.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/atomic_file.h"
#include "core/io/writing/patch_writer.h"
#include "core/io/writing/text_writer.h"
#include "core/io/xdmf/xdmf.h"

namespace dmoscope {

namespace {

class XdmfWriter : MeshWriter {
 public:
  XdmfWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : MeshWriter(file, mesh, positions, context, kXdmfFormat.info.title) {}

  Notes write() {
    const std::string title = mesh_.title.empty() ? "Grid" : mesh_.title;
    out_ << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n<Grid Name=\"" << xml_escaped(title)
         << "\" GridType=\"Uniform\">\n";
    out_ << "<Geometry GeometryType=\"XYZ\">\n<DataItem Dimensions=\"" << positions_.size()
         << " 3\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">\n";
    out_.for_each(positions_.size(), [&](TextBuffer& part, std::size_t v) {
      part << positions_[v].x << ' ' << positions_[v].y << ' ' << positions_[v].z << '\n';
    });
    out_ << "</DataItem>\n</Geometry>\n";
    topology();
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) attribute(i);
    for (std::size_t i = 0; i < mesh_.groups.size(); ++i) set(i);
    out_ << "</Grid>\n</Domain>\n</Xdmf>\n";
    return finish();
  }

 private:
  void topology() {
    const auto kinds = mesh_.elements.kinds();
    const bool mixed = std::any_of(kinds.begin(), kinds.end(), [&](ElementKind kind) { return kind != kinds.front(); });
    const std::size_t corners = mesh_.elements.all_corners().size();
    out_ << "<Topology TopologyType=\"" << (mixed ? "Mixed" : kXdmfNames[static_cast<std::size_t>(shape_of(kinds.front()))])
         << "\" NumberOfElements=\"" << kinds.size() << "\">\n<DataItem Dimensions=\"";
    if (mixed) {
      out_ << corners + kinds.size();
    } else {
      out_ << kinds.size() << ' ' << corners / kinds.size();
    }
    out_ << "\" NumberType=\"Int\" Precision=\"8\" Format=\"XML\">\n";
    out_.for_each(kinds.size(), [&](TextBuffer& part, std::size_t i) {
      if (mixed) part << kXdmfTypes[static_cast<std::size_t>(shape_of(kinds[i]))] << ' ';
      const FileCorners of_element = file_corners(mesh_, i);
      for (std::size_t k = 0; k < of_element.size(); ++k) part << of_element[k] << (k + 1 == of_element.size() ? '\n' : ' ');
    });
    out_ << "</DataItem>\n</Topology>\n";
  }

  void attribute(std::size_t i) {
    const Field& field = mesh_.fields[i];
    const bool of_points = field.on == Field::On::Vertices;
    const std::size_t things = of_points ? positions_.size() : mesh_.elements.size();
    const auto n = static_cast<std::size_t>(field.components);
    if (!is_of(field, field.on)) return;
    kept_fields_.push_back(i);
    const std::string_view type = n == 1 ? "Scalar" : n == 3 ? "Vector" : n == 6 ? "Tensor6" : n == 9 ? "Tensor" : "Matrix";
    out_ << "<Attribute Name=\"" << xml_escaped(field.name) << "\" AttributeType=\"" << type << "\" Center=\""
         << (of_points ? "Node" : "Cell") << "\">\n<DataItem Dimensions=\"" << things;
    if (n > 1) out_ << ' ' << n;
    out_ << "\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">\n";
    out_.for_each(things, [&](TextBuffer& part, std::size_t thing) {
      for (std::size_t k = 0; k < n; ++k) part << field.values[thing * n + k] << (k + 1 == n ? '\n' : ' ');
    });
    out_ << "</DataItem>\n</Attribute>\n";
  }

  void set(std::size_t i) {
    const Group& group = mesh_.groups[i];
    if ((group.dimension != 0 && !group.of_elements()) || group.members.empty()) return;
    kept_groups_.push_back(i);
    out_ << "<Set Name=\"" << xml_escaped(group.name) << "\" SetType=\"" << (group.dimension == 0 ? "Node" : "Cell")
         << "\">\n<DataItem Dimensions=\"" << group.members.size() << "\" NumberType=\"Int\" Precision=\"8\" Format=\"XML\">\n";
    out_.for_each(group.members.size(), [&](TextBuffer& part, std::size_t k) { part << group.members[k] << '\n'; });
    out_ << "</DataItem>\n</Set>\n";
  }
};

}  // namespace

Notes write_xdmf(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  return write_with<XdmfWriter>(file, mesh, positions, context);
}

// XDMF files whose numbers are in an HDF5 file beside them: reading of their points, and writing of both again.

std::string numbers_beside(const std::filesystem::path& xml) {
  std::filesystem::path name = xml.filename();
  if (equal_ignoring_case(name.extension().string(), ".gz")) name = name.stem();
  return name.replace_extension(".h5").string();
}

CoordinateArrays read_xdmf_points(const XdmfDocument& document, pugi::xml_node item, bool plane, std::vector<Vec3>& positions) {
  const auto place = document.elsewhere(item);
  ArrayFile& file = document.arrays(place->file);
  const std::uint64_t each = plane ? 2 : 3;
  const auto info = file.find(place->array);
  if (!info) document.fail(item, fmt::format("{} has no array {}", place->file, quote_token(place->array)));
  if (info->text || info->count() % each != 0 || info->count() / each >= kNoIndex) {
    document.fail(item, fmt::format("{} numbers are no points of {} coordinates", info->count(), each));
  }
  document.require_expected(item, info->count());
  const auto count = static_cast<Index>(info->count() / each);
  file.take_room(count, sizeof(Vec3));
  positions.assign(count, Vec3{0.0, 0.0, 0.0});
  CoordinateArrays coordinates;
  coordinates.read(file, {.name = place->array, .components = static_cast<int>(each), .count = count}, positions);
  return coordinates;
}

Notes patch_xdmf(AtomicFile& file, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  const SourceFile* numbers = mesh.source->companion();
  if (numbers == nullptr) return write_patched(file, mesh, moved, context);
  const XdmfDocument document(*mesh.source, context);
  const pugi::xml_node geometry = document.grid().child("Geometry");
  const pugi::xml_node item = document.item(geometry);
  const auto all = document.all_elsewhere();
  const bool same = same_file(file.path(), mesh.source->path());
  const std::string name = same ? all.front().file : numbers_beside(file.path());
  const std::filesystem::path target = file.path().parent_path() / std::filesystem::path(name);

  FormerMesh(file.path()).require_own(target);
  Notes notes;
  std::string bytes(numbers->bytes());
  if (!same_bits(mesh.positions, moved.positions) || !moved.fields.empty()) {
    const std::unique_ptr<ArrayFile> arrays = open_hdf5(*numbers, context);
    const bool plane = mesh.source->layout().components == 2;
    CoordinateArrays coordinates;
    std::vector<Vec3> before(mesh.positions.size());
    coordinates.read(*arrays, {.name = document.elsewhere(item)->array, .components = plane ? 2 : 3, .count = mesh.vertex_count()}, before);
    bytes = coordinates.replaced(*arrays, mesh.positions, moved.positions, file.path().string(), notes,
                                 changed_arrays(*arrays, mesh, moved.fields, notes));
  }
  std::string xml(mesh.source->bytes());
  for (auto place = all.rbegin(); place != all.rend(); ++place) xml.replace(place->begin, place->end - place->begin, xml_escaped(name));
  // Writes the numbers first: the former XML fits them, too.
  write_file_atomically(target, bytes);
  file.write(xml);
  notes.push_back(fmt::format("Its numbers are in {}, which was written, too.", target.filename().string()));
  return notes;
}

}  // namespace dmoscope
