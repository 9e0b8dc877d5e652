#include "ui/analysis/element_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/input/input_mesh.h"
#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"
#include "core/smooth/size_field.h"
#include "ui/analysis/mesh_parts.h"
#include "ui/analysis/run_colours.h"

namespace dmoscope::ui {
namespace {

using By = render::Shading::By;

/// Results of the functions below; the shading is moved to its place in the end.
struct Work {
  const ColourRequest& request;
  const Mesh& mesh;
  ElementColours out;
  render::Shading shading;

  void categories(By by, std::size_t size, const char* counted) {
    shading.by = by;
    shading.values.assign(size, -1.0F);
    out.counted = counted;
  }
  /// Adds a category without an order.
  void add_category(std::string name) { out.categories.push_back({std::move(name), category_colour(out.categories.size()), 0}); }
  void put(Index id, std::size_t category) {
    shading.values[id] = static_cast<float>(category);
    ++out.categories[category].count;
  }
};

void by_kind(Work& work) {
  work.categories(By::Elements, work.mesh.elements.size(), "elements");
  std::array<std::size_t, kElementKindCount> category{};
  const auto kinds = work.mesh.elements.kinds();
  for (std::size_t kind = 0; kind < kElementKindCount; ++kind) {
    if (std::find(kinds.begin(), kinds.end(), static_cast<ElementKind>(kind)) == kinds.end()) continue;
    category[kind] = work.out.categories.size();
    work.add_category(std::string(info(static_cast<ElementKind>(kind)).name));
  }
  for (Index e = 0; e < work.mesh.elements.size(); ++e) work.put(e, category[static_cast<std::size_t>(kinds[e])]);
}

void by_group(Work& work) {
  const auto& groups = work.mesh.groups;
  const bool of_elements = std::any_of(groups.begin(), groups.end(), [](const Group& group) { return group.of_elements(); });
  work.categories(of_elements ? By::Elements : By::Vertices, of_elements ? work.mesh.elements.size() : work.mesh.positions.size(),
                  of_elements ? "elements" : "vertices");
  work.shading.edges = !of_elements;
  if (groups.empty()) work.out.note = "the mesh has no groups or markers";
  const bool many = groups.size() > kMostGroupCategories;
  std::map<std::string, std::size_t> numbers;
  for (const Group& group : groups) {
    if (group.of_elements() != of_elements) continue;
    const std::string name = category_of(group, many);
    const auto [at, added] = numbers.try_emplace(name, work.out.categories.size());
    if (added) work.add_category(name);
    for (const Index member : of_elements ? std::span<const Index>(group.members) : group.vertices()) {
      if (member < work.shading.values.size() && work.shading.values[member] < 0.0F) work.put(member, at->second);
    }
  }
}

void by_valence(Work& work) {
  constexpr std::size_t kMost = 10;  // categories
  const Topology& topology = work.request.frame->input->topology;
  work.categories(By::Vertices, topology.vertex_count(), "vertices");
  const auto valence = [&](Index v) { return topology.star(v).size(); };
  std::size_t least = SIZE_MAX, largest = 0;
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    if (valence(v) == 0) continue;
    least = std::min(least, valence(v));
    largest = std::max(largest, valence(v));
  }
  if (largest == 0) return;
  const std::size_t size = std::min(kMost, largest - least + 1);
  for (std::size_t k = 0; k < size; ++k) {
    const double t = size > 1 ? static_cast<double>(k) / static_cast<double>(size - 1) : 0.5;
    const bool open = k + 1 == size && least + k < largest;
    work.out.categories.push_back({open ? fmt::format("{} or more", least + k) : fmt::format("{}", least + k),
                                   render::sample(work.request.map, work.request.reversed ? 1.0 - t : t), 0});
  }
  for (Index v = 0; v < topology.vertex_count(); ++v) {
    if (valence(v) > 0) work.put(v, std::min(valence(v) - least, size - 1));
  }
}

void by_class(Work& work) {
  work.categories(By::Vertices, work.mesh.positions.size(), "free vertices");
  const Colouring* classes = work.request.classes.get();
  if (classes == nullptr) return;
  for (Index c = 0; c < classes->class_count(); ++c) {
    work.add_category(fmt::format("{}", c + 1));
    for (const Index v : classes->members(c)) work.put(v, c);
  }
  work.out.note = "grey: vertices that may not move";
}

void by_inverted(Work& work) {
  work.categories(By::Elements, work.mesh.elements.size(), "elements");
  work.out.note = "all others are grey";
}

/// Sum and number of the edge lengths of one or several elements.
struct Edges {
  Plane plane{};  // measures how far two positions are apart
  double sum = 0.0;
  std::size_t count = 0;
  void add(Vec3 a, Vec3 b) {
    sum += length(plane.difference(b, a));
    ++count;
  }
  /// Adds each edge of a volume element twice, once for each of its two faces.
  void add_element(const ElementTable& elements, std::span<const Vec3> at, Index element) {
    const auto corners = elements.corners(element);
    const auto faces = faces_of(elements.kind(element));
    for (const LocalFace& face : faces)
      for (Index i = 0; i < face.count; ++i) add(at[corners[face.corners[i]]], at[corners[face.corners[i + 1 < face.count ? i + 1 : 0]]]);
    for (std::size_t i = 0; i < corners.size() && faces.empty(); ++i) add(at[corners[i]], at[corners[(i + 1) % corners.size()]]);
  }
  [[nodiscard]] double mean() const { return count == 0 ? 0.0 : sum / static_cast<double>(count); }
};

double mean_edge(const Mesh& mesh, const Plane& plane) {
  Edges edges{plane};
  for (Index e = 0; e < mesh.elements.size(); ++e) edges.add_element(mesh.elements, mesh.positions, e);
  return edges.mean();
}

void find_range(Work& work) {
  double low = INFINITY, high = -INFINITY;
  for (const float value : work.shading.values) {
    if (std::isnan(value)) continue;
    low = std::min(low, static_cast<double>(value));
    high = std::max(high, static_cast<double>(value));
  }
  if (low <= high) work.out.range = {low, high};
}

void by_displacement(Work& work) {
  const auto& now = work.request.frame->positions;
  const double unit = mean_edge(work.mesh, work.request.frame->input->geometry.plane);
  std::vector<float> moved(now.size());
  for (std::size_t v = 0; v < now.size(); ++v) {
    const double way = length(work.request.frame->input->geometry.plane.difference(now[v], work.mesh.positions[v]));
    moved[v] = static_cast<float>(unit > 0.0 ? way / unit : way);
  }
  work.shading.values.resize(work.mesh.elements.size());
  for (Index e = 0; e < work.mesh.elements.size(); ++e) {
    float most = 0.0F;
    for (const Index corner : work.mesh.elements.corners(e)) most = std::max(most, moved[corner]);
    work.shading.values[e] = most;
  }
  find_range(work);
  work.out.range.first = 0.0;
  if (work.out.range.second == 0.0) work.out.range.second = 1.0;  // nothing has moved
  work.out.title = "displacement, mean edges of the input";
}

/// Area or volume, without its sign.
double size_of_element(const Frame& frame, Index e) {
  const ElementTable& elements = frame.input->mesh.elements;
  const auto& at = frame.positions;
  const auto corners = elements.corners(e);
  if (frame.input->is_volume()) return std::abs(signed_volume(elements, at, e));
  if (frame.input->is_surface()) {
    const Vec3 a = at[corners[0]], b = at[corners[1]], c = at[corners[2]];
    return 0.5 * length(corners.size() == 3 ? cross(b - a, c - a) : cross(c - a, at[corners[3]] - b));
  }
  const Plane& plane = frame.input->geometry.plane;
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    twice += cross(plane.offset(at[corners[i]], at[corners[0]]), plane.offset(at[corners[i + 1]], at[corners[0]]));
  }
  return std::abs(twice) / 2;
}

