// Draws one square for u_stride elements that follow each other along the drawn order, which keeps neighbours together.
#include "fill.glsl"
layout(std430, binding = 0) readonly buffer Positions { vec2 positions[]; };
layout(std430, binding = 3) readonly buffer Corners { uint corners[]; };
layout(std430, binding = 7) readonly buffer Odd { uint odd[]; };  // a bit for every 32 drawn elements: whether any is inverted
uniform int u_look;  // whether all elements of a square are looked at: 0 no, 1 if some are odd, 2 yes
uniform uint u_first;
uniform uint u_last;
uniform uint u_stride;
uniform uint u_corner_count;
uniform int u_others;  // elements that do not count: 0 faded, 1 hidden, 2 outlined
uniform vec4 u_faded_colour;
flat out vec3 v_fill;

bool to_look_through(uint first, uint last) {
  if (u_look != 1) return u_look == 2;
  for (uint block = first / 32u; block <= (last - 1u) / 32u; ++block)
    if ((odd[block / 32u] >> (block % 32u) & 1u) != 0u) return true;
  return false;
}

void main() {
  uint drawn = u_first + uint(gl_VertexID) * u_stride;
  uint base = drawn * u_corner_count;
  vec2 corner[4];
  vec2 middle = vec2(0.0);
  float west = 1e30, east = -1e30;
  for (uint i = 0u; i < u_corner_count; ++i) {
    corner[i] = to_pixels(positions[corners[base + i]]);
    middle += corner[i];
    west = min(west, corner[i].x);
    east = max(east, corner[i].x);
  }
  middle /= float(u_corner_count);
  float area = 0.0;
  for (uint i = 0u; i < u_corner_count; ++i) {
    vec2 a = corner[i] - middle, b = corner[(i + 1u) % u_corner_count] - middle;
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  // An inverted element must not vanish among its neighbours, nor one that counts among those that do not.
  uint chosen = drawn;
  bool counting = counts(order[drawn]), worst = counting && inverted(order[drawn]);
  uint last = min(drawn + u_stride, u_last);
  if (!to_look_through(drawn, last)) last = drawn;
  for (uint other = drawn + 1u; other < last && !worst; ++other) {
    uint element = order[other];
    if (!counts(element)) continue;
    worst = inverted(element);
    if (!counting || worst) chosen = other;
    counting = true;
  }
  uint element = order[chosen];
  if (!counting) {
    v_fill = u_faded_colour.rgb;
  } else if (u_by == 2 && !worst) {
    v_fill = colour_of(values[corners[chosen * u_corner_count]]).rgb;
  } else {
    v_fill = fill_of(element).rgb;
  }
  gl_Position = to_clip(middle, worst ? -0.5 : counting ? 0.0 : 0.5);
  if ((!counting && u_others != 0) || east - west > u_widest) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // nothing is drawn
  gl_PointSize = clamp(1.7 * sqrt(abs(area) * float(u_stride)) + 0.5, 1.0, worst ? 8.0 : 64.0);  // a large inverted one buries no other
}
