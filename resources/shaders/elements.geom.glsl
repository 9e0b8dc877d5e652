// Colours an element once and gives its triangles the distances to its edges. With QUADRILATERALS an element comes as four corners.
#ifdef QUADRILATERALS
layout(lines_adjacency) in;
layout(triangle_strip, max_vertices = 6) out;
#else
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
#endif

layout(std430, binding = 1) readonly buffer Shades { float shades[]; };       // by element
layout(std430, binding = 2) readonly buffer Order { uint order[]; };          // drawn order to element
uniform uint u_first;
uniform sampler2D u_colours;
uniform vec2 u_range;        // quality of the first and of the last colour
uniform vec4 u_inverted_colour;
uniform vec4 u_undefined_colour;
uniform float u_wire_fade;   // pixels at which the wireframe begins to show; 0 or less: none

in vec2 v_pixels[];
flat out vec4 g_fill;              // colour; 0 plain, 1 inverted, 2 not defined
flat out vec2 g_wire_and_size;     // strength of the wireframe, size of the element in pixels
noperspective out vec3 g_distance; // to the three edges, pixels

const float kHidden = 1e6;

// Outputs are lost with every vertex, so all are set again.
void corner(vec2 point, vec3 distances, vec4 fill, vec2 wire_and_size) {
  gl_Position = to_clip(point, fill.a == 1.0 ? -0.5 : 0.0);  // inverted elements lie above what they fold over
  g_distance = distances;
  g_fill = fill;
  g_wire_and_size = wire_and_size;
  EmitVertex();
}

// `hidden`: added to the distance from the edge opposite of b.
void emit(vec2 a, vec2 b, vec2 c, float hidden, vec4 fill, vec2 wire_and_size) {
  float twice = abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  vec3 height = twice / max(vec3(distance(b, c), distance(c, a), distance(a, b)), 1e-9);
  corner(a, vec3(height.x, hidden, 0.0), fill, wire_and_size);
  corner(b, vec3(0.0, height.y + hidden, 0.0), fill, wire_and_size);
  corner(c, vec3(0.0, hidden, height.z), fill, wire_and_size);
  EndPrimitive();
}

float turn(vec2 a, vec2 b, vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

vec4 fill_of(float shade) {
  if (shade < -1e38) return vec4(u_inverted_colour.rgb, 1.0);
  if (shade > 1e38) return vec4(u_undefined_colour.rgb, 2.0);
  int last = textureSize(u_colours, 0).x - 1;
  float t = clamp((shade - u_range.x) / (u_range.y - u_range.x), 0.0, 1.0);
  return vec4(texelFetch(u_colours, ivec2(int(t * float(last) + 0.5), 0), 0).rgb, 0.0);
}

void main() {
  vec4 fill = fill_of(shades[order[u_first + uint(gl_PrimitiveIDIn)]]);
#ifdef QUADRILATERALS
  float area = 0.5 * abs(turn(v_pixels[0], v_pixels[1], v_pixels[2]) + turn(v_pixels[0], v_pixels[2], v_pixels[3]));
#else
  float area = 0.5 * abs(turn(v_pixels[0], v_pixels[1], v_pixels[2]));
#endif
  float size = sqrt(2.0 * area);
  float wire = u_wire_fade > 0.0 ? smoothstep(u_wire_fade, 4.0 * u_wire_fade, size) : 0.0;
  vec2 wire_and_size = vec2(wire, size);
#ifdef QUADRILATERALS
  vec2 a = v_pixels[0], b = v_pixels[1], c = v_pixels[2], d = v_pixels[3];
  // The diagonal that lies inside: where a quadrilateral is not convex only one does.
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
