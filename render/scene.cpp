#include "render/scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <iterator>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/session/input_mesh.h"
#include "render/device_feed.h"
#include "render/element_painter.h"
#include "render/layout.h"
#include "render/mark_painter.h"

namespace dmoscope::render {
namespace {

constexpr std::size_t kBigMesh = 100'000;        // elements whose layout takes long enough to be built in the background
constexpr std::size_t kMostVertexDots = 20'000;  // beyond, dots would hide the mesh anyway

/// Keeps what a draw changes and others may rely on: the bound framebuffer and the viewport.
class TargetGuard {
 public:
  TargetGuard() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    glGetIntegerv(GL_VIEWPORT, viewport_);
  }
  ~TargetGuard() {
    glBindVertexArray(0);
    glUseProgram(0);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  }
  TargetGuard(const TargetGuard&) = delete;
  TargetGuard& operator=(const TargetGuard&) = delete;

 private:
  GLint draw_ = 0, read_ = 0, viewport_[4] = {0, 0, 0, 0};
};

View make_view(const Layout& layout, const Camera2D& camera, Vec2<double> viewport, float scale) {
  View view;
  const Vec2<double> offset = camera.centre - layout.origin;
  view.offset_high = {static_cast<float>(offset.x), static_cast<float>(offset.y)};
  view.offset_low = {static_cast<float>(offset.x - static_cast<double>(view.offset_high.x)),
                     static_cast<float>(offset.y - static_cast<double>(view.offset_high.y))};
  view.zoom = static_cast<float>(1.0 / camera.units_per_pixel);
  view.viewport = {static_cast<float>(viewport.x), static_cast<float>(viewport.y)};
  // The stripes move with the mesh, so that tiles of a picture fit together.
  const double period = camera.units_per_pixel * static_cast<double>(kHatchPeriod * scale);
  const auto phase = [&](double along) { return static_cast<float>(along / period - std::floor(along / period)); };
  view.hatch_phase = {phase(offset.x - offset.y), phase(offset.x + offset.y)};
  return view;
}

}  // namespace

struct MeshScene::Impl {
  Placement placement;
  bool placement_current = true;  // false: what is on show stands on a device, and the placement is an older one's
  Source source = Source::Host;
  ElementPainter elements;
  DeviceFeed device;  // after the painter, whose buffers it knows
  MarkPainter marks;
  std::vector<std::uint8_t> fixed;
  std::vector<std::uint8_t> inverted;
  std::vector<Vec2<float>> point_scratch;
  std::vector<float> shade_scratch;
  std::shared_ptr<const Frame> frame;  // the one on show
  std::uint64_t input_serial = 0;
  bool has_input = false;
  std::future<std::shared_ptr<const Layout>> pending;
  std::uint64_t pending_serial = 0;
  std::shared_ptr<const InputMesh> pending_input;

  void adopt(std::shared_ptr<const Layout> layout) {
    device.forget_buffers();
    elements.upload_topology(*layout);
    placement = Placement(std::move(layout));
    fixed.clear();
    inverted.clear();
  }
  bool prepare(const Frame& wanted, Loading loading);
  void upload(std::span<const Vec3> positions, std::span<const float> quality, std::span<const std::uint8_t> inverted_flags);
  void show_device(const Frame& light);
  /// Brings the placement up to date with what is on show. Throws DeviceError.
  void place_all();
  /// Where some vertices are in the plane. Throws DeviceError.
  [[nodiscard]] std::vector<Vec2<double>> points_of(std::span<const Index> vertices) const;
  [[nodiscard]] std::vector<DrawRange> visible(std::size_t batch, const Bounds2& window) const;
  void gather_mesh_marks(const Camera2D& camera, const Style& style, const Marks& wanted);
  void gather_marks(const Camera2D& camera, const Style& style, const Marks& wanted);
  void gather_vertices(const Camera2D& camera, const Style& style, const Bounds2& window);
  void outline(std::span<const Vec2<double>> corners, const Camera2D& camera, const Style& style);
  /// Pixels from the middle of the viewport, y up.
  [[nodiscard]] static Vec2<double> place(Vec2<double> point, const Camera2D& camera) {
    return {(point.x - camera.centre.x) / camera.units_per_pixel, (point.y - camera.centre.y) / camera.units_per_pixel};
  }
};

MeshScene::MeshScene() : impl_(std::make_unique<Impl>()) {}
MeshScene::~MeshScene() = default;
MeshScene::MeshScene(MeshScene&&) noexcept = default;
MeshScene& MeshScene::operator=(MeshScene&&) noexcept = default;

