#include "render/volume_scene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "core/base/error.h"
#include "core/input/input_mesh.h"
#include "core/run/summary.h"
#include "render/depth_map.h"
#include "render/draw_state.h"
#include "render/face_painter.h"
#include "render/occlusion.h"
#include "render/volume_labels.h"
#include "render/volume_marks.h"
#include "render/volume_pick.h"

namespace dmoscope::render {
namespace {

// Looked through in a moment: once, and by a dozen rays.
constexpr std::size_t kMostFaces = 300'000, kMostFacesOfRays = 100'000;

FacePainter::Point point_of(Vec3 p) { return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)}; }

}  // namespace

struct VolumeScene::Impl {
  FacePainter painter;
  OcclusionPainter occlusion;
  std::optional<Framebuffer> wider;  // than a part of a picture, as far as occlusion looks around
  MarkPainter marks;
  std::shared_ptr<const void> mesh_owner, state_owner;
  const ElementTable* elements = nullptr;
  std::unique_ptr<Clipping> inside;
  CellState state;
  ClippingView view;
  Selection selection;
  std::shared_ptr<const Shading> shading;
  ClippedFaces nothing;
  std::vector<std::uint8_t> used;  // vertices that are corners of elements
  bool is_surface = false;
  Bounds3 bounds;
  Vec3 origin;  // positions on the OpenGL side are relative to it: the middle of the bounds
  ThreadPool* pool = nullptr;
  std::uint64_t revision = 0, uploaded_faces = 0, uploaded_cuts = 0, updates = 0;
  std::uint64_t means_of = 0;  // the update whose means are uploaded
  std::vector<FacePainter::Point> points;
  std::vector<FaceRecord> records;

  [[nodiscard]] const ClippedFaces& seen() const noexcept { return inside ? inside->faces() : nothing; }
  [[nodiscard]] SeenFaces seen_faces() const { return {*elements, state.positions, seen(), view, inside->visible(), {}}; }
  [[nodiscard]] SeenFaces seen_vertices();
  [[nodiscard]] const DepthMap* depth_map(const OrbitCamera& camera, Vec2<double> viewport);
  std::shared_ptr<const InputMesh> input;  // of the frame on show
  std::uint64_t frame_serial = 0;          // likewise; 0: none

  std::vector<std::uint8_t> corners_seen;  // vertices of cells that are seen; made when it is asked for
  std::uint64_t corners_seen_of = 0;       // the faces' revision that it is of
  struct SeenFrom {
    OrbitCamera camera;
    Vec2<double> viewport;
    std::uint64_t revision;
    friend bool operator==(const SeenFrom& a, const SeenFrom& b) {
      return a.camera == b.camera && a.viewport.x == b.viewport.x && a.viewport.y == b.viewport.y && a.revision == b.revision;
    }
  };
  struct ShownCell {
    SeenFrom from;
    Index cell;
    bool shown;
  };
  std::optional<ShownCell> shown_cell;  // that was asked for last
  std::optional<SeenFrom> depths_of;
  std::optional<DepthMap> depths;  // likewise

  void forget();
  void upload_state();
  void upload_faces();
  void upload_means();
  void refresh() {
    inside->update(view, state, pool);
    upload_faces();
    ++revision;
  }
  [[nodiscard]] Vec3 relative(Vec3 p) const { return p - origin; }
  struct Stage;
  void draw_whole(const Stage& stage);
  void darken(Framebuffer& target, const Stage& stage, int reach) const;
  void draw_marks(const Stage& stage, const SpaceMarks& wanted);
};

