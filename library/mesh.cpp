#include "library/include/dmoscope/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/same_bits.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/binary.h"
#include "core/io/vtk/vtk_cells.h"
#include "core/mesh/geographic.h"
#include "core/mesh/group_facts.h"
#include "core/mesh/outline.h"
#include "core/mesh/thin.h"
#include "core/mesh/vertex_words.h"
#include "library/mesh_data.h"

namespace dmo {

using dmoscope::ElementKind;
using dmoscope::Field;
using dmoscope::InputMesh;
using dmoscope::Need;
using dmoscope::Vec3;

static_assert(sizeof(Vec3) == 3 * sizeof(double), "positions are vertices x 3");
static_assert(static_cast<int>(CellKind::Triangle) == static_cast<int>(ElementKind::Triangle) &&
              static_cast<int>(CellKind::Pyramid) == static_cast<int>(ElementKind::Pyramid));

namespace {

[[noreturn]] void refuse(const std::string& what) { throw dmoscope::InputError(kNoFile, 0, what); }
[[noreturn]] void refuse_thin(const std::string& why) { refuse(fmt::format("it cannot be taken for a mesh one cell thick: {}", why)); }

/// Returns why the mesh cannot be replaced by that of its front; empty if it can.
std::string why_not_thin(const dmoscope::Mesh& mesh, dmoscope::Progress& progress) {
  dmoscope::Mesh copy;
  copy.positions = mesh.positions;
  copy.elements = mesh.elements;
  return take_front(copy, progress);
}

std::vector<Vec3> vectors(const double* positions, std::size_t vertices) {
  if (positions == nullptr && vertices > 0) refuse(fmt::format("positions is null, but there are {} vertices", vertices));
  std::vector<Vec3> result(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const double* p = positions + 3 * v;
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      refuse(fmt::format("vertex {} is at ({}, {}, {}), which is not finite", v, p[0], p[1], p[2]));
    result[v] = {p[0], p[1], p[2]};
  }
  return result;
}

/// Checks the offsets before corners are read: these must lie within connectivity.
void require_rising_offsets(const Cells& cells) {
  if (cells.count == 0) return;
  for (const auto& [array, name] :
       {std::pair<const void*, const char*>(cells.kinds, "kinds"), {cells.offsets, "offsets"}, {cells.connectivity, "connectivity"}})
    if (array == nullptr) refuse(fmt::format("{} is null, but there are {} cells", name, cells.count));
  if (cells.offsets[0] != 0) refuse(fmt::format("the first offset is {}, not 0", cells.offsets[0]));
  for (std::size_t c = 0; c < cells.count; ++c)
    if (cells.offsets[c + 1] < cells.offsets[c])
      refuse(fmt::format("cell {}: its offsets {} and {} do not rise", c, cells.offsets[c], cells.offsets[c + 1]));
}

void add_data(dmoscope::Mesh& mesh, const Numbers& data, Field::On on) {
  const std::size_t things = on == Field::On::Elements ? mesh.elements.size() : mesh.positions.size();
  if (data.components < 1 || data.components > 0xffff || data.values.size() != things * data.components)
    refuse(fmt::format("the data \"{}\" has {} values of {} components, the mesh {} {}", data.name, data.values.size(), data.components,
                       things, on == Field::On::Elements ? "cells" : "vertices"));
  Field field;
  field.name = data.name;
  field.on = on;
  field.components = static_cast<int>(data.components);
  field.values = data.values;
  const auto is_whole = [](double value) { return value == std::floor(value) && std::abs(value) < 0x1p53; };
  const auto is_short = [](double value) { return std::abs(value) < 0x1p31; };
  if (data.whole && std::ranges::all_of(field.values, is_whole)) field.type = std::ranges::all_of(field.values, is_short) ? "int" : "long";
  mesh.fields.push_back(std::move(field));
}

std::vector<Numbers> numbers_of(const dmoscope::Mesh& mesh, Field::On on) {
  std::vector<Numbers> all;
  for (const Field& field : mesh.fields) {
    if (field.on != on) continue;
    dmoscope::ScalarType type = dmoscope::ScalarType::Float64;
    const bool whole = field.type == "bit" || (scalar_of_word(field.type, type) && is_whole(type));
    all.push_back({field.name, field.values, static_cast<std::size_t>(field.components), whole});
  }
  return all;
}

void add_cell(dmoscope::ElementTable& elements, const Cells& cells, std::size_t c, std::size_t vertices) {
  if (static_cast<unsigned>(cells.kinds[c]) >= dmoscope::kElementKindCount)
    refuse(fmt::format("cell {}: there is no kind {}", c, static_cast<unsigned>(cells.kinds[c])));
  const auto kind = static_cast<ElementKind>(cells.kinds[c]);
  const std::size_t wanted = info(kind).corners;
  if (cells.offsets[c + 1] - cells.offsets[c] != wanted)
    refuse(fmt::format("cell {}: a {} has {} corners, but its offsets are {} and {}", c, info(kind).name, wanted, cells.offsets[c],
                       cells.offsets[c + 1]));
  std::array<Index, 8> corners{};
  for (std::size_t i = 0; i < wanted; ++i) {
    corners[i] = cells.connectivity[cells.offsets[c] + i];
    if (corners[i] >= vertices) refuse(fmt::format("cell {} has the corner {}, but there are {} vertices", c, corners[i], vertices));
    for (std::size_t k = 0; k < i; ++k)
      if (corners[k] == corners[i]) refuse(fmt::format("cell {} has the corner {} twice", c, corners[i]));
  }
  dmoscope::exchange_vtk_order(kind, corners.data());
  elements.add(kind, std::span(corners).first(wanted));
}

}  // namespace

void add_cells(dmoscope::ElementTable& elements, const Cells& cells, std::size_t vertices) {
  require_rising_offsets(cells);
  if (cells.count > 0) elements.reserve(cells.count, cells.offsets[cells.count]);
  for (std::size_t c = 0; c < cells.count; ++c) add_cell(elements, cells, c, vertices);
}

namespace {

std::shared_ptr<const Mesh::Data> data_of(std::shared_ptr<const InputMesh> input) {
  auto data = std::make_shared<Mesh::Data>();
  data->input = std::move(input);
  return data;
}

}  // namespace

std::size_t corner_count(CellKind kind) { return info(static_cast<ElementKind>(kind)).corners; }

std::shared_ptr<const InputMesh> Mesh::Data::prepared(dmoscope::Progress& progress, bool to_be_judged) const {
  const bool mapped = to_be_judged && in_degrees, of_front = to_be_judged && thin;
  if (!moved && !mapped && !of_front) return input;
  dmoscope::Mesh mesh = with_fields(input->mesh, fields);
  if (moved) mesh.positions = *moved;
  if (mapped) map_to_mercator(mesh);
  // The elements' original order of corners, for the new mesh finds anew which are reversed.
  for (std::size_t e = 0; e < mesh.flipped.size(); ++e)
    if (mesh.flipped[e] != 0) mesh.elements.flip(static_cast<Index>(e));
  mesh.flipped.clear();
  if (of_front)
    if (const std::string why = take_front(mesh, progress); !why.empty()) refuse_thin(why);
  return prepare_input(std::move(mesh), input->path, Need::Smoothing, progress);
}

std::shared_ptr<const InputMesh> Mesh::Data::judge() const {
  dmoscope::Progress unwatched;
  return thin ? judged(unwatched) : input;
}

std::vector<Vec3> Mesh::Data::judged_positions() const {
  const auto own = positions();
  std::vector<Vec3> all(own.begin(), own.end());
  if (in_degrees)
    for (Vec3& p : all) p.y = dmoscope::mercator(p.y);
  return all;
}

const Mesh::Data::Arrays& Mesh::Data::arrays() const {
  std::call_once(arrays_made_, [this] {
    const dmoscope::Mesh& mesh = input->mesh;
    const std::size_t count = mesh.elements.size();
    arrays_.kinds.resize(count);
    arrays_.offsets.assign(mesh.elements.offsets().begin(), mesh.elements.offsets().end());
    arrays_.connectivity.assign(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end());
    for (std::size_t e = 0; e < count; ++e) {
      const ElementKind kind = mesh.elements.kind(static_cast<Index>(e));
      arrays_.kinds[e] = static_cast<CellKind>(kind);
      Index* corners = arrays_.connectivity.data() + arrays_.offsets[e];
      if (!mesh.flipped.empty() && mesh.flipped[e] != 0) dmoscope::flip_corners(kind, corners);
      dmoscope::exchange_vtk_order(kind, corners);
    }
  });
  return arrays_;
}

std::vector<dmoscope::FieldValues> Mesh::Data::fields_since(const dmoscope::Mesh& before) const {
  const dmoscope::Mesh now = with_fields(input->mesh, fields);
  std::vector<dmoscope::FieldValues> changed;
  for (std::size_t f = 0; f < std::min(before.fields.size(), now.fields.size()); ++f) {
    const std::vector<double>&then = before.fields[f].values, &values = now.fields[f].values;
    if (!std::ranges::equal(then, values, [](double a, double b) { return dmoscope::same_bits(a, b); })) changed.push_back({f, values});
  }
  return changed;
}

Mesh moved_mesh(const Mesh& mesh, std::vector<Vec3> positions, std::vector<dmoscope::FieldValues> fields) {
  auto data = std::make_shared<Mesh::Data>(*mesh.data());
  data->moved = std::make_shared<const std::vector<Vec3>>(std::move(positions));
  data->fields = std::move(fields);
  return Mesh(std::shared_ptr<const Mesh::Data>(std::move(data)));
}

Mesh::Mesh(const double* positions, std::size_t vertices, const Cells& cells, const std::vector<CellData>& data,
           const std::vector<PointData>& point_data, const Progress& progress) {
  data_ = translated([&] {
    if (vertices >= dmoscope::kNoIndex) refuse(fmt::format("{} vertices are too many", vertices));
    dmoscope::Mesh mesh;
    mesh.name = kNoFile;
    mesh.positions = vectors(positions, vertices);
    add_cells(mesh.elements, cells, vertices);
    for (const CellData& one : data) add_data(mesh, one, Field::On::Elements);
    for (const PointData& one : point_data) add_data(mesh, one, Field::On::Vertices);
    return data_of(prepare_input(std::move(mesh), {}, Need::Smoothing, progress.state().progress));
  });
}
Mesh::Mesh(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
Mesh::~Mesh() = default;
Mesh::Mesh(const Mesh&) = default;
Mesh& Mesh::operator=(const Mesh&) = default;

Mesh Mesh::read(const std::string& path, const Progress& progress) {
  return translated([&] {
    auto data = std::make_shared<Data>();
    data->input = load_input(path, Need::Smoothing, {progress.state().progress, nullptr});
    data->in_degrees = looks_geographic(data->input->mesh) == dmoscope::Likeness::Said;
    data->thin = why_not_thin(data->input->mesh, progress.state().progress).empty();
    return Mesh(std::shared_ptr<const Data>(std::move(data)));
  });
}

bool Mesh::in_degrees() const { return data_->in_degrees; }

Mesh Mesh::with_degrees(bool degrees) const {
  return translated([&] {
    if (const std::string why = degrees ? why_not_geographic(data_->input->mesh) : std::string(); !why.empty())
      refuse(fmt::format("it cannot be taken for longitude and latitude: {}", why));
    auto data = std::make_shared<Data>(*data_);
    data->in_degrees = degrees;
    return Mesh(std::shared_ptr<const Data>(std::move(data)));
  });
}

bool Mesh::thin() const { return data_->thin; }

Mesh Mesh::with_thin(bool thin) const {
  return translated([&] {
    dmoscope::Progress unwatched;
    if (const std::string why = thin ? why_not_thin(data_->input->mesh, unwatched) : std::string(); !why.empty()) refuse_thin(why);
    auto data = std::make_shared<Data>(*data_);
    data->thin = thin;
    return Mesh(std::shared_ptr<const Data>(std::move(data)));
  });
}

std::vector<std::string> Mesh::write(const std::string& path, const Progress& progress) const {
  return translated([&] {
    const bool again = data_->as_read && writes_source_again(path, *data_->as_read);
    const dmoscope::Mesh& mesh = again ? *data_->as_read : data_->input->mesh;
    const auto changed = again ? data_->fields_since(mesh) : data_->fields;
    return write_mesh(path, mesh, {data_->positions(), changed}, {progress.state().progress, nullptr});
  });
}

Mesh Mesh::with_materials(const std::vector<std::string>& names) const {
  return translated([&] {
    auto data = std::make_shared<Data>(*data_);
    data->input = dmoscope::with_materials(*data_->input, names);
    return Mesh(std::shared_ptr<const Data>(std::move(data)));
  });
}

std::size_t Mesh::vertex_count() const { return data_->input->mesh.vertex_count(); }
std::size_t Mesh::cell_count() const { return data_->input->mesh.elements.size(); }
const double* Mesh::positions() const { return &data_->positions().data()->x; }
Cells Mesh::cells() const {
  const Data::Arrays& arrays = data_->arrays();
  return {arrays.kinds.size(), arrays.kinds.data(), arrays.offsets.data(), arrays.connectivity.data()};
}
std::vector<CellData> Mesh::cell_data() const { return numbers_of(data_->input->mesh, Field::On::Elements); }
std::vector<PointData> Mesh::point_data() const {
  if (data_->fields.empty()) return numbers_of(data_->input->mesh, Field::On::Vertices);
  return numbers_of(with_fields(data_->input->mesh, data_->fields), Field::On::Vertices);
}
std::vector<Group> Mesh::groups() const {
  const dmoscope::Mesh& mesh = data_->input->mesh;
  const std::vector<dmoscope::GroupFacts> facts = facts_of_groups(mesh);
  std::vector<Group> all;
  for (std::size_t g = 0; g < facts.size(); ++g) {
    const dmoscope::Group& group = mesh.groups[g];
    Group one{group.name, facts[g].kind, group.of_elements() ? "cells" : std::string(facts[g].of), facts[g].number, {}, {}};
    if (group.of_elements()) one.cells = group.members;
    one.vertices = vertices_of(mesh, group);
    std::ranges::sort(one.vertices);
    one.vertices.erase(std::unique(one.vertices.begin(), one.vertices.end()), one.vertices.end());
    all.push_back(std::move(one));
  }
  return all;
}
std::vector<Index> Mesh::vertices(std::string_view name) const {
  return translated([&] { return vertices_named(data_->input->mesh, name); });
}

std::vector<BoundaryLoop> Mesh::boundary_loops() const {
  return translated([&] {
    dmoscope::Outline outline = outline_of(data_->judge()->mesh, data_->positions());
    std::vector<BoundaryLoop> all;
    for (dmoscope::BoundaryLoop& loop : outline.loops)
      all.push_back({std::move(loop.vertices), loop.length, loop.area, loop.part, loop.outer});
    return all;
  });
}
std::vector<std::vector<Index>> Mesh::parts() const {
  return translated([&] {
    dmoscope::Outline outline = outline_of(data_->judge()->mesh, data_->positions());
    std::vector<std::vector<Index>> all;
    for (dmoscope::MeshPart& part : outline.parts) all.push_back(std::move(part.elements));
    return all;
  });
}
std::vector<Index> Mesh::ring(std::size_t vertex) const {
  return translated([&] {
    if (vertex >= vertex_count()) throw dmoscope::UsageError(fmt::format("there is no vertex {}, the mesh has {}", vertex, vertex_count()));
    const auto input = data_->judge();
    return ordered_ring(input->mesh, input->topology, static_cast<Index>(vertex));
  });
}
bool Mesh::is_volume() const { return data_->input->is_volume(); }
bool Mesh::is_surface() const { return data_->input->is_surface(); }
const std::uint8_t* Mesh::boundary() const { return data_->input->topology.boundary().data(); }

Mesh Mesh::with_positions(const double* positions, const Progress& progress) const {
  return translated([&] {
    const Mesh moved = moved_mesh(*this, vectors(positions, vertex_count()), data_->fields);
    auto data = std::make_shared<Data>();
    data->input = moved.data()->prepared(progress.state().progress);
    data->as_read = data_->as_read;
    data->in_degrees = data_->in_degrees;
    data->thin = data_->thin && why_not_thin(data->input->mesh, progress.state().progress).empty();
    if (!data->as_read && data_->input->mesh.source) data->as_read = {data_->input, &data_->input->mesh};
    return Mesh(std::shared_ptr<const Data>(std::move(data)));
  });
}

}  // namespace dmo
