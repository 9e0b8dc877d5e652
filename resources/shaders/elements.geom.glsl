// Colours an element once and gives its triangles the distances to its edges. With QUADRILATERALS an element comes as four corners. With
// BY_CORNERS its fragments get the corners, to take the colour of the nearest one.
#include "fill.glsl"
#ifdef QUADRILATERALS
layout(lines_adjacency) in;
layout(triangle_strip, max_vertices = 6) out;
#else
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
#endif

uniform uint u_first;
uniform float u_wire_fade;   // pixels at which the wireframe begins to show; 0 or less: none
uniform float u_hollow_fade; // pixels at which the outline begins to show for elements of which only that is drawn
uniform int u_others;        // elements that do not count: 0 faded, 1 hidden, 2 outlined
uniform vec4 u_faded_colour;

in vec2 v_pixels[];
flat out vec4 g_fill;              // colour; 0 plain, 1 inverted, 2 not defined, 3 hollow, 4 faded
flat out vec2 g_wire_and_size;     // strength of the wireframe, size of the element in pixels
noperspective out vec3 g_distance; // distances to the three edges, pixels
#ifdef BY_CORNERS
in float v_value[];
flat out vec4 g_corners[2];        // pixels
flat out vec4 g_values;            // values of the corners; a triangle's first twice
#endif

const float kHidden = 1e6;

// Sends one vertex. Outputs are lost with every vertex, so all are set again.
void corner(vec2 point, vec3 distances, vec4 fill, vec2 wire_and_size) {
  // Inverted elements lie above those that they fold over, and elements that do not count below those that do.
  gl_Position = to_clip(point, fill.a == 1.0 ? -0.5 : fill.a >= 3.0 ? 0.5 : 0.0);
  g_distance = distances;
  g_fill = fill;
  g_wire_and_size = wire_and_size;
#ifdef BY_CORNERS
#ifdef QUADRILATERALS
  g_corners[0] = vec4(v_pixels[0], v_pixels[1]);
  g_corners[1] = vec4(v_pixels[2], v_pixels[3]);
  g_values = vec4(v_value[0], v_value[1], v_value[2], v_value[3]);
#else
  g_corners[0] = vec4(v_pixels[0], v_pixels[1]);
  g_corners[1] = vec4(v_pixels[2], v_pixels[0]);
  g_values = vec4(v_value[0], v_value[1], v_value[2], v_value[0]);
#endif
#endif
  EmitVertex();
}

// Sends a triangle. `hidden`: added to the distance from the edge opposite of b.
void emit(vec2 a, vec2 b, vec2 c, float hidden, vec4 fill, vec2 wire_and_size) {
  float twice = abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  vec3 height = twice / max(vec3(distance(b, c), distance(c, a), distance(a, b)), 1e-9);
  corner(a, vec3(height.x, hidden, 0.0), fill, wire_and_size);
  corner(b, vec3(0.0, height.y + hidden, 0.0), fill, wire_and_size);
  corner(c, vec3(0.0, hidden, height.z), fill, wire_and_size);
  EndPrimitive();
}

float turn(vec2 a, vec2 b, vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

float wire_strength(float fade, float size) { return fade > 0.0 ? smoothstep(fade, 4.0 * fade, size) : 0.0; }

// Whether no pixel's centre lies in the box, so that nothing of it would be drawn: true for most elements of a big mesh seen whole.
// Positions are rounded to a part of a pixel before they are drawn, hence the margin.
bool between_pixels(vec2 low, vec2 high) {
  const float kMargin = 1.0 / 64.0;
  vec2 first = 0.5 * u_viewport - 0.5;
  return any(lessThan(floor(high + first + kMargin), ceil(low + first - kMargin)));
}

void main() {
  vec2 low = min(v_pixels[0], min(v_pixels[1], v_pixels[2])), high = max(v_pixels[0], max(v_pixels[1], v_pixels[2]));
#ifdef QUADRILATERALS
  low = min(low, v_pixels[3]);
  high = max(high, v_pixels[3]);
#endif
  if (high.x - low.x > u_widest || between_pixels(low, high)) return;
  uint element = order[u_first + uint(gl_PrimitiveIDIn)];
  bool counting = counts(element);
  if (!counting && u_others == 1) return;
#ifdef QUADRILATERALS
  float area = 0.5 * abs(turn(v_pixels[0], v_pixels[1], v_pixels[2]) + turn(v_pixels[0], v_pixels[2], v_pixels[3]));
#else
  float area = 0.5 * abs(turn(v_pixels[0], v_pixels[1], v_pixels[2]));
#endif
  float size = sqrt(2.0 * area);
  vec4 fill;
  vec2 wire_and_size;
  if (!counting && u_others == 2) {
    fill = vec4(0.0, 0.0, 0.0, 3.0);
    wire_and_size = vec2(wire_strength(u_hollow_fade, size), size);
  } else if (!counting) {
    fill = vec4(u_faded_colour.rgb, 4.0);
    wire_and_size = vec2(u_faded_colour.a * wire_strength(u_wire_fade, size), size);
  } else {
    fill = fill_of(element);
    wire_and_size = vec2(wire_strength(u_wire_fade, size), size);
  }
#ifdef QUADRILATERALS
  vec2 a = v_pixels[0], b = v_pixels[1], c = v_pixels[2], d = v_pixels[3];
  // The diagonal must lie inside: in a quadrilateral that is not convex only one does.
  if (turn(a, b, c) * turn(a, c, d) >= 0.0 || turn(b, c, d) * turn(b, d, a) < 0.0) {
    emit(a, b, c, kHidden, fill, wire_and_size);
    emit(c, d, a, kHidden, fill, wire_and_size);
  } else {
    emit(b, c, d, kHidden, fill, wire_and_size);
    emit(d, a, b, kHidden, fill, wire_and_size);
  }
#else
  emit(v_pixels[0], v_pixels[1], v_pixels[2], 0.0, fill, wire_and_size);
#endif
}
