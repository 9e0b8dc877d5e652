#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/format_choice.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/gzip.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/patch_writer.h"
#include "core/io/writing/text_writer.h"
#include "core/mesh/collapsed.h"

namespace dmoscope {
namespace {

/// Reads by a handler. For a file of another format the error names that.
Mesh read_by(const FormatHandler& handler, SourceFile& source, const IoContext& context) {
  try {
    return handler.read(source, context);
  } catch (const InputError&) {
    if (is_certain(handler, source.bytes())) throw;
    const std::string foreign = foreign_format(source.bytes(), mesh_extension(source.path()));
    if (foreign.empty()) throw;
    throw InputError(source.path().string(), 0, foreign);
  }
}

/// Objects of one kind that a format cannot hold: one sentence for all of them.
struct DroppedThings {
  std::string kind, of;  // words such as "field", " of the vertices"
  std::vector<std::string> names;

  [[nodiscard]] std::string sentence(std::string_view format_title) const {
    constexpr std::size_t kNamed = 3;
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) list += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
    if (names.size() > kNamed) list += fmt::format(" and {} more", names.size() - kNamed);
    return fmt::format("Dropped: {} {}{}; {} cannot carry {}.", kind, list, of, format_title, names.size() == 1 ? "it" : "them");
  }
};

void add_dropped(std::vector<DroppedThings>& all, std::string_view kind, std::string_view of, const std::string& name) {
  for (DroppedThings& things : all) {
    if (things.kind == kind && things.of == of) return things.names.push_back(name);
  }
  all.push_back({std::string(kind), std::string(of), {name}});
}

/// Whether the source's bytes are all that a mesh of this format needs, except for the coordinates.
bool can_patch(const Mesh& mesh, const FormatHandler& handler) {
  return mesh.source && mesh.source->format() == handler.info.name && mesh.source->not_patchable().empty();
}

/// Number of volume elements that were turned over after reading.
std::size_t turned_volumes(const Mesh& mesh) {
  std::size_t turned = 0;
  for (std::size_t e = 0; e < mesh.flipped.size(); ++e) {
    if (mesh.flipped[e] != 0 && info(mesh.elements.kind(static_cast<Index>(e))).dimension == 3) ++turned;
  }
  return turned;
}

Notes write_anew(AtomicFile& file, const FormatHandler& handler, const Mesh& mesh, std::span<const Vec3> positions,
                 const IoContext& context) {
  if (handler.write == nullptr) throw OutputError(file.path().string(), std::string(handler.not_written));
  Notes notes = handler.write(file, mesh, positions, context);
  if (const std::size_t turned = turned_volumes(mesh); turned > 0) {
    notes.push_back(turned == 1 ? "1 element that was wound inside out was written the right way round."
                                : fmt::format("{} elements that were wound inside out were written the right way round.", turned));
  }
  if (!mesh.source) return notes;
  if (mesh.source->format() == handler.info.name) {
    notes.push_back(fmt::format("The file was made anew: {}.", mesh.source->not_patchable()));
  }
  for (const std::string& thing : mesh.source->only_in_file()) {
    notes.push_back(fmt::format("Dropped: {} of {}.", thing, mesh.source->path().filename().string()));
  }
  return notes;
}

/// Appends a comment, except behind binary data, where none is possible.
void add_comment(AtomicFile& file, const FormatHandler& handler, const Mesh& mesh, std::string comment, Notes& notes) {
  const CommentForm& form = handler.comment;
  const bool binary = can_patch(mesh, handler) && mesh.source->layout().binary && handler.info.name == "off";
  if (binary || form.begin.empty())
    return notes.push_back(fmt::format("Provenance was not written: {} has no comments.", handler.info.title));
  for (char& c : comment)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F || c == '$') c = ' ';
  for (std::size_t at = 0; !form.without.empty() && (at = comment.find(form.without, at)) != std::string::npos; ++at) comment[at + 1] = ' ';
  file.write(fmt::format("{}{}{}", form.begin, comment, form.end));
}