/// Whether the layout of the frame's mesh is on the OpenGL side now.
bool MeshScene::Impl::prepare(const Frame& wanted, Loading loading) {
  if (has_input && input_serial == wanted.input_serial && !placement.empty()) return true;
  const bool background = loading == Loading::Background && wanted.input->mesh.elements.size() > kBigMesh;
  if (!pending.valid() || pending_serial != wanted.input_serial) {
    if (pending.valid()) {
      // One at a time: the earlier one must end first, for it cannot be stopped.
      if (background && pending.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
      pending.wait();
    }
    pending_serial = wanted.input_serial;
    pending = std::async(background ? std::launch::async : std::launch::deferred,
                         [input = wanted.input] { return build_layout(input->mesh, input->geometry.plane); });
  }
  if (background && pending.wait_for(std::chrono::seconds(0)) == std::future_status::timeout) return false;
  adopt(pending.get());
  input_serial = wanted.input_serial;
  has_input = true;
  return true;
}

bool MeshScene::show(std::shared_ptr<const Frame> frame, Loading loading) {
  Impl& s = *impl_;
  const bool ready = frame && s.prepare(*frame, loading);
  if (!ready) {
    s.device.clear();
    s.source = Source::Host;
    s.placement_current = true;
    s.placement = Placement();
    s.has_input = false;
    s.frame.reset();
    return !frame;
  }
  if (!s.frame || s.frame->serial != frame->serial || s.frame->input_serial != frame->input_serial) {
    if (frame->device) {
      s.show_device(*frame);
    } else {
      s.upload(frame->positions, frame->quality, frame->inverted);
    }
  }
  s.frame = std::move(frame);
  return true;
}

void MeshScene::draw_through_host(std::string why) { impl_->device.never_direct(std::move(why)); }

void MeshScene::set_mesh(const Mesh& mesh, const Plane& plane) {
  auto layout = build_layout(mesh, plane);
  impl_->adopt(std::move(layout));
  impl_->frame.reset();
  impl_->has_input = false;
}

void MeshScene::update(std::span<const Vec3> positions, std::span<const float> quality, std::span<const std::uint8_t> inverted) {
  if (impl_->placement.empty()) throw UsageError("there is no mesh to update");
  impl_->upload(positions, quality, inverted);
}

void MeshScene::Impl::upload(std::span<const Vec3> positions, std::span<const float> quality,
                             std::span<const std::uint8_t> inverted_flags) {
  const Index count = placement.layout().element_count();
  if (quality.size() != count || (!inverted_flags.empty() && inverted_flags.size() != count)) {
    throw UsageError("as many qualities as the mesh has elements are needed");
  }
  device.clear();
  source = Source::Host;
  placement_current = true;
  placement.move(positions);
  const Vec2<double> origin = placement.layout().origin;
  const auto points = placement.points();
  point_scratch.resize(points.size());
  std::transform(points.begin(), points.end(), point_scratch.begin(), [&](const Vec2<double>& p) {
    return Vec2<float>{static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y)};
  });
  elements.upload_points(point_scratch);
  inverted.assign(inverted_flags.begin(), inverted_flags.end());
  shade_scratch.resize(count);
  for (Index e = 0; e < count; ++e) shade_scratch[e] = shade_of(quality[e], !inverted.empty() && inverted[e] != 0);
  elements.upload_shades(shade_scratch);
}

void MeshScene::Impl::show_device(const Frame& light) {
  if (placement.bounds().empty()) placement.move(light.input->mesh.positions);  // something to fit the view to
  placement_current = false;
  const bool shown = device.show(light.device, elements, placement.layout());
  source = !shown ? Source::Unreachable : device.direct() ? Source::Device : Source::HostCopy;
}

void MeshScene::Impl::place_all() {
  if (placement_current) return;
  const DeviceFeed::HostCopy& copy = device.host_copy(placement.layout());
  placement.move(copy.points);
  inverted.resize(copy.shades.size());
  std::transform(copy.shades.begin(), copy.shades.end(), inverted.begin(),
                 [](float shade) { return static_cast<std::uint8_t>(shade == kInvertedShade ? 1 : 0); });
  placement_current = true;
}

std::vector<Vec2<double>> MeshScene::Impl::points_of(std::span<const Index> vertices) const {
  std::vector<Vec2<double>> points;
  points.reserve(vertices.size());
  if (placement_current) {
    for (const Index v : vertices) points.push_back(placement.points()[v]);
  } else if (!vertices.empty()) {
    for (const Vec3& position : device.positions(vertices)) points.push_back(placement.layout().plane.project(position));
  }
  return points;
}