VolumeScene::VolumeScene() : Scene(60'000.0), impl_(std::make_unique<Impl>()) {}
VolumeScene::~VolumeScene() = default;
VolumeScene::VolumeScene(VolumeScene&&) noexcept = default;
VolumeScene& VolumeScene::operator=(VolumeScene&&) noexcept = default;

bool VolumeScene::show(std::shared_ptr<const Frame> frame, Loading /*loading*/) {
  Impl& s = *impl_;
  if (!frame) {
    s.forget();
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
  selection = {};
  shading.reset();
  bounds = {};
  uploaded_faces = uploaded_cuts = means_of = corners_seen_of = 0;
  depths_of.reset();
  depths.reset();
  ++revision;
}

void VolumeScene::update(const CellState& state, std::shared_ptr<const void> owner) {
  Impl& s = *impl_;
  if (s.elements == nullptr) throw UsageError("there is no mesh to update");
  if (state.quality.size() != s.elements->size() || (!state.inverted.empty() && state.inverted.size() != s.elements->size())) {
    throw UsageError("as many qualities as the mesh has elements are needed");
  }
  if (state.positions.size() < s.used.size()) throw UsageError("as many positions as the mesh has vertices are needed");
  s.state = state;
  s.state.serial = ++s.updates;  // whatever the caller counts, it is another state
  s.state_owner = std::move(owner);
  s.upload_state();
  s.refresh();
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
  ++s.revision;
}

const ClippingView& VolumeScene::view() const noexcept { return impl_->view; }

void VolumeScene::set_shading(std::shared_ptr<const Shading> shading) {
  Impl& s = *impl_;
  if (shading && (s.elements == nullptr || shading->by != Shading::By::Elements || shading->values.size() != s.elements->size())) {
    throw UsageError("as many values as the mesh has elements are needed");
  }
  if (shading == s.shading) return;  // nothing new: a picture that is refined goes on
  s.painter.fill().set_shading(shading.get());
  s.shading = std::move(shading);
  ++s.revision;
}

void VolumeScene::set_selection(const Selection& selection) {
  Impl& s = *impl_;
  if (s.selection == selection) return;
  if (selection.members && (s.elements == nullptr || selection.members->size() != s.elements->size())) {
    throw UsageError("as many members as the mesh has elements are needed");
  }
  s.painter.fill().set_selection(selection);
  s.selection = selection;
  ++s.revision;
}

/// With the vertices that are seen.
SeenFaces VolumeScene::Impl::seen_vertices() {
  if (std::exchange(corners_seen_of, seen().faces_revision) != seen().faces_revision) {
    corners_seen.assign(state.positions.size(), 0);
    const auto visible = inside->visible();
    for_chunks(pool, elements->size(), CellChunk::kCells, [&](std::size_t first, std::size_t last) {
      for (std::size_t e = first; e < last; ++e) {
        if (visible[e] == 0) continue;
        // Several threads may say so of the same vertex.
        for (const Index v : elements->corners(static_cast<Index>(e))) std::atomic_ref(corners_seen[v]).store(1, std::memory_order_relaxed);
      }
    });
  }
  SeenFaces faces = seen_faces();
  faces.vertices = corners_seen;
  return faces;
}

/// Null where it would take too long.
const DepthMap* VolumeScene::Impl::depth_map(const OrbitCamera& camera, Vec2<double> viewport) {
  if (elements == nullptr || bounds.empty() || seen().faces.size() > kMostFaces) return nullptr;
  const SeenFrom from{camera, viewport, revision};
  if (depths_of != from) depths.emplace(seen_faces(), camera.projection(viewport, bounds));
  depths_of = from;
  return &*depths;
}

bool VolumeScene::sees_cell(Index cell) const {
  return !impl_->inside || cell >= impl_->elements->size() || impl_->seen_faces().has_cell(cell);
}

bool VolumeScene::sees_vertex(Index vertex) const {
  return !impl_->inside || vertex >= impl_->state.positions.size() || impl_->seen_vertices().has_vertex(vertex);
}

bool VolumeScene::shows_cell(const OrbitCamera& camera, Vec2<double> viewport, Index cell) const {
  Impl& s = *impl_;
  if (!sees_cell(cell)) return false;
  if (s.elements == nullptr || s.bounds.empty() || s.seen().faces.size() > kMostFacesOfRays) return true;
  const Impl::SeenFrom from{camera, viewport, s.revision};
  if (!s.shown_cell || s.shown_cell->cell != cell || !(s.shown_cell->from == from))
    s.shown_cell = {from, cell, is_unhidden(s.seen_faces(), s.bounds, camera, viewport, cell)};
  return s.shown_cell->shown;
}

std::optional<Unhidden> VolumeScene::unhidden(const OrbitCamera& camera, Vec2<double> viewport) const {
  const DepthMap* depths = impl_->depth_map(camera, viewport);
  if (depths == nullptr) return std::nullopt;
  return unhidden_of(impl_->seen_faces(), *depths);
}

std::vector<Label> VolumeScene::labels(const Camera& seen_from, Vec2<double> viewport, const LabelWish& wish) const {
  const OrbitCamera& camera = std::get<OrbitCamera>(seen_from);
  if (!(wish.vertices || wish.elements)) return {};
  const DepthMap* depths = impl_->depth_map(camera, viewport);
  return depths == nullptr ? std::vector<Label>{} : labels_of(impl_->seen_faces(), *depths, wish);
}

void VolumeScene::set_pool(ThreadPool* pool) noexcept { impl_->pool = pool; }
bool VolumeScene::empty() const noexcept { return impl_->elements == nullptr; }
std::uint64_t VolumeScene::revision() const noexcept { return impl_->revision; }
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

namespace {

/// The part that is the whole of a target.
PicturePart all_of(Vec2<double> viewport) { return {{0, 0}, viewport}; }

}  // namespace

/// Everything a picture, or a part of one, is drawn with.
struct VolumeScene::Impl::Stage {
  Stage(const Impl& scene, const OrbitCamera& seen_by, const Style& in_style, Vec2<double> viewport, const PicturePart& part);
  const OrbitCamera& camera;
  const Style& style;
  Projection projection;
  SpaceView view;
  FacePainter::Look look;
  Vec2<double> triad;  // middle of the axes, pixels from the middle of the part
  Vec2<double> whole;  // pixels of the picture that it may be a part of
};

VolumeScene::Impl::Stage::Stage(const Impl& scene, const OrbitCamera& seen_by, const Style& in_style, Vec2<double> viewport,
                                const PicturePart& part)
    : camera(seen_by),
      style(in_style),
      projection(camera.projection(viewport, scene.bounds, part)),
      view(camera, projection),
      look{.style = style, .shrink = scene.view.shrink, .both_sides = scene.is_surface, .plane = {}},
      whole(viewport) {
  // The stripes stand still in the picture, so that its parts fit together.
  const double period = static_cast<double>(kHatchPeriod * style.scale), margin = kTriadMargin * static_cast<double>(style.scale);
  const Vec2<double> middle{0.5 * (part.low.x + part.high.x - viewport.x), -0.5 * (part.low.y + part.high.y - viewport.y)};
  const auto phase = [&](double along) { return static_cast<float>(std::fmod(along / period, 1.0)); };
  view.hatch_phase = {phase(middle.x - middle.y), phase(middle.x + middle.y)};
  triad = {0.5 * viewport.x - margin - middle.x, margin - 0.5 * viewport.y - middle.y};
  const ClipPlane& clip = scene.view.clip;
  if (!clip.on || clip.mode != ClipPlane::Mode::Cut) return;
  const double side = (clip.flip ? -1.0 : 1.0) / length(clip.normal), slack = 1e-6 * scene.bounds.radius();  // faces in the plane stay
  const Vec3 normal = side * clip.normal;
  look.plane = std::array{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z),
                          static_cast<float>(side * clip.offset - dot(normal, projection.origin()) + slack)};
}

void VolumeScene::Impl::draw_marks(const Stage& stage, const SpaceMarks& wanted) {
  begin_marks();
  if (elements != nullptr)
    gather_marks(wanted.vertices.empty() ? seen_faces() : seen_vertices(), stage.projection, stage.style, wanted, marks);
  if (wanted.triad) gather_triad(stage.camera, stage.triad, stage.style, marks);
  View flat;
  flat.viewport = stage.view.viewport;
  marks.flush(flat, stage.style.scale);
}

/// All that is seen, at full detail.
void VolumeScene::Impl::draw_whole(const Stage& stage) {
  painter.fill().set_colours(stage.style.colours);
  begin_elements();
  painter.draw_ghost(stage.view, stage.style);
  painter.draw_faces(stage.view, stage.look, 0, painter.face_count());
  painter.draw_cuts(stage.view, stage.style);
}

/// Where it is wanted, and depths tell the places of pixels apart.
void VolumeScene::Impl::darken(Framebuffer& target, const Stage& stage, int reach) const {
  constexpr double kDepths = 16'777'216.0, kStepsAPixel = 16.0;  // of 24 bits
  const double pixel = stage.camera.height / std::max(1.0, stage.whole.y);
  if (stage.style.occlusion && pixel * kDepths > kStepsAPixel * 2.0 * bounds.radius())
    occlusion.darken(target, stage.projection, reach, stage.style);
}

void VolumeScene::draw(Framebuffer& target, const OrbitCamera& camera, const Style& style, const SpaceMarks& marks, double detail) {
  draw_elements(target, camera, style, detail);
  draw_marks(target, camera, style, marks);
}

bool VolumeScene::draw_elements(Framebuffer& target, const Camera& seen_from, const Style& style, double detail) {
  const OrbitCamera& camera = std::get<OrbitCamera>(seen_from);
  const TargetGuard guard;
  clear(target, style);
  Impl& s = *impl_;
  if (s.elements == nullptr || s.bounds.empty()) return true;
  const Vec2<double> viewport = size_of(target);
  const Impl::Stage stage(s, camera, style, viewport, all_of(viewport));
  const double budget = std::max(1.0, std::clamp(detail, 0.0, 1.0) * s.painter.face_count());
  const auto stride = static_cast<Index>(std::ceil(s.painter.face_count() / budget - 1e-9));
  s.painter.fill().set_colours(style.colours);
  begin_elements();
  s.painter.draw_ghost(stage.view, style);
  if (stride > 1) {
    s.painter.draw_coarse(stage.view, stage.look, stride);
  } else {
    s.painter.draw_faces(stage.view, stage.look, 0, s.painter.face_count());
  }
  s.painter.draw_cuts(stage.view, style);
  if (stride <= 1) s.darken(target, stage, OcclusionPainter::reach(viewport, style));
  return stride <= 1;
}

bool VolumeScene::draw_slice(Framebuffer& target, const Camera& seen_from, const Style& style, SliceProgress& progress, Index most) {
  const OrbitCamera& camera = std::get<OrbitCamera>(seen_from);
  const TargetGuard guard;
  const bool first = !std::exchange(progress.begun, true);
  if (first) clear(target, style);
  target.bind();
  Impl& s = *impl_;
  if (s.elements == nullptr || s.bounds.empty()) return true;
  const Vec2<double> viewport = size_of(target);
  const Impl::Stage stage(s, camera, style, viewport, all_of(viewport));
  s.painter.fill().set_colours(style.colours);
  begin_elements();
  if (first) s.painter.draw_ghost(stage.view, style);
  const Index count = std::min(std::max<Index>(1, most), s.painter.face_count() - progress.drawn);
  s.painter.draw_faces(stage.view, stage.look, progress.drawn, count);
  progress.drawn += count;
  const bool last = progress.drawn >= s.painter.face_count();
  if (last) s.painter.draw_cuts(stage.view, style);
  if (last) s.darken(target, stage, OcclusionPainter::reach(viewport, style));
  glFinish();
  return last;
}

void VolumeScene::draw_marks(Framebuffer& target, const Camera& seen_from, const Style& style, const SceneMarks& marks) {
  const OrbitCamera& camera = std::get<OrbitCamera>(seen_from);
  const TargetGuard guard;
  target.bind();
  const Vec2<double> viewport = size_of(target);
  impl_->draw_marks(Impl::Stage(*impl_, camera, style, viewport, all_of(viewport)), std::get<SpaceMarks>(marks));
}

void VolumeScene::draw_part(Framebuffer& target, const Camera& seen_from, const Style& style, const SceneMarks& marks,
                            Vec2<double> viewport, const PicturePart& part) {
  const OrbitCamera& camera = std::get<OrbitCamera>(seen_from);
  const TargetGuard guard;
  clear(target, style);
  Impl& s = *impl_;
  if (s.elements == nullptr || s.bounds.empty()) return;
  const Impl::Stage stage(s, camera, style, viewport, part);
  if (style.occlusion) {
    // Parts look beyond their borders, so that they fit together.
    const int reach = OcclusionPainter::reach(viewport, style), margin = reach + 2;
    const Vec2<double> around{static_cast<double>(margin), static_cast<double>(margin)};
    const Impl::Stage wide(s, camera, style, viewport, {part.low - around, part.high + around});
    if (!s.wider) s.wider.emplace(1, 1);
    s.wider->resize(target.width() + 2 * margin, target.height() + 2 * margin);
    clear(*s.wider, style);
    s.draw_whole(wide);
    s.darken(*s.wider, wide, reach);
    target.copy_middle_of(*s.wider);
    target.bind();
  } else {
    s.draw_whole(stage);
  }
  s.draw_marks(stage, std::get<SpaceMarks>(marks));
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