/// Throws unless both files of a format with two exist; the error names the one that was asked for.
void require_both(const std::filesystem::path& path, const FormatHandler* handler) {
  if (handler == nullptr || handler->companion == nullptr) return;
  const std::filesystem::path main = main_path(path, handler);
  const std::filesystem::path second = companion_path(main, *handler->companion);
  std::error_code error;
  for (const std::filesystem::path& other : {main, second}) {
    if (other == path || !std::filesystem::exists(path, error) || std::filesystem::exists(other, error)) continue;
    throw InputError(path.string(), 0, fmt::format("{}, which belongs to it, is not there", other.filename().string()));
  }
}

/// Handler of written_format().
const FormatHandler* written_by(const std::filesystem::path& path, const Mesh& mesh) {
  const FormatHandler* named = by_extension(mesh_extension(path));
  if (named == nullptr || !mesh.source || !equal_ignoring_case(mesh_extension(mesh.source->path()), mesh_extension(path))) return named;
  const auto found = std::ranges::find(format_handlers(), mesh.source->format(), [](const FormatHandler* one) { return one->info.name; });
  return found == format_handlers().end() ? named : *found;
}

/// Throws if a file that the mesh was read from would be replaced, unless the mesh is written to its own path.
void require_not_read(const std::filesystem::path& path, const Mesh& mesh) {
  if (!mesh.source || same_mesh(path, mesh.source->path())) return;
  if (const std::filesystem::path file = replaced_file(path, mesh.source->path()); !file.empty())
    throw OutputError(path.string(),
                      fmt::format("the mesh was read from {}, which would be replaced: name the output otherwise", file.string()));
}

void require_finite(const std::filesystem::path& path, std::span<const Vec3> positions) {
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3 p = positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw OutputError(path.string(), fmt::format("vertex {} has a coordinate that is not finite", v));
    }
  }
}

}  // namespace

void require_known_format(const std::filesystem::path& path, const IoContext& context) {
  if (by_extension(mesh_extension(path)) != nullptr) return;
  std::size_t size = 0;
  const FileBytes bytes = read_unpacked(path, context, size);
  (void)format_of(path, bytes.view());
}

namespace {

Mesh read_whole_mesh(const std::filesystem::path& path, const IoContext& context) {
  Progress& progress = context.progress;
  progress.begin("reading " + path.filename().string());
  if (const std::string folder = foreign_folder(path); !folder.empty()) throw InputError(path.string(), 0, folder);
  const FormatHandler* named = by_extension(mesh_extension(path));
  const std::filesystem::path main = main_path(path, named);
  if (main != path) require_both(path, named);
  std::size_t size = 0;
  FileBytes unpacked = read_unpacked(main, context, size);
  auto source = std::make_shared<SourceFile>(main, std::move(unpacked));
  source->set_size_on_disk(size);
  if (source->bytes().empty()) {
    const std::string foreign = foreign_format({}, mesh_extension(main));
    throw InputError(main.string(), 0, foreign.empty() ? "the file is empty" : foreign);
  }
  const FormatHandler& handler = format_of(main, source->bytes());
  source->set_format(handler.info.name);
  if (handler.companion != nullptr) {
    if (equal_ignoring_case(main.extension().string(), kPacked))
      throw InputError(path.string(), 0, "files in pairs are read unpacked alone");
    require_both(path, &handler);
    const std::filesystem::path second = companion_path(main, *handler.companion);
    source->set_companion(std::make_shared<SourceFile>(second, read_whole_file(second, progress)));
  }
  Mesh mesh = read_by(handler, *source, context);
  const CollapsedKinds collapsed = take_simpler_kinds(mesh);
  for (std::string& sentence : collapsed.sentences()) source->add_note(std::move(sentence));
  for (const std::string& corners : collapsed.repeated()) source->add_only_in_file(corners);
  if (mesh.positions.empty()) throw InputError(path.string(), 0, "the file holds no vertices");
  if (mesh.elements.size() == 0) throw InputError(path.string(), 0, "the file holds no elements");
  mesh.name = path.filename().string();
  const CoordinateLayout& layout = source->layout();
  mesh.single_precision = std::ranges::find(layout.scalar, CoordinateScalar::Float32) != layout.scalar.end();
  mesh.source = std::move(source);
  progress.set(1.0);
  return mesh;
}

}  // namespace