/// Everything while nobody here knows where the elements are.
std::vector<DrawRange> MeshScene::Impl::visible(std::size_t batch, const Bounds2& window) const {
  if (placement_current) return placement.visible(batch, window);
  const Index all = placement.layout().batches[batch].size();
  return all == 0 ? std::vector<DrawRange>{} : std::vector<DrawRange>{{0, all}};
}

void MeshScene::set_fixed(std::span<const std::uint8_t> fixed) { impl_->fixed.assign(fixed.begin(), fixed.end()); }

bool MeshScene::empty() const noexcept { return impl_->placement.empty() || impl_->placement.layout().element_count() == 0; }
Index MeshScene::element_count() const noexcept { return impl_->placement.empty() ? 0 : impl_->placement.layout().element_count(); }
const Bounds2& MeshScene::bounds() const noexcept { return impl_->placement.bounds(); }
Source MeshScene::source() const noexcept { return impl_->source; }
const std::string& MeshScene::device_trouble() const noexcept { return impl_->device.trouble(); }

void MeshScene::draw(Framebuffer& target, const Camera2D& camera, const Style& style, const Marks& marks, double detail) {
  const TargetGuard guard;
  target.clear(style.transparent ? Rgba{0, 0, 0, 0} : Rgba{style.background.r, style.background.g, style.background.b, 255});
  glDisable(GL_CULL_FACE);
  glDisable(GL_STENCIL_TEST);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  Impl& s = *impl_;
  const Vec2<double> viewport{static_cast<double>(target.width()), static_cast<double>(target.height())};
  const Layout nothing;
  const View view = make_view(s.placement.empty() ? nothing : s.placement.layout(), camera, viewport, style.scale);
  if (!empty() && s.source != Source::Unreachable) {
    const Bounds2 window = camera.visible(viewport);
    const std::vector<DrawRange> ranges[] = {s.visible(0, window), s.visible(1, window)};
    double in_view = 0.0;
    for (const auto& list : ranges) {
      for (const DrawRange& range : list) in_view += range.last - range.first;
    }
    const double budget = std::max(1.0, std::clamp(detail, 0.0, 1.0) * element_count());
    const auto stride = static_cast<Index>(std::ceil(in_view / budget - 1e-9));
    s.elements.set_colours(style.colours);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    for (std::size_t batch = 0; batch < 2; ++batch) {
      if (stride > 1) {
        s.elements.draw_coarse(view, batch, ranges[batch], stride);
      } else {
        s.elements.draw(view, style, batch, ranges[batch]);
      }
    }
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    if (style.boundary) s.elements.draw_boundary(view, style);
    if (style.vertices && stride <= 1) s.gather_vertices(camera, style, window);
  }
  s.gather_marks(camera, style, marks);
  s.marks.flush(view, style.scale);
}

void MeshScene::Impl::outline(std::span<const Vec2<double>> corners, const Camera2D& camera, const Style& style) {
  for (const bool casing : {true, false}) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2<double> a = place(corners[i], camera), b = place(corners[(i + 1) % corners.size()], camera);
      marks.line(a, b, (casing ? 5.0F : 2.4F) * style.scale, casing ? style.casing_colour : style.highlight_colour);
    }
  }
}

/// Marks of elements and vertices; their places are asked for all together.
void MeshScene::Impl::gather_mesh_marks(const Camera2D& camera, const Style& style, const Marks& wanted) {
  const Layout& layout = placement.layout();
  std::vector<std::span<const Index>> shapes;  // outlined elements, and last the worst
  for (const Index e : wanted.elements) {
    if (e < layout.element_count()) shapes.push_back(layout.corners_of_element(e));
  }
  const std::size_t outlined = shapes.size();
  if (wanted.worst && *wanted.worst < layout.element_count()) shapes.push_back(layout.corners_of_element(*wanted.worst));
  std::vector<Index> vertices;
  for (const auto& shape : shapes) vertices.insert(vertices.end(), shape.begin(), shape.end());
  const std::size_t corner_count = vertices.size();
  std::copy_if(wanted.vertices.begin(), wanted.vertices.end(), std::back_inserter(vertices),
               [&](Index v) { return v < layout.vertex_count; });
  const std::vector<Vec2<double>> points = points_of(vertices);
  std::span<const Vec2<double>> rest(points.data(), corner_count);
  for (std::size_t k = 0; k < outlined; ++k) {
    outline(rest.first(shapes[k].size()), camera, style);
    rest = rest.subspan(shapes[k].size());
  }
  for (std::size_t k = corner_count; k < points.size(); ++k) {
    marks.dot(place(points[k], camera), 9.0F * style.scale, DotShape::Round, style.highlight_colour, style.casing_colour);
  }
  if (shapes.size() > outlined) {
    Bounds2 box;
    for (const Vec2<double>& corner : rest) box.include(corner);
    const double size = std::hypot(box.size().x, box.size().y) / camera.units_per_pixel;
    const float diameter = std::max(26.0F * style.scale, static_cast<float>(std::min(size, 1e5)) * 1.15F + 8.0F * style.scale);
    marks.dot(place(box.centre(), camera), diameter, DotShape::Ring, style.highlight_colour, style.casing_colour);
  }
}

