// Draws a face by six vertices: two triangles, or one and nothing.
#include "fill.glsl"
#include "faces.glsl"
uniform uint u_first;       // number of the first face
uniform float u_cut;        // 1: the faces are cuts
uniform float u_wire_fade;  // pixels at which the wireframe begins to show; 0 or less: none
uniform int u_others;       // elements that do not count: 0 faded, 1 hidden, 2 outlined (faded here)
uniform vec4 u_faded_colour;
flat out vec4 v_fill;              // colour; 0 plain, 1 inverted, 2 not defined, 4 faded
flat out vec2 v_wire_and_size;     // strength of the wireframe, size of the face in pixels
flat out vec3 v_edges[3];          // dot with (pixel, 1) gives the distance from the edge

const float kHidden = 1e6;

// Line through a and b; c is on its positive side.
vec3 edge(vec2 a, vec2 b, vec2 c) {
  vec2 along = b - a;
  float size = length(along);
  if (size < 1e-6) return vec3(0.0, 0.0, kHidden);
  vec2 across = vec2(-along.y, along.x) / size;
  vec3 line = vec3(across, -dot(across, a));
  return dot(across, c - a) < 0.0 ? -line : line;
}

void main() {
  Face face = faces[u_first + uint(gl_VertexID) / 6u];
  uint at = uint(gl_VertexID) % 6u, local = at % 3u;
  bool triangle = is_triangle(face);
  bool counting = counts(face.element);
  v_fill = vec4(0.0);
  v_wire_and_size = vec2(0.0);
  for (int i = 0; i < 3; ++i) v_edges[i] = vec3(0.0, 0.0, kHidden);
  gl_ClipDistance[0] = 1.0;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // nothing is drawn
  if ((triangle && at >= 3u) || (!counting && u_others == 1)) return;

  vec3 p[4];
  for (uint i = 0u; i < 3u; ++i) p[i] = corner_of(face, i);
  p[3] = triangle ? p[0] : corner_of(face, 3u);
  bool away = looks_away(p[0], p[1], p[2], p[3]), is_inverted = inverted(face.element);
#ifndef GHOST
  if (hidden_by_others(away, is_inverted)) return;
#endif
  vec3 a = at < 3u ? p[0] : p[2], b = at < 3u ? p[1] : p[3], c = at < 3u ? p[2] : p[0];
  vec3 here = local == 0u ? a : local == 1u ? b : c;
  gl_Position = u_to_clip_space * vec4(here, 1.0);
  gl_ClipDistance[0] = kept_by_plane(here);
  // Inverted elements lie above those that they overlap, and of cuts in one plane always the same one is on top. At the outline of a closed
  // surface its back lies beneath its front.
  float above = is_inverted ? 4e-5 : u_sides == 2 && away ? -4e-5 : 0.0;
  gl_Position.z -= gl_Position.w * (above + u_cut * 2e-6 * float(face.element & 7u));

  vec4 clip[4];
  vec2 pixels[4];
  bool in_front = true;
  for (int i = 0; i < 4; ++i) {
    clip[i] = u_to_clip_space * vec4(p[i], 1.0);
    in_front = in_front && clip[i].w > 0.0;
    pixels[i] = 0.5 * u_viewport * clip[i].xy / clip[i].w;
  }
  vec2 across = pixels[2] - pixels[0], other = triangle ? pixels[1] - pixels[0] : pixels[3] - pixels[1];
  float size = sqrt(abs(across.x * other.y - across.y * other.x));
  if (in_front) {
    vec2 x = at < 3u ? pixels[0] : pixels[2], y = at < 3u ? pixels[1] : pixels[3], z = at < 3u ? pixels[2] : pixels[0];
    uint none = triangle ? 0xffffffffu - face.corners[3] : 4u;  // sides that are no edges; of a quadrilateral the diagonal
    if ((none & 1u) == 0u) v_edges[0] = edge(x, y, z);
    if ((none & 2u) == 0u) v_edges[1] = edge(y, z, x);
    if ((none & 4u) == 0u) v_edges[2] = edge(z, x, y);
  }
  float strength = u_wire_fade > 0.0 && in_front ? smoothstep(u_wire_fade, 4.0 * u_wire_fade, size) : 0.0;
  v_fill = counting ? fill_of(face.element) : vec4(u_faded_colour.rgb, 4.0);
  v_fill.rgb *= brightness(triangle ? cross(p[1] - p[0], p[2] - p[0]) : cross(p[2] - p[0], p[3] - p[1]), here) * side_brightness(away, is_inverted);
  v_wire_and_size = vec2(counting ? strength : u_faded_colour.a * strength, size);
}
