#include "ui/analysis/run_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <thread>

#include <fmt/format.h>

#include "core/base/thread_pool.h"
#include "core/inspect/element_fit.h"
#include "core/inspect/joint_hold.h"

namespace dmoscope::ui {
namespace {

constexpr std::size_t kWorthThreads = 20'000;  // faces; fewer are not worth several threads

void by_freedom(const ColourRequest& request, ElementColours& colours, render::Shading& shading) {
  const Mesh& mesh = request.frame->input->mesh;
  colours.counted = "elements";
  colours.title = "freedom to move";
  shading.values.assign(mesh.elements.size(), -1.0F);
  if (request.fixed.size() != mesh.vertex_count()) return;
  const auto freedom = freedom_of_elements(mesh, {request.fixed.data(), request.fixed.size()}, request.domain.get());
  std::array<std::size_t, kFreedoms.size()> counts{}, category{};
  for (const std::uint8_t each : freedom) ++counts[each];
  for (std::size_t k = 0; k < kFreedoms.size(); ++k) {
    if (counts[k] == 0) continue;
    category[k] = colours.categories.size();
    const double t = static_cast<double>(k) / static_cast<double>(kFreedoms.size() - 1);
    const render::Rgb colour = render::sample(request.map, request.reversed ? 1.0 - t : t);
    colours.categories.push_back({std::string(kFreedoms[k]), colour, counts[k]});
  }
  for (std::size_t e = 0; e < freedom.size(); ++e) shading.values[e] = static_cast<float>(category[freedom[e]]);
}

ElementFit fit_of(const ColourRequest& request) {
  const Frame& frame = *request.frame;
  if (request.domain->faces().table().size() < kWorthThreads) return element_fit(*frame.input, *request.domain, frame.positions);
  ThreadPool pool(std::max(1U, std::thread::hardware_concurrency()));
  return element_fit(*frame.input, *request.domain, frame.positions, &pool);
}

void by_fit(const ColourRequest& request, ElementColours& colours, render::Shading& shading) {
  const Frame& frame = *request.frame;
  const bool tilt = request.by == ColourBy::Tilt;
  if (!request.domain) {
    shading.values.assign(frame.element_count(), std::numeric_limits<float>::quiet_NaN());
    colours.title = colours.common_title = std::string(info(request.by).name);
    colours.note = "nothing slides in this run, so its boundary is that of the input (the command boundary slide changes that)";
    colours.has_values = false;
    return;
  }
  ElementFit fit = fit_of(request);
  shading.values = std::move(tilt ? fit.tilt : fit.deviation);
  double most = 0.0;
  std::size_t inside = 0;
  for (const float value : shading.values) {
    if (std::isnan(value))
      ++inside;
    else
      most = std::max(most, static_cast<double>(value));
  }
  if (inside > 0) colours.beside.push_back({frame.input->is_surface() ? "beside it" : "inside", render::kUndefinedColour, inside});
  const double size = frame.input->geometry.size;
  const double least = tilt ? 1.0 : 1e-6 * size;  // smallest range that colours are spread over
  colours.range = {0.0, std::max(most, least)};
  const std::string from = frame.input->surface ? frame.input->surface->mesh.name : tilt ? "the input's surface" : "the input";
  colours.common_title = tilt ? fmt::format("tilt from {}, degrees", from) : fmt::format("deviation from {}", from);
  if (most == 0.0)
    colours.title = colours.common_title + ": none";
  else if (tilt)
    colours.title = fmt::format("{}: up to {:.3g}", colours.common_title, most);
  else
    colours.title = fmt::format("{}: up to {:.3g}, {:.2g} of the diagonal", colours.common_title, most, most / size);
}

}  // namespace

std::vector<std::uint8_t> freedom_of_elements(const Mesh& mesh, std::span<const std::uint8_t> fixed, const Domain* domain) {
  const auto of_vertex = [&](Index v) -> std::uint8_t {
    if (fixed[v] != 0) return 1;
    if (domain == nullptr || !domain->slides(v)) return 4;
    return domain->on_curve(v) ? 2 : 3;
  };
  std::vector<std::uint8_t> freedom(mesh.elements.size());
  for (Index e = 0; e < freedom.size(); ++e) {
    std::uint8_t least = 4;
    bool any_moves = false;
    for (const Index v : mesh.elements.corners(e)) {
      least = std::min(least, of_vertex(v));
      any_moves = any_moves || fixed[v] == 0;
    }
    freedom[e] = any_moves ? least : 0;
  }
  return freedom;
}

void colour_by_sliding(const ColourRequest& request, ElementColours& colours, render::Shading& shading) {
  if (request.by == ColourBy::Freedom)
    by_freedom(request, colours, shading);
  else
    by_fit(request, colours, shading);
}

std::vector<Index> elements_of(const JointCluster& cluster, const InputMesh& input) {
  std::vector<Index> elements;
  for (const Index v : cluster.vertices)
    for (const Incidence& incidence : input.topology.star(v)) elements.push_back(incidence.element);
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

void colour_by_multiplier(const ColourRequest& request, ElementColours& colours, render::Shading& shading) {
  colours.title = colours.common_title = "multiplier";
  shading.values.assign(request.frame->element_count(), std::numeric_limits<float>::quiet_NaN());
  if (!request.hold) {
    colours.note = "what holds the minimum is not known yet (the command held-by finds out)";
    colours.has_values = false;
    return;
  }
  const std::vector<Index> cluster = elements_of(*request.hold, *request.frame->input);
  for (const Index e : cluster) shading.values[e] = 0.0F;
  double most = 0.0;
  for (const JointCluster::Active& one : request.hold->active) {
    shading.values[one.element] = static_cast<float>(one.multiplier);
    most = std::max(most, one.multiplier);
  }
  const std::size_t outside = shading.values.size() - cluster.size();
  if (outside > 0) colours.beside.push_back({"outside of the cluster", render::kUndefinedColour, outside});
  colours.range = {0.0, most > 0.0 ? most : 1.0};
  colours.title = fmt::format("multiplier: {} elements hold one another", holders(*request.hold).size());
}

}  // namespace dmoscope::ui
