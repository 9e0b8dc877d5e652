#include "core/session/saved_inputs.h"

#include <algorithm>
#include <bit>
#include <map>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/base/fnv1a.h"
#include "core/base/terminal_text.h"
#include "core/mesh/materials.h"
#include "core/reference/slide_on.h"

namespace dmoscope {

namespace {

std::string mark_of(const Field& field) {
  Fnv1a hash;
  hash.add_number(static_cast<std::uint64_t>(field.components));
  for (const double value : field.values) hash.add_number(std::bit_cast<std::uint64_t>(value));
  return hash.text();
}

std::string mark_of(const Group& group) {
  Fnv1a hash;
  hash.add_bytes(group.role);
  hash.add_number(static_cast<std::uint64_t>(group.dimension));
  for (const Index member : group.members) hash.add_number(member);
  for (const Index corner : group.faces.all_corners()) hash.add_number(corner);
  return hash.text();
}

/// Marks by name: several may share one, and a change of one of these must not go unnoticed.
std::multimap<std::string, std::string> by_name(const std::vector<DataMark>& marks) { return {marks.begin(), marks.end()}; }

}  // namespace

std::string standing_mark(const InputMesh& input, const StandingRule& rule) {
  Fnv1a hash;
  const std::vector<std::uint8_t> standing = standing_vertices(input, rule);
  for (Index v = 0; v < standing.size(); ++v)
    if (standing[v] != 0) hash.add_number(v);
  return hash.text();
}

std::string size_mark(const InputMesh& input, const SizeField* size) {
  if (size == nullptr || size->function().kind != SizeFunction::Kind::Field) return {};
  for (const Field& field : input.mesh.fields)
    if (field.on == Field::On::Vertices && field.components == 1 && field.name == size->function().field) return mark_of(field);
  return {};
}

std::vector<DataMark> data_marks(const Mesh& mesh) {
  std::vector<DataMark> marks;
  for (const Group& group : mesh.groups) marks.emplace_back(fmt::format("group \"{}\"", terminal_line(group.name)), mark_of(group));
  for (const Field& field : mesh.fields)
    if (naming_of(field) != Naming::Nothing) marks.emplace_back(fmt::format("field \"{}\"", terminal_line(field.name)), mark_of(field));
  return marks;
}

std::string changed_data(const std::vector<DataMark>& then, const std::vector<DataMark>& now) {
  constexpr std::size_t kMost = 4;
  const auto before = by_name(then), after = by_name(now);
  const auto differ = [](const auto& marks, const auto& others, const std::string& name) {
    std::vector<std::string> a, b;
    for (auto [it, end] = marks.equal_range(name); it != end; ++it) a.push_back(it->second);
    for (auto [it, end] = others.equal_range(name); it != end; ++it) b.push_back(it->second);
    std::ranges::sort(a);
    std::ranges::sort(b);
    return a != b;
  };
  std::vector<std::string> parts;
  const auto add = [&](const std::string& name, const char* what) {
    std::string part = fmt::format("{} {}", name, what);
    if (std::ranges::find(parts, part) == parts.end()) parts.push_back(std::move(part));
  };
  for (const auto& [name, mark] : then) {
    if (!after.contains(name))
      add(name, "is gone");
    else if (differ(before, after, name))
      add(name, "has changed");
  }
  for (const auto& [name, mark] : now)
    if (!before.contains(name)) add(name, "is new");
  const std::size_t more = parts.size() > kMost ? parts.size() - kMost : 0;
  parts.resize(parts.size() - more);
  return fmt::format("{}{}", fmt::join(parts, ", "), more > 0 ? fmt::format(" and {} more", more) : std::string());
}

namespace {

using Json = StateJson;

/// Checksum of positions and elements.
std::string checksum(const Mesh& mesh) {
  Fnv1a hash;
  const auto add = [&](std::uint64_t value) { hash.add_number(value); };
  for (const Vec3& p : mesh.positions)
    for (const double coordinate : {p.x, p.y, p.z}) add(std::bit_cast<std::uint64_t>(coordinate));
  for (const ElementKind kind : mesh.elements.kinds()) add(static_cast<std::uint64_t>(kind));
  for (const Index corner : mesh.elements.all_corners()) add(corner);
  return hash.text();
}

/// The path in the file or, if nothing is there any more, the same name beside the state file.
std::filesystem::path find_mesh(const std::filesystem::path& written, const std::filesystem::path& state) {
  std::error_code ignored;
  if (std::filesystem::exists(written, ignored)) return written;
  const std::filesystem::path beside = state.parent_path() / written.filename();
  return std::filesystem::exists(beside, ignored) ? beside : written;
}

/// The mesh with the cell data that the user let name materials. `given`: whether the mesh was passed in.
std::shared_ptr<const InputMesh> of_materials(const Json& json, std::shared_ptr<const InputMesh> input, bool given) {
  const auto said = json.contains("materials") ? json.at("materials").get<std::vector<std::string>>() : std::vector<std::string>();
  if (said == said_materials(input->mesh)) return input;
  if (given) throw UsageError(fmt::format("other cell data of {} named materials when this was saved (--materials)", input->mesh.name));
  return with_materials(*input, said);
}

std::shared_ptr<const InputMesh> to_input(const Json& json, const std::filesystem::path& state, const IoContext& context,
                                          std::shared_ptr<const InputMesh> input) {
  const bool given = input != nullptr;
  Progress& progress = context.progress;
  std::string source;
  if (input) {
    source = input->mesh.name;
  } else if (json.contains("generate")) {
    source = json.at("generate").get<std::string>();
    input = generate_input(source, progress);
  } else {
    const std::filesystem::path path = find_mesh(json.at("path").get<std::string>(), state);
    source = path.string();
    IoContext as_saved = context;  // older files say nothing: their meshes were taken as they stand
    as_saved.geographic = json.value("geographic", false) ? Geographic::On : Geographic::Off;
    as_saved.thin = json.value("thin", false) ? Thin::On : Thin::Off;
    input = load_input(path, Need::Smoothing, as_saved);
  }
  if (json.contains("single") && json.at("single") != input->mesh.single_precision)
    throw UsageError(fmt::format("{} has changed since the session was saved: it holds {}-bit coordinates now", source,
                                 input->mesh.single_precision ? 32 : 64));
  if (to_whole(json.at("vertices")) != input->mesh.vertex_count() || to_whole(json.at("elements")) != input->mesh.elements.size() ||
      checksum(input->mesh) != json.at("checksum").get<std::string>())
    throw UsageError(fmt::format("{} has changed since the session was saved: its positions or elements are others", source));
  return of_materials(json, std::move(input), given);
}

/// The mesh with the surface that it slides on. `given`: whether the mesh was passed in.
std::shared_ptr<const InputMesh> on_surface(const Json& json, const std::filesystem::path& state, const IoContext& context,
                                            const std::shared_ptr<const InputMesh>& input, bool given) {
  const bool slides = json.contains("surface");
  if (given && slides != (input->surface != nullptr))
    throw UsageError(fmt::format("{} slid on {} when this was saved", input->mesh.name, slides ? "another surface" : "its own surface"));
  if (!slides) return input;
  const auto surface = to_input(json.at("surface"), state, context, given ? input->surface : nullptr);
  return given ? input : slide_on(*input, surface);
}

/// The marks of the mesh's groups and fields in the file; empty for an older file, which has none.
std::vector<DataMark> to_data_marks(const Json& input) {
  std::vector<DataMark> marks;
  if (!input.contains("data")) return marks;
  for (const Json& mark : input.at("data")) marks.emplace_back(mark.at(0).get<std::string>(), mark.at(1).get<std::string>());
  return marks;
}

}  // namespace

std::vector<OpenedMesh> to_meshes(const Json& json, const std::filesystem::path& path, const IoContext& context,
                                  const std::shared_ptr<const InputMesh>& input) {
  const auto to_mesh = [&](const Json& mesh, const std::shared_ptr<const InputMesh>& given) {
    return OpenedMesh{on_surface(mesh, path, context, to_input(mesh, path, context, given), given != nullptr), to_data_marks(mesh)};
  };
  if (!json.contains("inputs")) return {to_mesh(json.at("input"), input)};
  if (input) throw UsageError("this session has several meshes, where one of a single mesh is expected");
  const Json& described = json.at("inputs");
  if (!described.is_array() || described.empty()) throw UsageError("the session has no meshes");
  std::vector<OpenedMesh> meshes;
  for (const Json& mesh : described) {
    meshes.push_back(to_mesh(mesh, nullptr));
    if (meshes.back().input->in_space() != meshes.front().input->in_space())
      throw UsageError("some of its meshes are planar and others in space, which cannot be shown beside each other");
  }
  return meshes;
}

StateJson input_json(const MeshStanding& mesh) {  // a surface has no surface of its own
  const InputMesh& input = *mesh.input;
  Json source{{"vertices", input.mesh.vertex_count()}, {"elements", input.mesh.elements.size()}, {"checksum", checksum(input.mesh)}};
  source["single"] = input.mesh.single_precision;
  if (input.mesh.degrees) source["geographic"] = true;
  if (input.mesh.thin) source["thin"] = true;
  // Saves marks, to be able to name a difference if other vertices are fixed later.
  for (const DataMark& mark : data_marks(input.mesh)) source["data"].push_back({mark.first, mark.second});
  if (!input.generator.empty()) {
    source["generate"] = input.generator;
  } else if (!mesh.source.empty()) {
    source["path"] = mesh.source.string();
  } else {
    throw UsageError("this mesh came from no file and no generator: export it and open it first");
  }
  if (const auto said = said_materials(input.mesh); !said.empty()) source["materials"] = said;
  if (input.surface) source["surface"] = input_json({input.surface, std::filesystem::absolute(input.surface->path)});
  return source;
}

}  // namespace dmoscope
