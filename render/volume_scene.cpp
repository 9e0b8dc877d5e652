#include "render/volume_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/input/input_mesh.h"
#include "core/run/summary.h"
#include "render/element_painter.h"
#include "render/face_painter.h"
#include "render/framebuffer.h"
#include "render/occlusion.h"
#include "render/volume_pick.h"

namespace dmoscope::render {
namespace {

// Faces that can be looked through in a moment: once, and by a dozen rays.
constexpr std::size_t kMostFaces = 300'000, kMostFacesOfRays = 100'000;

FacePainter::Point point_of(Vec3 p) { return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}; }

}  // namespace

struct VolumeScene::Impl {
  /// Viewpoint from which a picture of the visible part of a mesh was taken, with that part's revision.
  struct SeenFrom {
    OrbitCamera camera;
    Vec2<double> viewport;
    std::uint64_t revision;
    friend bool operator==(const SeenFrom&, const SeenFrom&) = default;
  };
  FacePainter painter;
  OcclusionPainter occlusion;
  std::shared_ptr<const void> mesh_owner, state_owner;
  const ElementTable* elements = nullptr;
  std::unique_ptr<Clipping> inside;
  CellState state;
  ClippingView view;
  ClippedFaces nothing;
  std::vector<std::uint8_t> used;  // vertices that are corners of elements
  bool is_surface = false;
  Bounds3 bounds;
  Vec3 origin;  // middle of the bounds; positions on the OpenGL side are relative to it
  ThreadPool* pool = nullptr;
  std::uint64_t uploaded_faces = 0, uploaded_cuts = 0, updates = 0;
  std::uint64_t means_of = 0;  // number of the update whose means are uploaded
  std::vector<FacePainter::Point> points;
  std::vector<FaceRecord> records;

  [[nodiscard]] const ClippedFaces& seen() const noexcept { return inside ? inside->faces() : nothing; }
  [[nodiscard]] SeenFaces seen_faces() const { return {*elements, state.positions, seen(), view, inside->visible(), {}}; }
  [[nodiscard]] SeenFaces seen_vertices();
  [[nodiscard]] const DepthMap* depth_map(const SeenFrom& from);
  std::shared_ptr<const InputMesh> input;  // input of the frame on show
  std::uint64_t frame_serial = 0;          // serial of the frame on show; 0: none

  std::vector<std::uint8_t> corners_seen;  // vertices of visible cells; made when asked for
  std::uint64_t corners_seen_of = 0;       // revision of the faces that corners_seen belongs to
  struct ShownCell {
    SeenFrom from;
    Index cell;
    bool shown;
  };
  std::optional<ShownCell> shown_cell;  // the one that was asked for last
  std::optional<SeenFrom> depths_of;
  std::optional<DepthMap> depths;  // the one that was asked for last

  void forget();
  void upload_state();
  void upload_faces();
  void upload_means();
  void refresh() {
    inside->update(view, state, pool);
    upload_faces();
  }
  [[nodiscard]] Vec3 relative(Vec3 p) const { return p - origin; }
};

