#include "ui/commands/clipping_commands.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/clipping/clip_to_text.h"
#include "core/input/input_mesh.h"
#include "ui/commands/command_words.h"

namespace dmoscope::ui {
namespace {

/// The box of the mesh on show.
render::Bounds3 box_of_volume(const CommandHost& host) {
  const auto view = open_view(host);
  if (!view->input->in_space()) throw UsageError("this mesh has no inside: it is not one of volume elements");
  render::Bounds3 box;
  for (const Vec3& p : view->frame ? view->frame->positions : view->input->mesh.positions) box.include(p);
  return box;
}

float to_quality(const std::string& word) { return static_cast<float>(to_number(word)); }

/// A plane across an axis at a fraction of the box; the side towards the eye is taken away.
ClipPlane across(int axis, double fraction, const render::OrbitCamera& seen_by, const render::Bounds3& box) {
  return parse_clip(fmt::format("{}:{}", axis_name(axis, looks_along(seen_by, axis)), fraction), box.low, box.high);
}

/// The plane at its place; if it had none, across x, and through the middle if it would miss the mesh.
ClipPlane plane_within(ClipPlane plane, const render::OrbitCamera& seen_by, const render::Bounds3& box) {
  if (plane == ClipPlane{.mode = plane.mode}) return across(0, 0.5, seen_by, box);
  plane.on = true;
  const auto [low, high] = span_of(plane, box);
  if (!(plane.offset > low && plane.offset < high)) plane.offset = low + 0.5 * (high - low);
  return plane;
}

/// A plane as far along the next axis as it was along its own; across x if it was off or oblique.
ClipPlane across_next_axis(const ClipPlane& plane, const render::OrbitCamera& seen_by, const render::Bounds3& box) {
  const auto now = plane.on ? axis_plane(plane, box) : std::nullopt;
  return across(now ? (now->axis + 1) % 3 : 0, now ? std::clamp(now->fraction, 0.0, 1.0) : 0.5, seen_by, box);
}

void set_clip(ViewState& state, const CommandHost& host, Arguments words) {
  ClipPlane& clip = state.inside.clip;
  const std::string& word = words[0];
  if (word == "off" || (word == "toggle" && clip.on)) {
    clip.on = false;
  } else if (word == "flip") {
    clip.flip = !clip.flip;
  } else {
    const render::Bounds3 box = box_of_volume(host);
    const ClipPlane::Mode mode = clip.mode;
    clip = word == "on" || word == "toggle" ? plane_within(clip, state.orbit, box)
           : word == "next"                 ? across_next_axis(clip, state.orbit, box)
                                            : parse_clip(word, box.low, box.high);
    clip.mode = mode;
  }
}

void add_clip_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"clip", "clip PLANE|on|off|toggle|flip|next",
             "takes away what of a volume mesh lies beyond a plane: x, y, z, -x, -y, -z, with :FRACTION of the mesh or half-way, or "
             "NX,NY,NZ:OFFSET; next: across the next axis, the side towards the eye"},
            {1, 1}, [&state, &host](Arguments words) { set_clip(state, host, words); });
}

void add_peel_commands(CommandTable& table, ViewState& state) {
  ClippingView& view = state.inside;
  table.add({"peel-quality", "peel-quality Q|off", "takes cells of a higher quality away"}, {1, 1},
            [&view](Arguments words) { view.peel_quality = words[0] == "off" ? std::nullopt : std::optional(to_quality(words[0])); });
  table.add({"keep-quality", "keep-quality LOW HIGH|off", "only cells of a quality in this range are seen"}, [&view](Arguments words) {
    if (words.size() == 1 && words[0] == "off") {
      view.isolate.reset();
      return;
    }
    require(words, 2, 2);
    const std::pair range{to_quality(words[0]), to_quality(words[1])};
    if (!(range.first <= range.second)) throw UsageError("the lower quality comes first");
    view.isolate = range;
  });
  table.add({"show-all", "show-all", "all cells of a volume mesh are seen again"}, {0, 0}, [&view](Arguments) { view = {}; });
}

/// Sets the camera from "CX CY CZ HEIGHT RX RY RZ UX UY UZ".
void set_orbit(ViewState& state, Arguments words) {
  const auto at = [&words](std::size_t k) { return Vec3{to_number(words[k]), to_number(words[k + 1]), to_number(words[k + 2])}; };
  render::OrbitCamera orbit = state.orbit;
  orbit.centre = at(0);
  orbit.height = to_number(words[3]);
  orbit.right = at(4);
  orbit.up = at(7);
  if (!orbit.is_valid()) throw UsageError("the height must be greater than 0, and the two directions of length 1 and at right angles");
  state.orbit = orbit;
  state.requests.fit = false;
}

