#include "render/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope::render {
namespace {

constexpr double kSmallest = 1e-150, kLargest = 1e150;  // limits of a viewport's size in units, so that its square stays finite and above 0
constexpr double kDragTurn = std::numbers::pi;          // angle of a drag over the shorter side of the viewport
constexpr double kNearest = 1e-4;                       // share of the farthest depth; everything nearer to the eye is not seen

constexpr std::array<ViewPresetInfo, 7> kPresets{{{ViewPreset::Isometric, "iso"},
                                                  {ViewPreset::PlusX, "+x"},
                                                  {ViewPreset::MinusX, "-x"},
                                                  {ViewPreset::PlusY, "+y"},
                                                  {ViewPreset::MinusY, "-y"},
                                                  {ViewPreset::PlusZ, "+z"},
                                                  {ViewPreset::MinusZ, "-z"}}};

Vec3 normalised(Vec3 v) { return 1.0 / length(v) * v; }

/// Turns `v` about an axis of length 1, counter-clockwise seen from its tip.
Vec3 turned(Vec3 v, Vec3 axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + (1.0 - c) * dot(axis, v) * axis;
}

/// Restores right angles and lengths of 1, which many turns wear off.
void straighten(OrbitCamera& camera) {
  camera.right = normalised(camera.right);
  camera.up = normalised(camera.up - dot(camera.up, camera.right) * camera.right);
}

double shorter_side(Vec2<double> viewport) { return std::max(1.0, std::min(viewport.x, viewport.y)); }

/// Point under a pixel on a ball that fills the viewport, or on the bowl around it (Bell's trackball): no jump at its border.
Vec3 on_ball(Vec2<double> pixel, Vec2<double> viewport) {
  const double radius = 0.5 * shorter_side(viewport);
  const double x = (pixel.x - 0.5 * viewport.x) / radius, y = (0.5 * viewport.y - pixel.y) / radius;
  const double square = x * x + y * y;
  const double z = square < 0.5 ? std::sqrt(1.0 - square) : 0.5 / std::sqrt(square);
  return normalised({x, y, z});
}

}  // namespace

void Bounds3::include(Vec3 p) noexcept {
  if (empty()) {
    low = high = p;
    return;
  }
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

std::span<const ViewPresetInfo> view_preset_table() { return kPresets; }

ViewPreset view_preset_from_name(std::string_view name) {
  for (const ViewPresetInfo& preset : kPresets)
    if (preset.name == name) return preset.preset;
  throw UsageError(unknown_row("view", name, kPresets));
}

std::optional<Vec2<double>> Projection::place(Vec3 point) const {
  const Vec3 p = point - origin_;
  const auto row = [&](std::size_t r) { return matrix_[r] * p.x + matrix_[r + 4] * p.y + matrix_[r + 8] * p.z + matrix_[r + 12]; };
  const double w = row(3);
  if (!(w > 0.0)) return std::nullopt;
  return Vec2<double>{0.5 * viewport_.x * row(0) / w, 0.5 * viewport_.y * row(1) / w};
}

double Projection::depth(Vec3 point) const {
  const Vec3 p = point - origin_;
  const auto row = [&](std::size_t r) { return matrix_[r] * p.x + matrix_[r + 4] * p.y + matrix_[r + 8] * p.z + matrix_[r + 12]; };
  return row(2) / row(3);
}

double OrbitCamera::distance() const { return 0.5 * height / std::tan(0.5 * kFieldOfView); }

namespace {

/// Looks along -towards, which has length 1, with the upright axis up.
void look_upright(OrbitCamera& camera, Vec3 towards) {
  const Vec3 axis = camera.upright(), beside = camera.up_axis == UpAxis::Z ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
  camera.right = normalised(cross(std::abs(dot(towards, axis)) < 0.99 ? axis : beside, towards));
  camera.up = cross(towards, camera.right);
}

}  // namespace

void OrbitCamera::look_from(ViewPreset preset) {
  // Direction towards the eye, in the order of ViewPreset; the corner is on the right in front, whichever axis is up.
  const Vec3 corner = up_axis == UpAxis::Z ? Vec3{1, -1, 1} : Vec3{1, 1, 1};
  const std::array<Vec3, 7> directions{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, normalised(corner)}};
  look_upright(*this, directions[static_cast<std::size_t>(preset)]);
}

void OrbitCamera::face(Vec3 outward) {
  constexpr double kWellEnough = 0.3;  // least cosine
  const double size = length(outward);
  if (!(size > 0.0) || dot(outward, back()) >= kWellEnough * size) return;
  look_upright(*this, (1.0 / size) * outward);
}