VolumeScene::VolumeScene() : Scene(60'000.0), impl_(std::make_unique<Impl>()) {}
VolumeScene::~VolumeScene() = default;

bool VolumeScene::show(std::shared_ptr<const Frame> frame, Loading /*loading*/) {
  Impl& s = *impl_;
  if (!frame) {
    s.forget();
    forget_look();
    return true;
  }
  if (frame->device) return false;
  if (s.input != frame->input) {
    const ClippingView wanted = s.view;
    set_mesh(frame->input->mesh.elements, frame->input->faces, frame->input);
    s.view = wanted;
    s.input = frame->input;
  }
  if (s.frame_serial != frame->serial) {
    s.frame_serial = frame->serial;
    update({frame->positions, frame->quality, frame->inverted, frame->serial}, frame);
  }
  return true;
}

void VolumeScene::set_mesh(const ElementTable& elements, const FaceNeighbours& faces, std::shared_ptr<const void> owner) {
  Impl& s = *impl_;
  s.forget();
  forget_look();
  s.inside = std::make_unique<Clipping>(elements, faces);
  s.elements = &elements;
  s.mesh_owner = std::move(owner);
  const auto corners = elements.all_corners();
  s.used.assign(corners.empty() ? 0 : std::size_t{std::ranges::max(corners)} + 1, 0);
  for (const Index v : corners) s.used[v] = 1;
  s.is_surface = elements.size() > 0 && info(elements.kind(0)).dimension == 2;
}

void VolumeScene::Impl::forget() {
  painter.reset();
  inside.reset();
  elements = nullptr;
  mesh_owner.reset();
  used.clear();
  state = {};
  state_owner.reset();
  input.reset();
  frame_serial = 0;
  view = {};
  bounds = {};
  uploaded_faces = uploaded_cuts = means_of = corners_seen_of = 0;
  depths_of.reset();
  depths.reset();
}

void VolumeScene::update(const CellState& state, std::shared_ptr<const void> owner) {
  Impl& s = *impl_;
  if (s.elements == nullptr) throw UsageError("there is no mesh to update");
  if (state.quality.size() != s.elements->size() || (!state.inverted.empty() && state.inverted.size() != s.elements->size())) {
    throw UsageError("as many qualities as the mesh has elements are needed");
  }
  if (state.positions.size() < s.used.size()) throw UsageError("as many positions as the mesh has vertices are needed");
  s.state = state;
  s.state.serial = ++s.updates;  // another state, whatever serial the caller counts
  s.state_owner = std::move(owner);
  s.upload_state();
  s.refresh();
  changed();
}

void VolumeScene::Impl::upload_state() {
  bounds = {};
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] != 0) bounds.include(state.positions[v]);
  }
  origin = bounds.empty() ? Vec3{} : bounds.centre();
  points.resize(state.positions.size());
  for_chunks(pool, points.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) points[v] = point_of(relative(state.positions[v]));
  });
  painter.upload_points(points);
  std::vector<float> shades(state.quality.size());
  for_chunks(pool, shades.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) shades[e] = shade_of(state.quality[e], !state.inverted.empty() && state.inverted[e] != 0);
  });
  painter.upload_shades(shades);
}

void VolumeScene::Impl::upload_means() {
  points.resize(elements->size());
  for_chunks(pool, points.size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) {
      Vec3 sum{};
      const auto corners = elements->corners(static_cast<Index>(e));
      for (const Index v : corners) sum = sum + relative(state.positions[v]);
      points[e] = point_of(1.0 / static_cast<double>(corners.size()) * sum);
    }
  });
  painter.upload_means(points);
}

void VolumeScene::Impl::upload_faces() {
  const ClippedFaces& faces = seen();
  if (std::exchange(uploaded_faces, faces.faces_revision) != faces.faces_revision) {
    records_of(*elements, faces.faces, records, pool);
    painter.upload_faces(records);
    records_of(*elements, faces.ghost, records, pool);
    painter.upload_ghost(records);
  }
  if (std::exchange(uploaded_cuts, faces.cuts_revision) != faces.cuts_revision) {
    records_of(faces.cuts, records);
    points.resize(faces.cuts.points.size());
    std::ranges::transform(faces.cuts.points, points.begin(), [&](const Vec3& p) { return point_of(relative(p)); });
    painter.upload_cuts(records, points);
  }
  if (view.shrink < 1.0 && std::exchange(means_of, updates) != updates) upload_means();
}

void VolumeScene::set_view(const ClippingView& view) {
  Impl& s = *impl_;
  if (s.view == view) return;
  if (s.state.serial > 0) s.inside->update(view, s.state, s.pool);
  s.view = view;
  if (s.state.serial > 0) s.upload_faces();
  changed();
}

Index VolumeScene::value_count(Shading::By by) const { return by == Shading::By::Elements ? impl_->elements->size() : kNoIndex; }
Fill& VolumeScene::fill() noexcept { return impl_->painter.fill(); }
const ElementTable* VolumeScene::elements() const { return impl_->elements; }
Index VolumeScene::vertex_count() const { return static_cast<Index>(impl_->state.positions.size()); }

std::vector<Vec3> VolumeScene::places_of(std::span<const Corner> corners) const {
  const SeenFaces seen = impl_->seen_faces();
  std::vector<Vec3> places(corners.size());
  std::ranges::transform(corners, places.begin(), [&](const Corner& corner) {
    return corner.element == kNoIndex ? seen.positions[corner.vertex] : drawn_corner(seen, corner.element, corner.vertex);
  });
  return places;
}

