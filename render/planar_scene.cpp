#include "render/planar_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "render/framebuffer.h"
#include "render/mark_painter.h"
#include "render/planar_scene_impl.h"

namespace dmoscope::render {
namespace {

constexpr std::size_t kBigMesh = 100'000;  // elements; the layout of larger meshes takes long enough to be built in the background

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

/// Whether the layout of the frame's mesh is on the OpenGL side now.
bool PlanarScene::Impl::prepare(const Frame& wanted, Loading loading) {
  if (has_input && input_serial == wanted.input_serial && !placement.empty()) return true;
  const bool background = loading == Loading::Background && wanted.input->mesh.elements.size() > kBigMesh;
  if (!pending.valid() || pending_serial != wanted.input_serial) {
    if (pending.valid()) {
      // Only one layout is built at a time: the earlier one must end first, because it cannot be stopped.
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
  if (std::exchange(s.is_new, false)) forget_look();
  if (!ready) {
    s.device.clear();
    s.source = Source::Host;
    s.placement_current = true;
    s.placement = Placement();
    s.has_input = false;
    s.frame.reset();
    changed();
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
    changed();
  }
  s.frame = std::move(frame);
  return true;
}

void PlanarScene::draw_through_host(std::string why) { impl_->device.never_direct(std::move(why)); }

void PlanarScene::set_mesh(const Mesh& mesh, const Plane& plane) {
  auto layout = build_layout(std::make_shared<const Mesh>(mesh), plane);
  impl_->adopt(std::move(layout));
  impl_->is_new = false;
  forget_look();
  impl_->frame.reset();
  impl_->has_input = false;
}

void PlanarScene::update(std::span<const Vec3> positions, std::span<const float> quality, std::span<const std::uint8_t> inverted) {
  if (impl_->placement.empty()) throw UsageError("there is no mesh to update");
  impl_->upload(positions, quality, inverted);
  changed();
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

/// Whether these positions are on show: another metric changes only colours.
bool PlanarScene::Impl::stands_at(const Frame& wanted) const {
  return source == Source::Host && placement_current && frame && !frame->device && frame->input_serial == wanted.input_serial &&
         !wanted.positions.empty() && same_bits(frame->positions, wanted.positions);
}

/// Uploads piece by piece: memory for all points would be asked of the system and given back with every frame.
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
}

void PlanarScene::Impl::show_device(const Frame& light) {
  if (placement.bounds().empty()) placement.move(light.input->mesh.positions);  // positions to fit the view to
  placement_current = false;
  elements.mark_inverted(placement.layout(), {});
  const bool shown = device.show(light.device, elements, placement.layout());
  source = !shown ? Source::Unreachable : device.direct() ? Source::Device : Source::HostCopy;
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

/// Ranges of elements to draw; all of them while positions are not known on the host.
std::vector<DrawRange> PlanarScene::Impl::visible(std::size_t batch, const Bounds2& window) const {
  if (placement_current) return placement.visible(batch, window);
  const Index all = placement.layout().batches[batch].size();
  return all == 0 ? std::vector<DrawRange>{} : std::vector<DrawRange>{{0, all}};
}

void PlanarScene::set_fixed(std::span<const std::uint8_t> fixed) {
  impl_->fixed.assign(fixed.begin(), fixed.end());
  changed();
}

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

bool PlanarScene::Impl::is_known() {
  if (placement.empty() || source == Source::Unreachable) return false;
  try {
    place_all();
  } catch (const DeviceError&) {  // the next frame finds out what is wrong
    return false;
  }
  return true;
}

Index PlanarScene::value_count(Shading::By by) const {
  return by == Shading::By::Elements ? element_count() : impl_->placement.layout().vertex_count;
}

Fill& PlanarScene::fill() noexcept { return impl_->elements.fill(); }

bool PlanarScene::hides(Index element) const {
  const Selection& wanted = selection();
  if (wanted.others != Selection::Others::Hide) return false;
  if (wanted.members && (*wanted.members)[element] == 0) return true;
  return wanted.quality && element < impl_->shades.size() && !in_quality_range(*wanted.quality, impl_->shades[element]);
}

class PlanarScene::PlanarPass final : public Pass {
 public:
  PlanarPass(PlanarScene& scene, const Camera2D& camera, const Style& style, Vec2<double> viewport)
      : scene_(scene),
        elements_(scene.impl_->elements),
        style_(style),
        camera_(camera),
        viewport_(viewport),
        view_(make_view(scene.impl_->placement.layout(), camera, viewport, style.scale)),
        window_(camera.visible(viewport)),
        seen_(scene.impl_->in_view(window_)) {}

  [[nodiscard]] Index count() const override { return seen_.count; }
  void draw(Index first, Index count) override {
    for (std::size_t batch = 0; batch < 2; ++batch) {
      std::vector<DrawRange> slice;
      for (const DrawRange& range : seen_.ranges[batch]) {
        const Index passed = std::min(first, range.last - range.first), begin = range.first + passed;
        const Index taken = std::min(count, range.last - begin);
        first -= passed;
        count -= taken;
        if (taken > 0) slice.push_back({begin, begin + taken});
      }
      elements_.draw(view_, style_, batch, slice);
    }
  }
  /// Draws squares for groups of elements; a group with an inverted element shows it.
  void draw_coarse(Index stride) override {
    for (std::size_t batch = 0; batch < 2; ++batch) elements_.draw_coarse(view_, style_, batch, seen_.ranges[batch], stride);
  }
  void end(Framebuffer& /*target*/, bool whole) override {
    begin_marks();
    if (style_.boundary) elements_.draw_boundary(view_, style_);
    if (style_.vertices && whole) scene_.gather_vertices({camera_, viewport_}, style_, window_);
    scene_.painter().flush(view_, style_.scale);
  }

 private:
  PlanarScene& scene_;
  ElementPainter& elements_;
  const Style& style_;
  Camera2D camera_;
  Vec2<double> viewport_;
  View view_;
  Bounds2 window_;
  Impl::InView seen_;
};

namespace {

/// The camera whose whole picture is a part of this one's.
Camera2D camera_of(const Camera& camera, Vec2<double> viewport, const PicturePart& part) {
  Camera2D of_part = std::get<Camera2D>(camera);
  of_part.centre = of_part.to_plane({(part.low.x + part.high.x) / 2.0, (part.low.y + part.high.y) / 2.0}, viewport);
  return of_part;
}

}  // namespace

std::unique_ptr<Scene::Pass> PlanarScene::pass(const Camera& camera, const Style& style, Vec2<double> viewport, const PicturePart& part) {
  if (empty() || impl_->source == Source::Unreachable) return nullptr;
  return std::make_unique<PlanarPass>(*this, camera_of(camera, viewport, part), style, part.high - part.low);
}

SceneView PlanarScene::view_of(const Camera& camera, Vec2<double> viewport, const PicturePart& part) const {
  return {camera_of(camera, viewport, part), part.high - part.low};
}

}  // namespace dmoscope::render
