// XDMF files whose numbers are in an HDF5 file beside them: reading of their points, and writing of both again.

#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "core/base/xml_text.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/atomic_file.h"
#include "core/io/writing/patch_writer.h"
#include "core/io/xdmf/xdmf.h"

namespace dmoscope {
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
  if (!same_positions(mesh.positions, moved.positions) || !moved.fields.empty()) {
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