/// Visible faces, with the visible vertices.
SeenFaces VolumeScene::Impl::seen_vertices() {
  if (std::exchange(corners_seen_of, seen().faces_revision) != seen().faces_revision) {
    corners_seen.assign(state.positions.size(), 0);
    const auto visible = inside->visible();
    for_chunks(pool, elements->size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) {
        if (visible[e] == 0) continue;
        // Several threads may set the flag of the same vertex.
        for (const Index v : elements->corners(static_cast<Index>(e))) std::atomic_ref(corners_seen[v]).store(1, std::memory_order_relaxed);
      }
    });
  }
  SeenFaces faces = seen_faces();
  faces.vertices = corners_seen;
  return faces;
}

/// Map of the depths of a view; null if it would take too long.
const DepthMap* VolumeScene::Impl::depth_map(const SeenFrom& from) {
  if (elements == nullptr || bounds.empty() || seen().faces.size() > kMostFaces) return nullptr;
  if (depths_of != from) depths.emplace(seen_faces(), from.camera.projection(from.viewport, bounds));
  depths_of = from;
  return &*depths;
}

bool VolumeScene::sees_element(Index cell) const {
  return !impl_->inside || cell >= impl_->elements->size() || impl_->seen_faces().has_cell(cell);
}

bool VolumeScene::sees_vertex(Index vertex) const {
  return !impl_->inside || vertex >= impl_->state.positions.size() || impl_->seen_vertices().has_vertex(vertex);
}

bool VolumeScene::shows_element(const Camera& seen_from, Vec2<double> viewport, Index cell) const {
  const auto& camera = std::get<OrbitCamera>(seen_from);
  Impl& s = *impl_;
  if (!sees_element(cell)) return false;
  if (s.elements == nullptr || s.bounds.empty() || s.seen().faces.size() > kMostFacesOfRays) return true;
  const Impl::SeenFrom from{camera, viewport, revision()};
  if (!s.shown_cell || s.shown_cell->cell != cell || !(s.shown_cell->from == from))
    s.shown_cell = {from, cell, is_unhidden(s.seen_faces(), s.bounds, camera, viewport, cell)};
  return s.shown_cell->shown;
}

std::optional<Unhidden> VolumeScene::unhidden(const Camera& camera, Vec2<double> viewport) const {
  const DepthMap* depths = impl_->depth_map({std::get<OrbitCamera>(camera), viewport, revision()});
  if (depths == nullptr) return std::nullopt;
  return unhidden_of(impl_->seen_faces(), *depths);
}

void VolumeScene::visit_shown(const Camera& camera, Vec2<double> viewport, const VisitPolygon& visit) const {
  const DepthMap* depths = impl_->depth_map({std::get<OrbitCamera>(camera), viewport, revision()});
  if (depths == nullptr) return;
  const SeenFaces seen = impl_->seen_faces();
  const auto visit_seen = [&](Index cell, std::span<const Vec3> polygon) {
    if (depths->shows(point_on(polygon))) visit(cell, polygon);
  };
  for (const ElementFace& face : seen.faces.faces) {
    const DrawnFace drawn = drawn_face(seen, face);
    if (std::ranges::none_of(drawn.corners(), [&](Vec3 p) { return cut_away(seen, p); })) visit_seen(face.element, drawn.corners());
  }
  const PlaneCuts& cuts = seen.faces.cuts;
  for (const CutPolygon& polygon : cuts.polygons) visit_seen(polygon.element, std::span(cuts.points).subspan(polygon.first, polygon.count));
}

void VolumeScene::set_pool(ThreadPool* pool) noexcept { impl_->pool = pool; }
bool VolumeScene::empty() const noexcept { return impl_->elements == nullptr; }
const ClippedFaces& VolumeScene::faces() const noexcept { return impl_->seen(); }
const Bounds3& VolumeScene::bounds() const noexcept { return impl_->bounds; }

void VolumeScene::fit(OrbitCamera& camera, Vec2<double> viewport, const PicturePart& room) const {
  const Impl& s = *impl_;
  const auto positions = s.state.positions.first(std::min(s.used.size(), s.state.positions.size()));
  if (std::ranges::find(s.used, 0) == s.used.end()) return camera.fit(positions, viewport, room);
  std::vector<Vec3> points;
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (s.used[v] != 0) points.push_back(positions[v]);
  camera.fit(points, viewport, room);
}