void by_size(Work& work) {
  const auto& elements = work.mesh.elements;
  std::vector<double> areas(elements.size());
  double sum = 0.0;
  for (Index e = 0; e < elements.size(); ++e) {
    areas[e] = size_of_element(*work.request.frame, e);
    sum += areas[e];
  }
  const double mean = areas.empty() ? 0.0 : sum / static_cast<double>(areas.size());
  work.shading.values.resize(areas.size());
  std::transform(areas.begin(), areas.end(), work.shading.values.begin(), [&](double area) {
    return area > 0.0 && mean > 0.0 ? static_cast<float>(std::log10(area / mean)) : std::numeric_limits<float>::quiet_NaN();
  });
  find_range(work);
  // Elements of one size differ by rounding only: that is no range to spread colours over.
  if (work.out.range.second - work.out.range.first < 0.02) work.out.range = {work.out.range.first - 0.01, work.out.range.second + 0.01};
  work.out.logarithmic = true;
  work.out.title = work.request.frame->input->is_volume() ? "volume / mean volume" : "area / mean area";
}

/// Decimal logarithm of each vertex's mean edge length, divided by the wanted size at its place if there is one.
std::vector<double> edge_logarithms(const Frame& frame, const SizeField* size) {
  const PlanarView mesh = frame.input->planar_view();
  std::vector<double> logarithms(frame.vertex_count());
  for (Index v = 0; v < frame.vertex_count(); ++v) {
    const double edge = local_edge_length(mesh, frame.positions, v);
    logarithms[v] = std::log10(size != nullptr ? edge / size->at(v, frame.positions[v]) : edge);
  }
  return logarithms;
}