void OrbitCamera::raise(UpAxis axis) {
  if (axis == std::exchange(up_axis, axis)) return;
  const auto with_mesh = [axis](Vec3 v) { return axis == UpAxis::Y ? Vec3{v.x, v.z, -v.y} : Vec3{v.x, -v.z, v.y}; };
  right = with_mesh(right);
  up = with_mesh(up);
}

bool OrbitCamera::is_valid() const {
  constexpr double kRounding = 1e-6;
  const auto unit = [](Vec3 v) { return std::abs(length(v) - 1.0) < kRounding; };
  return height >= kSmallest && height <= kLargest && std::isfinite(length(centre)) && unit(right) && unit(up) &&
         std::abs(dot(right, up)) < kRounding;
}

namespace {

/// Interval of the eye's places to the side for which points stay between two borders: the farther away a point (the higher `reach`), the
/// more freely. Borders are slopes: their distance from the line of sight at 1 from the eye. In the orthographic view, where nothing
/// shrinks with its distance, depths count as 0 and `reach` as half the height.
class Between {
 public:
  Between(double low, double high) : low_(low), high_(high) {}
  void include(double across, double depth) {
    lowest_ = std::min(lowest_, across + low_ * depth);
    highest_ = std::max(highest_, across + high_ * depth);
  }
  [[nodiscard]] double least_reach() const { return (highest_ - lowest_) / (high_ - low_); }
  [[nodiscard]] double middle(double reach) const { return 0.5 * (highest_ - high_ * reach + lowest_ - low_ * reach); }

 private:
  double low_, high_;
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
};

/// Interval widened, if need be, until something can be seen in it.
std::pair<double, double> wide_enough(double low, double high, double whole) {
  const double middle = 0.5 * (low + high), half = 0.5 * std::max(high - low, 0.2 * whole);
  return {middle - half, middle + half};
}

}  // namespace

void OrbitCamera::fit(std::span<const Vec3> points, Vec2<double> viewport, const PicturePart& room) {
  height = 1.0;
  centre = points.empty() ? Vec3{} : points.front();
  if (points.empty()) return;
  const Vec2<double> size{std::max(viewport.x, 1.0), std::max(viewport.y, 1.0)};
  const auto [left, end] = wide_enough(room.low.x, room.high.x, size.x);
  const auto [top, bottom] = wide_enough(room.low.y, room.high.y, size.y);
  const double slope = std::tan(0.5 * kFieldOfView), unit = (perspective ? slope : 1.0) / (0.5 * size.y);
  Between across(unit * (left - 0.5 * size.x), unit * (end - 0.5 * size.x));
  Between upwards(unit * (0.5 * size.y - bottom), unit * (0.5 * size.y - top));
  const Vec3 origin = centre, z = back();  // near the points, so that no digits are lost far from the mesh's origin
  double nearest = -std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (const Vec3& point : points) {
    const Vec3 p = point - origin;
    const double depth = dot(p, z), counted = perspective ? depth : 0.0;
    across.include(dot(p, right), counted);
    upwards.include(dot(p, up), counted);
    nearest = std::max(nearest, depth);
    farthest = std::min(farthest, depth);
  }
  const double reach = std::max(across.least_reach(), upwards.least_reach()), middle = 0.5 * (nearest + farthest);
  const double wanted = 2.0 * (perspective ? slope * (reach - middle) : reach);
  if (!(wanted > 0.0)) return;
  height = std::clamp(wanted, kSmallest, kLargest);
  centre = origin + across.middle(reach) * right + upwards.middle(reach) * up + middle * z;
}

void OrbitCamera::fit(const Bounds3& bounds, Vec2<double> viewport, double margin) {
  std::vector<Vec3> corners;
  for (unsigned corner = 0; corner < 8 && !bounds.empty(); ++corner)
    corners.push_back({(corner & 1U) != 0 ? bounds.high.x : bounds.low.x, (corner & 2U) != 0 ? bounds.high.y : bounds.low.y,
                       (corner & 4U) != 0 ? bounds.high.z : bounds.low.z});
  fit(corners, viewport, {{margin, margin}, {viewport.x - margin, viewport.y - margin}});
}