int VolumeScene::reach(const Style& style, Vec2<double> viewport) const {
  return style.occlusion && !empty() && !impl_->bounds.empty() ? OcclusionPainter::reach(viewport, style) + 2 : 0;
}

SceneView VolumeScene::view_of(const Camera& camera, Vec2<double> viewport, const PicturePart& part) const {
  const auto& orbit = std::get<OrbitCamera>(camera);
  return {orbit, orbit.projection(viewport, impl_->bounds, part)};
}

class VolumeScene::VolumePass final : public Pass {
 public:
  VolumePass(const Impl& scene, const OrbitCamera& camera, const Style& style, Vec2<double> viewport, const PicturePart& part)
      : scene_(scene),
        style_(style),
        whole_(viewport),
        pixel_(camera.height / std::max(1.0, viewport.y)),
        projection_(camera.projection(viewport, scene.bounds, part)),
        view_(camera, projection_),
        look_{.style = style, .shrink = scene.view.shrink, .both_sides = scene.is_surface, .plane = {}} {
    // The stripes stand still in the picture, so that its parts fit together.
    const double period = static_cast<double>(kHatchPeriod * style.scale);
    const Vec2<double> middle{0.5 * (part.low.x + part.high.x - viewport.x), -0.5 * (part.low.y + part.high.y - viewport.y)};
    const auto phase = [&](double along) { return static_cast<float>(std::fmod(along / period, 1.0)); };
    view_.hatch_phase = {phase(middle.x - middle.y), phase(middle.x + middle.y)};
    const ClipPlane& clip = scene.view.clip;
    if (!clip.on || clip.mode != ClipPlane::Mode::Cut) return;
    const double side = (clip.flip ? -1.0 : 1.0) / length(clip.normal), slack = 1e-6 * scene.bounds.radius();  // faces in the plane stay
    const Vec3 normal = side * clip.normal;
    look_.plane = std::array{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z),
                             static_cast<float>(side * clip.offset - dot(normal, projection_.origin()) + slack)};
  }

  [[nodiscard]] Index count() const override { return scene_.painter.face_count(); }
  void begin() override { scene_.painter.draw_ghost(view_, style_); }
  void draw(Index first, Index count) override { scene_.painter.draw_faces(view_, look_, first, count); }
  void draw_coarse(Index stride) override { scene_.painter.draw_coarse(view_, look_, stride); }
  /// Darkens corners if wanted and if depths tell the places of pixels apart.
  void end(Framebuffer& target, bool whole) override {
    constexpr double kDepths = 16'777'216.0, kStepsAPixel = 16.0;  // depth buffer of 24 bits
    scene_.painter.draw_cuts(view_, style_);
    if (whole && style_.occlusion && pixel_ * kDepths > kStepsAPixel * 2.0 * scene_.bounds.radius())
      scene_.occlusion.darken(target, projection_, OcclusionPainter::reach(whole_, style_), style_);
  }

 private:
  const Impl& scene_;
  const Style& style_;
  Vec2<double> whole_;  // size of the whole picture, in pixels
  double pixel_;        // size of a pixel, in units
  Projection projection_;
  SpaceView view_;
  FacePainter::Look look_;
};

std::unique_ptr<Scene::Pass> VolumeScene::pass(const Camera& camera, const Style& style, Vec2<double> viewport, const PicturePart& part) {
  if (empty() || impl_->bounds.empty()) return nullptr;
  return std::make_unique<VolumePass>(*impl_, std::get<OrbitCamera>(camera), style, viewport, part);
}

Pick VolumeScene::pick(const Camera& seen_from, Vec2<double> viewport, Vec2<double> pixel, double radius) const {
  const OrbitCamera& camera = std::get<OrbitCamera>(seen_from);
  const Impl& s = *impl_;
  if (s.elements == nullptr || s.bounds.empty()) return {};
  return render::pick(s.seen_faces(), s.bounds, camera, viewport, pixel, radius);
}

std::optional<Vec3> VolumeScene::point_at(const OrbitCamera& camera, Vec2<double> viewport, Vec2<double> pixel) const {
  const Impl& s = *impl_;
  if (s.elements == nullptr || s.bounds.empty()) return std::nullopt;
  const ViewRay ray = camera.ray(pixel, viewport);
  const auto hit = first_hit(s.seen_faces(), ray);
  if (!hit) return std::nullopt;
  return ray.from + hit->along * ray.direction;
}

}  // namespace dmoscope::render
