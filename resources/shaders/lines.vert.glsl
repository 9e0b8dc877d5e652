// Draws a line as a rectangle of six vertices. With BOUNDARY lines are the mesh's boundary edges, else a list of their own.
#ifdef BOUNDARY
layout(std430, binding = 0) readonly buffer Positions { vec2 positions[]; };
layout(std430, binding = 4) readonly buffer Edges { uvec2 edges[]; };
layout(std430, binding = 5) readonly buffer Values { float values[]; };  // values by vertex, see fill.glsl
uniform sampler2D u_palette;
uniform int u_edge_categories;  // 0: all edges have u_colour
uniform float u_width;
uniform vec4 u_colour;
#else
struct Line {
  vec4 ends;    // pixels
  vec4 colour;  // straight alpha
  vec4 width;   // width in pixels, in x
};
layout(std430, binding = 4) readonly buffer Lines { Line lines[]; };
#endif
noperspective out vec2 v_pixels;
flat out vec4 v_ends;
flat out vec4 v_colour;
flat out float v_half_width;

void main() {
  uint index = uint(gl_VertexID) / 6u;
  uint corner = uint(gl_VertexID) % 6u;
  float along = corner == 0u || corner == 2u || corner == 3u ? -1.0 : 1.0;
  float across = corner == 0u || corner == 1u || corner == 4u ? -1.0 : 1.0;
#ifdef BOUNDARY
  vec2 a = to_pixels(positions[edges[index].x]), b = to_pixels(positions[edges[index].y]);
  if (abs(b.x - a.x) > u_widest) a = b = vec2(1e9);  // nothing is drawn
  v_colour = u_colour;
  // Coasts of islands smaller than their line would become blots.
  float room = smoothstep(0.3, 5.0, distance(a, b));
  v_half_width = 0.5 * u_width * mix(0.45, 1.0, room);
  v_colour.a *= mix(0.6, 1.0, room);
  if (u_edge_categories > 0) {
    float category = values[edges[index].x];
    if (category >= 0.0 && category < 1e38 && category == values[edges[index].y]) {
      v_colour = vec4(texelFetch(u_palette, ivec2(min(int(category + 0.5), u_edge_categories - 1), 0), 0).rgb, 1.0);
      v_half_width = u_width;
    }
  }
#else
  vec2 a = lines[index].ends.xy, b = lines[index].ends.zw;
  v_colour = lines[index].colour;
  v_half_width = 0.5 * lines[index].width.x;
#endif
  v_ends = vec4(a, b);
  vec2 direction = b - a;
  float size = length(direction);
  direction = size > 1e-6 ? direction / size : vec2(1.0, 0.0);
  float reach = v_half_width + 1.0;
  v_pixels = (along < 0.0 ? a : b) + reach * (along * direction + across * vec2(-direction.y, direction.x));
  gl_Position = to_clip(v_pixels, 0.0);
}