/// Spreads the colours over logarithms.
void find_log_range(Work& work) {
  find_range(work);
  if (work.out.range.second - work.out.range.first < 0.02) work.out.range = {work.out.range.first - 0.01, work.out.range.second + 0.01};
  work.out.logarithmic = true;
}

/// Colours each element by the mean of its corners' values.
void by_corners(Work& work, std::span<const double> values) {
  work.shading.values.resize(work.mesh.elements.size());
  for (Index e = 0; e < work.mesh.elements.size(); ++e) {
    const auto corners = work.mesh.elements.corners(e);
    double sum = 0.0;
    for (const Index corner : corners) sum += values[corner];
    const double mean = sum / static_cast<double>(corners.size());
    work.shading.values[e] = std::isfinite(mean) ? static_cast<float>(mean) : std::numeric_limits<float>::quiet_NaN();
  }
  find_log_range(work);
}

/// Colours each volume element by its own edges.
void by_own_edges(Work& work) {
  work.shading.values.resize(work.mesh.elements.size());
  for (Index e = 0; e < work.mesh.elements.size(); ++e) {
    Edges edges;
    edges.add_element(work.mesh.elements, work.request.frame->positions, e);
    const double mean = edges.mean();
    work.shading.values[e] = mean > 0.0 ? static_cast<float>(std::log10(mean)) : std::numeric_limits<float>::quiet_NaN();
  }
  find_log_range(work);
}

void by_edge_length(Work& work) {
  work.out.title = "mean edge length";
  if (work.request.frame->input->in_space()) return by_own_edges(work);
  by_corners(work, edge_logarithms(*work.request.frame, nullptr));
}

void by_size_over_target(Work& work) {
  work.out.title = "edge length / target size";
  if (!work.request.size) {
    work.shading.values.assign(work.mesh.elements.size(), std::numeric_limits<float>::quiet_NaN());
    work.out.note = "the run has no size function: combine its metric with a density first";
    work.out.has_values = false;
    return;
  }
  std::vector<double> values = edge_logarithms(*work.request.frame, work.request.size.get());
  double sum = 0.0;
  std::size_t count = 0;
  for (const double value : values)
    if (std::isfinite(value)) {
      sum += value;
      ++count;
    }
  if (count > 0)
    for (double& value : values) value -= sum / static_cast<double>(count);
  by_corners(work, values);
  const double widest = std::max(std::abs(work.out.range.first), std::abs(work.out.range.second));
  work.out.range = {-widest, widest};  // so that ratio 1 is in the middle
  work.out.centred = true;
}

/// Name of a frame: "run 2, iteration 10", "input".
std::string name_of(const Frame& frame) {
  if (frame.run == Frame::kNoRun) return "input";
  std::string name = fmt::format("run {}, iteration {}", frame.run + 1, count(frame.moment.iteration));
  if (frame.moment.visits > 0) name += fmt::format(" + {}", frame.moment.visits);
  return name;
}

void by_difference(Work& work) {
  const Frame &frame = *work.request.frame, &reference = *work.request.reference;
  if (!work.request.comparable) {
    work.shading.values.assign(work.mesh.elements.size(), std::numeric_limits<float>::quiet_NaN());
    work.out.title = work.out.common_title = "difference";
    work.out.note = fmt::format("{} has other elements than {}: nothing to compare", frame.input->mesh.name, reference.input->mesh.name);
    work.out.has_values = false;
    return;
  }
  const QualityContext context = reference.input->quality_context();
  const bool same_metric = reference.shown == frame.shown;
  work.shading.values.resize(frame.quality.size());
  double most = 0.0;
  for (Index e = 0; e < frame.quality.size(); ++e) {
    // Both are rounded to float, as they are shown, so that unchanged elements have no difference.
    const float before =
        same_metric ? reference.quality[e] : static_cast<float>(element_quality(context, reference.positions, frame.shown, e));
    const float difference = frame.quality[e] - before;
    work.shading.values[e] = difference;
    work.out.better += difference > 0.0F ? 1 : 0;
    work.out.worse += difference < 0.0F ? 1 : 0;
    if (std::isfinite(difference)) most = std::max(most, std::abs(static_cast<double>(difference)));
  }
  constexpr double kLeast = 0.01;
  if (most == 0.0) most = kLeast;  // all differences are 0, which must not widen the range of the viewports beside it
  work.out.range = {-most, most};
  work.out.diverging = work.out.centred = true;
  const std::string metric(info(frame.shown).title);
  const std::string of = reference.input == frame.input ? name_of(reference) : name_of(reference) + " of " + reference.input->mesh.name;
  work.out.title = fmt::format("{}: {} minus {}", metric, name_of(frame), of);
  work.out.common_title = fmt::format("{}: each minus {}", metric, of);
}