void MeshScene::Impl::gather_marks(const Camera2D& camera, const Style& style, const Marks& wanted) {
  try {
    if (!placement.empty() && source != Source::Unreachable) gather_mesh_marks(camera, style, wanted);
  } catch (const DeviceError&) {  // unmarked; the next frame finds out what is the matter
  }
  for (const OverlayLine& line : wanted.lines) {
    marks.line(place(line.from, camera), place(line.to, camera), line.width * style.scale, line.colour);
  }
  for (const OverlayDot& dot : wanted.dots) {
    marks.dot(place(dot.point, camera), dot.diameter * style.scale, dot.square ? DotShape::Square : DotShape::Round, dot.colour,
              style.casing_colour);
  }
}

void MeshScene::Impl::gather_vertices(const Camera2D& camera, const Style& style, const Bounds2& window) {
  try {
    place_all();
  } catch (const DeviceError&) {  // no dots; the next frame finds out what is the matter
    return;
  }
  // Vertices of elements in view that are big enough, each once.
  const double room = 14.0 * static_cast<double>(style.scale) * camera.units_per_pixel;
  std::vector<Index> seen;
  for (std::size_t batch = 0; batch < 2; ++batch) {
    const Batch& elements_of = placement.layout().batches[batch];
    for (const DrawRange& range : placement.visible(batch, window)) {
      for (Index drawn = range.first; drawn < range.last; ++drawn) {
        const auto corners = elements_of.corners_of(drawn);
        const Vec2<double> a = placement.points()[corners[0]], b = placement.points()[corners[1]], c = placement.points()[corners[2]];
        if (std::abs(cross(b - a, c - a)) < room * room) continue;
        seen.insert(seen.end(), corners.begin(), corners.end());
        if (seen.size() > 6 * kMostVertexDots) return;
      }
    }
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  if (seen.size() > kMostVertexDots) return;
  for (const Index v : seen) {
    const bool is_fixed = v < fixed.size() && fixed[v] != 0;
    marks.dot(place(placement.points()[v], camera), (is_fixed ? 5.0F : 4.5F) * style.scale, is_fixed ? DotShape::Square : DotShape::Round,
              is_fixed ? style.fixed_colour : style.free_colour, style.vertex_casing_colour);
  }
}

Pick MeshScene::pick(const Camera2D& camera, Vec2<double> viewport, Vec2<double> pixel, double radius) const {
  Pick result;
  Impl& s = *impl_;
  if (empty() || s.source == Source::Unreachable) return result;
  try {
    s.place_all();
  } catch (const DeviceError&) {
    return result;
  }
  const Vec2<double> point = camera.to_plane(pixel, viewport);
  const double reach = std::max(radius, 0.0) * camera.units_per_pixel;
  const Bounds2 window{{point.x - reach, point.y - reach}, {point.x + reach, point.y + reach}};
  double nearest = reach * reach;
  bool on_top = false;
  for (std::size_t batch = 0; batch < 2; ++batch) {
    const Batch& elements = s.placement.layout().batches[batch];
    for (const DrawRange& range : s.placement.visible(batch, window)) {
      for (Index drawn = range.first; drawn < range.last; ++drawn) {
        const auto corners = elements.corners_of(drawn);
        for (const Index v : corners) {
          const Vec2<double> away = s.placement.points()[v] - point;
          const double square = dot(away, away);
          if (square < nearest || (square == nearest && v < result.vertex)) {
            nearest = square;
            result.vertex = v;
          }
        }
        if (!contains(corners, s.placement.points(), point)) continue;
        const Index element = elements.order[drawn];
        const bool inverted = !s.inverted.empty() && s.inverted[element] != 0;
        if (on_top && !inverted) continue;  // the later one covers the earlier one, but no inverted one
        result.element = element;
        on_top = inverted;
      }
    }
  }
  result.vertex_distance = std::sqrt(nearest) / camera.units_per_pixel;
  return result;
}

}  // namespace dmoscope::render
