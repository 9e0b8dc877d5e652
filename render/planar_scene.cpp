#include "render/planar_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "render/draw_state.h"
#include "render/planar_scene_impl.h"

namespace dmoscope::render {
namespace {

constexpr std::size_t kBigMesh = 100'000;  // elements whose layout takes long enough to be built in the background

View make_view(const Layout& layout, const Camera2D& camera, Vec2<double> viewport, float scale) {
  View view;
  const Vec2<double> offset = camera.centre - layout.origin;
  view.offset_high = {static_cast<float>(offset.x), static_cast<float>(offset.y)};
  view.offset_low = {static_cast<float>(offset.x - static_cast<double>(view.offset_high.x)),
                     static_cast<float>(offset.y - static_cast<double>(view.offset_high.y))};
  view.zoom = static_cast<float>(1.0 / camera.units_per_pixel);
  view.viewport = {static_cast<float>(viewport.x), static_cast<float>(viewport.y)};
  view.widest = static_cast<float>(std::min(layout.widest() / camera.units_per_pixel, 1e30));
  // The stripes move with the mesh, so that tiles of a picture fit together.
  const double period = camera.units_per_pixel * static_cast<double>(kHatchPeriod * scale);
  const auto phase = [&](double along) { return static_cast<float>(along / period - std::floor(along / period)); };
  view.hatch_phase = {phase(offset.x - offset.y), phase(offset.x + offset.y)};
  return view;
}

}  // namespace

PlanarScene::PlanarScene() : Scene(75'000.0), impl_(std::make_unique<Impl>()) {}
PlanarScene::~PlanarScene() = default;
PlanarScene::PlanarScene(PlanarScene&&) noexcept = default;
PlanarScene& PlanarScene::operator=(PlanarScene&&) noexcept = default;

/// Whether the layout of the frame's mesh is on the OpenGL side now.
bool PlanarScene::Impl::prepare(const Frame& wanted, Loading loading) {
  if (has_input && input_serial == wanted.input_serial && !placement.empty()) return true;
  const bool background = loading == Loading::Background && wanted.input->mesh.elements.size() > kBigMesh;
  if (!pending.valid() || pending_serial != wanted.input_serial) {
    if (pending.valid()) {
      // One at a time: the earlier one must end first, for it cannot be stopped.
      if (background && pending.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
      pending.wait();
    }
    pending_serial = wanted.input_serial;
    pending = std::async(background ? std::launch::async : std::launch::deferred, [input = wanted.input] {
      return build_layout({input, &input->mesh}, input->geometry.plane, input->topology.boundary());
    });
  }
  if (background && pending.wait_for(std::chrono::seconds(0)) == std::future_status::timeout) return false;
  adopt(pending.get());
  input_serial = wanted.input_serial;
  has_input = true;
  return true;
}

bool PlanarScene::show(std::shared_ptr<const Frame> frame, Loading loading) {
  Impl& s = *impl_;
  const bool ready = frame && s.prepare(*frame, loading);
  if (!ready) {
    s.device.clear();
    s.source = Source::Host;
    s.placement_current = true;
    s.placement = Placement();
    s.has_input = false;
    s.frame.reset();
    ++s.revision;
    return !frame;
  }
  if (!s.frame || s.frame->serial != frame->serial || s.frame->input_serial != frame->input_serial) {
    if (frame->device) {
      s.show_device(*frame);
    } else if (s.stands_at(*frame)) {
      s.upload_shades(frame->quality, frame->inverted);
    } else {
      s.upload(frame->positions, frame->quality, frame->inverted);
    }
  }
  s.frame = std::move(frame);
  return true;
}

void PlanarScene::draw_through_host(std::string why) { impl_->device.never_direct(std::move(why)); }

void PlanarScene::set_mesh(const Mesh& mesh, const Plane& plane) {
  auto layout = build_layout(std::make_shared<const Mesh>(mesh), plane);
  impl_->adopt(std::move(layout));
  impl_->frame.reset();
  impl_->has_input = false;
}

void PlanarScene::update(std::span<const Vec3> positions, std::span<const float> quality, std::span<const std::uint8_t> inverted) {
  if (impl_->placement.empty()) throw UsageError("there is no mesh to update");
  impl_->upload(positions, quality, inverted);
}

void PlanarScene::Impl::upload(std::span<const Vec3> positions, std::span<const float> quality,
                               std::span<const std::uint8_t> inverted_flags) {
  const Index count = placement.layout().element_count();
  if (quality.size() != count || (!inverted_flags.empty() && inverted_flags.size() != count)) {
    throw UsageError("as many qualities as the mesh has elements are needed");
  }
  device.clear();
  source = Source::Host;
  placement_current = true;
  upload_points(positions);
  upload_shades(quality, inverted_flags);
}

/// Whether these positions are on show: another metric changes colours alone.
bool PlanarScene::Impl::stands_at(const Frame& wanted) const {
  return source == Source::Host && placement_current && frame && !frame->device && frame->input_serial == wanted.input_serial &&
         !wanted.positions.empty() && same_bits(frame->positions, wanted.positions);
}

/// Piece by piece: memory for all of it would be asked of the system and given back with every frame.
void PlanarScene::Impl::upload_points(std::span<const Vec3> positions) {
  constexpr std::size_t kPiece = std::size_t{1} << 14U;
  placement.move(positions);
  const Vec2<double> origin = placement.layout().origin;
  const auto points = placement.points();
  std::vector<Vec2<float>> relative(std::min(kPiece, points.size()));
  for (std::size_t first = 0; first < points.size(); first += kPiece) {
    const auto piece = points.subspan(first, std::min(kPiece, points.size() - first));
    std::transform(piece.begin(), piece.end(), relative.begin(), [&](const Vec2<double>& p) {
      return Vec2<float>{static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y)};
    });
    elements.upload_points(static_cast<Index>(first), std::span<const Vec2<float>>(relative).first(piece.size()));
  }
}

void PlanarScene::Impl::upload_shades(std::span<const float> quality, std::span<const std::uint8_t> inverted_flags) {
  const Index count = placement.layout().element_count();
  shades.resize(count);
  for (Index e = 0; e < count; ++e) shades[e] = shade_of(quality[e], !inverted_flags.empty() && inverted_flags[e] != 0);
  elements.upload_shades(shades);
  elements.mark_inverted(placement.layout(), shades);
  ++revision;
}

void PlanarScene::Impl::show_device(const Frame& light) {
  if (placement.bounds().empty()) placement.move(light.input->mesh.positions);  // something to fit the view to
  placement_current = false;
  elements.mark_inverted(placement.layout(), {});
  const bool shown = device.show(light.device, elements, placement.layout());
  source = !shown ? Source::Unreachable : device.direct() ? Source::Device : Source::HostCopy;
  ++revision;
}

void PlanarScene::Impl::place_all() {
  if (placement_current) return;
  const DeviceFeed::HostCopy& copy = device.host_copy(placement.layout());
  placement.move(copy.points);
  shades = copy.shades;
  placement_current = true;
}

std::vector<Vec2<double>> PlanarScene::Impl::points_of(std::span<const Index> vertices) const {
  std::vector<Vec2<double>> points;
  points.reserve(vertices.size());
  if (placement_current) {
    for (const Index v : vertices) points.push_back(placement.points()[v]);
  } else if (!vertices.empty()) {
    for (const Vec3& position : device.positions(vertices)) points.push_back(placement.layout().plane.place(position));
  }
  return points;
}

/// Everything while nobody here knows where the elements are.
std::vector<DrawRange> PlanarScene::Impl::visible(std::size_t batch, const Bounds2& window) const {
  if (placement_current) return placement.visible(batch, window);
  const Index all = placement.layout().batches[batch].size();
  return all == 0 ? std::vector<DrawRange>{} : std::vector<DrawRange>{{0, all}};
}

void PlanarScene::set_fixed(std::span<const std::uint8_t> fixed) {
  impl_->fixed.assign(fixed.begin(), fixed.end());
  ++impl_->revision;
}

void PlanarScene::set_shading(std::shared_ptr<const Shading> shading) {
  Impl& s = *impl_;
  if (s.shading == shading) return;
  if (shading) {
    const Index wanted = shading->by == Shading::By::Elements ? element_count() : s.placement.layout().vertex_count;
    if (s.placement.empty() || shading->values.size() != wanted)
      throw UsageError("as many values as the mesh has elements or vertices are needed");
  }
  s.elements.set_shading(shading.get());
  s.shading = std::move(shading);
  ++s.revision;
}

void PlanarScene::set_selection(const Selection& selection) {
  Impl& s = *impl_;
  if (s.selection == selection) return;
  if (selection.members && selection.members->size() != element_count()) {
    throw UsageError("as many members as the mesh has elements are needed");
  }
  s.elements.set_selection(selection);
  s.selection = selection;
  ++s.revision;
}

std::uint64_t PlanarScene::revision() const noexcept { return impl_->revision; }

bool PlanarScene::empty() const noexcept { return impl_->placement.empty() || impl_->placement.layout().element_count() == 0; }
Index PlanarScene::element_count() const noexcept { return impl_->placement.empty() ? 0 : impl_->placement.layout().element_count(); }
const Bounds2& PlanarScene::bounds() const noexcept { return impl_->placement.bounds(); }
Source PlanarScene::source() const noexcept { return impl_->source; }
const std::string& PlanarScene::device_trouble() const noexcept { return impl_->device.trouble(); }

PlanarScene::Impl::InView PlanarScene::Impl::in_view(const Bounds2& window) const {
  InView seen{{visible(0, window), visible(1, window)}, 0};
  for (const auto& list : seen.ranges) {
    for (const DrawRange& range : list) seen.count += range.last - range.first;
  }
  return seen;
}

void PlanarScene::draw(Framebuffer& target, const Camera2D& camera, const Style& style, const Marks& marks, double detail) {
  draw_elements(target, camera, style, detail);
  draw_marks(target, camera, style, marks);
}

bool PlanarScene::draw_elements(Framebuffer& target, const Camera& seen_from, const Style& style, double detail) {
  const Camera2D& camera = std::get<Camera2D>(seen_from);
  const TargetGuard guard;
  clear(target, style);
  Impl& s = *impl_;
  if (empty() || s.source == Source::Unreachable) return true;
  const Vec2<double> viewport = size_of(target);
  const View view = make_view(s.placement.layout(), camera, viewport, style.scale);
  const Bounds2 window = camera.visible(viewport);
  const Impl::InView seen = s.in_view(window);
  const double budget = std::max(1.0, std::clamp(detail, 0.0, 1.0) * element_count());
  const auto stride = static_cast<Index>(std::ceil(seen.count / budget - 1e-9));
  s.elements.set_colours(style.colours);
  begin_elements();
  for (std::size_t batch = 0; batch < 2; ++batch) {
    if (stride > 1) {
      s.elements.draw_coarse(view, style, batch, seen.ranges[batch], stride);
    } else {
      s.elements.draw(view, style, batch, seen.ranges[batch]);
    }
  }
  s.draw_over(view, camera, style, stride <= 1 ? &window : nullptr);
  return stride <= 1;
}

bool PlanarScene::draw_slice(Framebuffer& target, const Camera& seen_from, const Style& style, SliceProgress& progress, Index most) {
  const Camera2D& camera = std::get<Camera2D>(seen_from);
  const TargetGuard guard;
  if (!std::exchange(progress.begun, true)) clear(target, style);
  target.bind();
  Impl& s = *impl_;
  if (empty() || s.source == Source::Unreachable) return true;
  const Vec2<double> viewport = size_of(target);
  const View view = make_view(s.placement.layout(), camera, viewport, style.scale);
  const Bounds2 window = camera.visible(viewport);
  const Impl::InView seen = s.in_view(window);
  s.elements.set_colours(style.colours);
  begin_elements();
  Index before = progress.drawn, rest = std::max<Index>(1, most);  // to pass over; to draw
  for (std::size_t batch = 0; batch < 2; ++batch) {
    std::vector<DrawRange> slice;
    for (const DrawRange& range : seen.ranges[batch]) {
      const Index passed = std::min(before, range.last - range.first), first = range.first + passed;
      const Index taken = std::min(rest, range.last - first);
      before -= passed;
      rest -= taken;
      progress.drawn += taken;
      if (taken > 0) slice.push_back({first, first + taken});
    }
    s.elements.draw(view, style, batch, slice);
  }
  const bool last = progress.drawn >= seen.count;
  if (last) s.draw_over(view, camera, style, &window);
  glFinish();
  return last;
}

void PlanarScene::Impl::draw_over(const View& view, const Camera2D& camera, const Style& style, const Bounds2* vertices_of) {
  begin_marks();
  if (style.boundary) elements.draw_boundary(view, style);
  if (style.vertices && vertices_of != nullptr) gather_vertices(camera, style, *vertices_of);
  marks.flush(view, style.scale);
}

void PlanarScene::draw_part(Framebuffer& target, const Camera& camera, const Style& style, const SceneMarks& marks, Vec2<double> viewport,
                            const PicturePart& part) {
  Camera2D of_part = std::get<Camera2D>(camera);
  of_part.centre = of_part.to_plane({(part.low.x + part.high.x) / 2.0, (part.low.y + part.high.y) / 2.0}, viewport);
  draw(target, of_part, style, std::get<Marks>(marks));
}

void PlanarScene::draw_marks(Framebuffer& target, const Camera& seen_from, const Style& style, const SceneMarks& marks) {
  const Camera2D& camera = std::get<Camera2D>(seen_from);
  const TargetGuard guard;
  target.bind();
  Impl& s = *impl_;
  const Layout nothing;
  const View view = make_view(s.placement.empty() ? nothing : s.placement.layout(), camera, size_of(target), style.scale);
  s.gather_marks(camera, style, std::get<Marks>(marks));
  begin_marks();
  s.marks.flush(view, style.scale);
}

}  // namespace dmoscope::render