void by_sliding(Work& work) { colour_by_sliding(work.request, work.out, work.shading); }
void by_multiplier(Work& work) { colour_by_multiplier(work.request, work.out, work.shading); }

constexpr auto kColourings = std::to_array<std::pair<ColourBy, void (*)(Work&)>>({{ColourBy::Kind, by_kind},
                                                                                  {ColourBy::Group, by_group},
                                                                                  {ColourBy::Valence, by_valence},
                                                                                  {ColourBy::Class, by_class},
                                                                                  {ColourBy::Displacement, by_displacement},
                                                                                  {ColourBy::Size, by_size},
                                                                                  {ColourBy::Inverted, by_inverted},
                                                                                  {ColourBy::EdgeLength, by_edge_length},
                                                                                  {ColourBy::SizeOverTarget, by_size_over_target},
                                                                                  {ColourBy::Difference, by_difference},
                                                                                  {ColourBy::Deviation, by_sliding},
                                                                                  {ColourBy::Tilt, by_sliding},
                                                                                  {ColourBy::Freedom, by_sliding},
                                                                                  {ColourBy::Multiplier, by_multiplier}});

}  // namespace

ElementColours colour_elements(const ColourRequest& request) {
  Work work{request, request.frame->input->mesh, {}, {}};
  work.out.by = request.by;
  work.out.input_serial = request.frame->input_serial;
  work.out.title = info(request.by).name;
  if (const auto* const at = std::ranges::find(kColourings, request.by, &std::pair<ColourBy, void (*)(Work&)>::first);
      at != kColourings.end())
    at->second(work);
  if (work.out.common_title.empty()) work.out.common_title = work.out.title;
  for (const Category& category : work.out.categories) work.shading.palette.push_back(category.colour);
  // A palette that is not empty means that the values are categories.
  if (has_categories(request.by) && work.shading.palette.empty()) work.shading.palette.push_back({});
  work.out.shading = std::make_shared<const render::Shading>(std::move(work.shading));
  return std::move(work.out);
}

std::optional<std::string> why_not_drawn(ColourBy by, const InputMesh& input) {
  if (!input.in_space())
    return by == ColourBy::Tilt ? std::optional<std::string>("tilt is defined for surfaces in space only") : std::nullopt;
  const auto of_elements = [](const Group& group) { return group.of_elements(); };
  const bool around_vertices =
      by == ColourBy::Valence || by == ColourBy::Class || (by == ColourBy::Group && std::ranges::none_of(input.mesh.groups, of_elements));
  if (around_vertices)
    return fmt::format("{} colours the surroundings of vertices: of volume meshes whole elements are coloured", info(by).name);
  if (by == ColourBy::SizeOverTarget) return "size functions work on planar meshes only";
  return std::nullopt;
}

bool tells_nothing(ColourBy by, const Frame& opened) {
  const InputMesh& input = *opened.input;
  if (why_not_drawn(by, input)) return true;
  switch (by) {
    case ColourBy::Group:
      return input.mesh.groups.empty();
    case ColourBy::Kind: {
      const auto kinds = input.mesh.elements.kinds();
      return std::ranges::all_of(kinds, [&](ElementKind kind) { return kind == kinds.front(); });
    }
    case ColourBy::Inverted:
      return opened.shown_statistics.inverted == 0;
    case ColourBy::Displacement:
    case ColourBy::Difference:
    case ColourBy::Deviation:
    case ColourBy::Tilt:
    case ColourBy::SizeOverTarget:
      return opened.moment == Moment{};  // nothing has moved, and no run has a size function yet
    default:
      return false;
  }
}

}  // namespace dmoscope::ui