void add_orbit_commands(CommandTable& table, ViewState& state) {
  table.add({"orbit", "orbit X Y Z HEIGHT RX RY RZ UX UY UZ",
             "looks at that point of a volume mesh, so much of it from the lower to the upper border, with these directions to the right "
             "and up"},
            {10, 10}, [&state](Arguments words) { set_orbit(state, words); });
  table.add({"view-from", "view-from iso|+x|-x|+y|-y|+z|-z", "looks at all of a volume mesh from there"}, {1, 1},
            [&state](Arguments words) {
              state.orbit.look_from(render::view_preset_from_name(words[0]));
              state.requests.fit = true;
            });
  table.add({"turn", "turn DX DY", "turns a volume mesh as a drag of so many pixels does"}, {2, 2}, [&state](Arguments words) {
    state.orbit.turn({to_number(words[0]), to_number(words[1])}, state.viewport);
  });
  table.add({"roll", "roll X Y TO-X TO-Y", "turns it as a ball that is dragged from one pixel to another"}, {4, 4},
            [&state](Arguments words) {
              state.orbit.roll({to_number(words[0]), to_number(words[1])}, {to_number(words[2]), to_number(words[3])}, state.viewport);
            });
  table.add({"orbit-about", "orbit-about X Y Z", "moves this point of a volume mesh to the middle, to turn about it"}, {3, 3},
            [&state](Arguments words) {
              state.orbit.orbit_about({to_number(words[0]), to_number(words[1]), to_number(words[2])});
            });
}

/// Command for the same plane to the last digit, wherever the mesh lies: "clip -1,0,0:0.25"; "clip off".
std::string exact_clip_command(const ClipPlane& plane) {
  if (!plane.on) return "clip off";
  const double side = plane.flip ? -1.0 : 1.0;
  const Vec3 n = side * plane.normal;
  return fmt::format("clip {},{},{}:{}", n.x, n.y, n.z, side * plane.offset);
}

}  // namespace

void add_clipping_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  add_clip_commands(table, state, host);
  add_peel_commands(table, state);
  add_orbit_commands(table, state);
}

std::pair<double, double> span_of(const ClipPlane& plane, const render::Bounds3& box) {
  double low = INFINITY, high = -INFINITY;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const double at = dot(plane.normal, {(corner & 1U) != 0 ? box.high.x : box.low.x, (corner & 2U) != 0 ? box.high.y : box.low.y,
                                         (corner & 4U) != 0 ? box.high.z : box.low.z});
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return {low, high};
}

std::optional<AxisPlane> axis_plane(const ClipPlane& plane, const render::Bounds3& box) {
  const std::array<double, 3> normal{plane.normal.x, plane.normal.y, plane.normal.z}, low{box.low.x, box.low.y, box.low.z},
      high{box.high.x, box.high.y, box.high.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (normal[axis] == 0.0 || normal[(axis + 1) % 3] != 0.0 || normal[(axis + 2) % 3] != 0.0) continue;
    if (!(high[axis] > low[axis])) return std::nullopt;
    const double at = plane.offset / normal[axis];
    return AxisPlane{static_cast<int>(axis), plane.flip != (normal[axis] < 0.0), (at - low[axis]) / (high[axis] - low[axis])};
  }
  return std::nullopt;
}

bool looks_along(const render::OrbitCamera& camera, int axis) {
  const Vec3 back = camera.back();
  constexpr double kFromTheSide = 1e-6;  // so small that the view is practically from the side
  return (axis == 0 ? back.x : axis == 1 ? back.y : back.z) < -kFromTheSide;
}

std::string axis_name(int axis, bool flip) { return std::string(flip ? "-" : "") + static_cast<char>('x' + axis); }

std::string clip_command(const ClipPlane& plane, const render::Bounds3& box) {
  const auto across = axis_plane(plane, box);
  if (!across || across->fraction < 0.0 || across->fraction > 1.0) return exact_clip_command(plane);
  return fmt::format("clip {}:{:.4g}", axis_name(across->axis, across->flip), across->fraction);
}

std::vector<std::string> inside_lines(const ViewState& state, bool with_camera) {
  const ClippingView& view = state.inside;
  std::vector<std::string> lines{exact_clip_command(view.clip)};
  lines.push_back(view.peel_quality ? fmt::format("peel-quality {}", *view.peel_quality) : "peel-quality off");
  lines.push_back(view.isolate ? fmt::format("keep-quality {} {}", view.isolate->first, view.isolate->second) : "keep-quality off");
  if (!with_camera) return lines;
  const render::OrbitCamera& orbit = state.orbit;
  const Vec3 &c = orbit.centre, &r = orbit.right, &u = orbit.up;
  lines.push_back(fmt::format("orbit {} {} {} {} {} {} {} {} {} {}", c.x, c.y, c.z, orbit.height, r.x, r.y, r.z, u.x, u.y, u.z));
  return lines;
}

}  // namespace dmoscope::ui