const FormatInfo* written_format(const std::filesystem::path& path, const Mesh& mesh) {
  const FormatHandler* handler = written_by(path, mesh);
  return handler == nullptr ? nullptr : &handler->info;
}

Mesh read_mesh(const std::filesystem::path& path, const IoContext& context) {
  try {
    return read_whole_mesh(path, context);
  } catch (const std::bad_alloc&) {
    throw InputError(path.string(), 0, "not enough memory for this mesh");
  }
}

bool writes_source_again(const std::filesystem::path& path, const Mesh& mesh) {
  const FormatHandler* handler = written_by(path, mesh);
  return handler != nullptr && can_patch(mesh, *handler);
}

std::vector<std::string> write_mesh(const std::filesystem::path& path, const Mesh& mesh, const MovedMesh& moved, const IoContext& context) {
  return write_commented_mesh(path, mesh, moved, context, {});
}

std::vector<std::string> write_commented_mesh(const std::filesystem::path& path, const Mesh& mesh, const MovedMesh& moved,
                                              const IoContext& context, std::string_view comment) {
  if (mesh.degrees) {
    Mesh in_degrees = mesh;
    in_degrees.positions = *mesh.degrees;
    in_degrees.degrees = nullptr;
    return write_commented_mesh(path, in_degrees, {places_in_file(mesh, moved.positions), moved.fields}, context, comment);
  }
  if (mesh.thin) return write_commented_mesh(path, with_cells(mesh), moved, context, comment);
  Progress& progress = context.progress;
  progress.begin("writing " + path.filename().string());
  const std::string extension = mesh_extension(path);
  const FormatHandler* handler = written_by(path, mesh);
  if (handler == nullptr) {
    throw UsageError(fmt::format("{}: unknown extension {}; known are {}", path.string(), quote_token(extension), known_formats()));
  }
  const bool packed = path.extension().string() != extension;
  if (packed && handler->companion != nullptr) throw OutputError(path.string(), "files in pairs are written unpacked alone");
  const std::span<const Vec3> positions = moved.positions;
  if (positions.size() != mesh.positions.size()) {
    throw UsageError(fmt::format("{}: {} positions for {} vertices", path.string(), positions.size(), mesh.positions.size()));
  }
  require_finite(path, positions);
  require_not_read(path, mesh);
  const FormerMesh former(path);
  const std::filesystem::path main = main_path(path, handler);
  AtomicFile file(main);
  if (packed) file.pack();
  std::optional<AtomicFile> second;
  if (handler->companion != nullptr) {
    second.emplace(companion_path(main, *handler->companion));
    former.require_own(main);
    former.require_own(second->path());
  }
  Notes notes;
  if (can_patch(mesh, *handler)) {
    notes = (handler->patch != nullptr ? handler->patch : write_patched)(file, mesh, moved, context);
    if (const std::string& beside = mesh.source->beside(); !beside.empty())
      notes.push_back(
          std::ranges::any_of(moved.fields, [&](const FieldValues& one) { return one.field >= mesh.source->first_beside(); })
              ? fmt::format("The fields of {}, taken anew at the new places, were not written: a .vtu or .vtk holds them.", beside)
              : fmt::format("The fields of {} were not written: copy it, under the new name, beside the new mesh.", beside));
    if (second) second->write(mesh.source->companion()->bytes());
  } else {
    notes = moved.fields.empty() ? write_anew(file, *handler, mesh, positions, context)
                                 : write_anew(file, *handler, with_fields(mesh, moved.fields), positions, context);
    if (second) handler->companion->write(*second, mesh, context);
  }
  if (!has_extension(*handler, extension))
    notes.push_back(fmt::format("Written as {}, which {} is.", handler->info.title, mesh.source->path().filename().string()));
  if (!comment.empty()) add_comment(file, *handler, mesh, std::string(comment), notes);
  progress.check();
  // Renames last, since two renames cannot be made atomic: everything that can fail is done by now.
  if (second) second->finish();
  file.finish();
  for (const AtomicFile* one : {&file, second ? &*second : nullptr})
    if (one != nullptr && !one->note().empty()) notes.push_back(fmt::format("{}: {}", one->path().filename().string(), one->note()));
  if (second) second->commit();
  file.commit();
  former.settle(notes);
  progress.set(1.0);
  return notes;
}