void OrbitCamera::turn(Vec2<double> pixels, Vec2<double> viewport) {
  const Vec3 axis = upright();
  const double each = kDragTurn / shorter_side(viewport), height_of_eye = dot(back(), axis);
  const double elevation = std::asin(std::clamp(height_of_eye, -1.0, 1.0));
  // The direction to the right is made level, in case the camera was rolled; straight above or below, `right` alone tells the direction.
  const Vec3 level = std::abs(height_of_eye) < 1.0 - 1e-9 ? cross(axis, back()) : right - dot(right, axis) * axis;
  right = turned(length(level) > 0.0 ? normalised(level) : Vec3{1, 0, 0}, axis, -each * pixels.x);
  const double raised = std::clamp(elevation + each * pixels.y, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
  const Vec3 outwards = cross(right, axis);  // outward direction of a camera that looks along the ground
  up = std::cos(raised) * axis - std::sin(raised) * outwards;
  straighten(*this);
}

void OrbitCamera::roll(Vec2<double> from, Vec2<double> to, Vec2<double> viewport) {
  const Vec3 a = on_ball(from, viewport), b = on_ball(to, viewport), axis = cross(a, b);
  const double sine = length(axis);
  if (sine < 1e-12) return;
  const double angle = std::atan2(sine, dot(a, b));
  const Vec3 about = 1.0 / sine * (axis.x * right + axis.y * up + axis.z * back());
  right = turned(right, about, -angle);
  up = turned(up, about, -angle);
  straighten(*this);
}

void OrbitCamera::pan(Vec2<double> pixels, Vec2<double> viewport) {
  const double unit = units_per_pixel(viewport);
  centre = centre - unit * pixels.x * right + unit * pixels.y * up;
}

void OrbitCamera::zoom_at(Vec2<double> cursor, Vec2<double> viewport, double factor) {
  const double wanted = std::clamp(height / factor, kSmallest, kLargest), kept = wanted / height, unit = units_per_pixel(viewport);
  const Vec3 point = unit * (cursor.x - 0.5 * viewport.x) * right - unit * (cursor.y - 0.5 * viewport.y) * up;
  centre = centre + (1.0 - kept) * point;
  height = wanted;
}

ViewRay OrbitCamera::ray(Vec2<double> pixel, Vec2<double> viewport) const {
  const double unit = units_per_pixel(viewport);
  const Vec3 point = centre + unit * (pixel.x - 0.5 * viewport.x) * right - unit * (pixel.y - 0.5 * viewport.y) * up;
  if (!perspective) return {point, -1.0 * back()};
  return {eye(), normalised(point - eye()), 0.0};
}

Projection OrbitCamera::projection(Vec2<double> viewport, const Bounds3& bounds, const std::optional<PicturePart>& part) const {
  Projection result;
  result.origin_ = bounds.empty() ? Vec3{} : bounds.centre();
  const PicturePart whole = part.value_or(PicturePart{{0, 0}, viewport});
  result.viewport_ = whole.high - whole.low;
  const double radius = std::max(bounds.radius() * 1.001, height * 1e-9);
  const Vec3 z = back(), to_centre = result.origin_ - centre;
  const double half = 0.5 * height, half_across = half * viewport.x / viewport.y;
  // Rows of the camera's own coordinates: right, up, towards the eye; w.
  std::array<std::array<double, 4>, 4> rows{};
  const auto axis = [&](Vec3 a, double scale) { return std::array{a.x * scale, a.y * scale, a.z * scale, dot(a, to_centre) * scale}; };
  const double near_height = dot(z, to_centre) + radius, far_height = dot(z, to_centre) - radius;
  rows[0] = axis(right, 1.0 / half_across);
  rows[1] = axis(up, 1.0 / half);
  if (perspective) {
    const double eye_height = distance();
    rows[3] = axis(z, -1.0 / eye_height);
    rows[3][3] += 1.0;  // w is 1 at the centre
    const double farthest = std::max((eye_height - far_height) / eye_height, 1e-9);
    const double nearest = std::max((eye_height - near_height) / eye_height, kNearest * farthest);
    // Depth is a + b / w, from -1 to 1.
    const double b = -2.0 * farthest * nearest / (farthest - nearest), a = (farthest + nearest) / (farthest - nearest);
    for (std::size_t c = 0; c < 4; ++c) rows[2][c] = a * rows[3][c];
    rows[2][3] += b;
  } else {
    rows[2] = axis(z, -2.0 / (near_height - far_height));
    rows[2][3] += (near_height + far_height) / (near_height - far_height);
    rows[3] = {0, 0, 0, 1};
  }
  // Scale and shift to the part alone.
  const Vec2<double> scale{viewport.x / result.viewport_.x, viewport.y / result.viewport_.y};
  const Vec2<double> middle{(whole.low.x + whole.high.x) / viewport.x - 1.0, 1.0 - (whole.low.y + whole.high.y) / viewport.y};
  for (std::size_t c = 0; c < 4; ++c) {
    rows[0][c] = scale.x * (rows[0][c] - middle.x * rows[3][c]);
    rows[1][c] = scale.y * (rows[1][c] - middle.y * rows[3][c]);
    for (std::size_t r = 0; r < 4; ++r) result.matrix_[4 * c + r] = rows[r][c];
  }
  return result;
}

}  // namespace dmoscope::render