void add_element(Mesh& mesh, ElementKind kind, std::span<const Index> corners, const SourceFile& source) {
  if (mesh.elements.all_corners().size() + corners.size() >= kNoIndex) {
    throw InputError(source.path().string(), 0, fmt::format("too large: the elements have {} corners or more", kNoIndex));
  }
  mesh.elements.add(kind, corners);
}

FileCorners file_corners(const Mesh& mesh, std::size_t element) {
  const auto e = static_cast<Index>(element);
  FileCorners corners{{}, mesh.elements.corners(e).size()};
  std::ranges::copy(mesh.elements.corners(e), corners.at.begin());
  const ElementKind kind = mesh.elements.kind(e);
  if (!mesh.flipped.empty() && mesh.flipped[e] != 0 && info(kind).dimension < 3) flip_corners(kind, corners.at.data());
  return corners;
}

void put_corners(TextBuffer& out, const FileCorners& corners, Index base) {
  for (const Index c : corners) out << ' ' << c + base;
}

void require_surface_elements(const AtomicFile& file, const Mesh& mesh, std::string_view format_title) {
  for (const ElementKind kind : mesh.elements.kinds()) {
    if (info(kind).dimension == 3) {
      throw OutputError(file.path().string(),
                        fmt::format("{} holds only triangles and quadrilaterals, and the mesh has {}", format_title, info(kind).plural));
    }
  }
}

void require_constant_z(const AtomicFile& file, std::span<const Vec3> positions, std::string_view format_title, Notes& notes) {
  if (positions.empty()) return;
  const double z = positions.front().z;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (positions[v].z != z) {
      throw OutputError(file.path().string(), fmt::format("{} holds only x and y, but vertex {} has z = {} and vertex 0 z = {}",
                                                          format_title, v, positions[v].z, z));
    }
  }
  if (z != 0.0) notes.push_back(fmt::format("Dropped: z = {} of every vertex; {} holds only x and y.", z, format_title));
}

void note_dropped(const Mesh& mesh, std::span<const std::size_t> kept_fields, std::span<const std::size_t> kept_groups,
                  std::string_view format_title, Notes& notes) {
  const auto has = [](std::span<const std::size_t> list, std::size_t i) { return std::find(list.begin(), list.end(), i) != list.end(); };
  std::vector<DroppedThings> dropped;
  for (std::size_t i = 0; i < mesh.fields.size(); ++i) {
    if (has(kept_fields, i)) continue;
    const Field& field = mesh.fields[i];
    add_dropped(dropped, "field", field.on == Field::On::Vertices ? " of the vertices" : " of the elements", field.name);
  }
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    if (has(kept_groups, i)) continue;
    const Group& group = mesh.groups[i];
    add_dropped(dropped, group.role.empty() ? "group" : group.role, "", group.name);
  }
  for (const DroppedThings& things : dropped) notes.push_back(things.sentence(format_title));
}

}  // namespace dmoscope
