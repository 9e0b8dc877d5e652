// Draws a square for one of every u_stride faces, as large as these together. The choice is pseudo-random but always the same: in the rows
// of a regular mesh every n-th face would leave stripes.
#include "fill.glsl"
#include "faces.glsl"
uniform uint u_stride;
uniform uint u_count;  // number of faces
uniform int u_others;
uniform vec4 u_faded_colour;
flat out vec3 v_fill;

void main() {
  uint first = uint(gl_VertexID) * u_stride, lot = uint(gl_VertexID) * 2654435761u;
  lot = (lot ^ (lot >> 15u)) * 2246822519u;
  Face face = faces[min(first + (lot >> 8u) % u_stride, u_count - 1u)];
  bool triangle = is_triangle(face);
  vec3 p[4];
  for (uint i = 0u; i < 3u; ++i) p[i] = corner_of(face, i);
  p[3] = triangle ? p[0] : corner_of(face, 3u);
  vec3 middle = triangle ? (p[0] + p[1] + p[2]) / 3.0 : 0.25 * (p[0] + p[1] + p[2] + p[3]);
  gl_Position = u_to_clip_space * vec4(middle, 1.0);
  gl_ClipDistance[0] = kept_by_plane(middle);
  vec3 normal = triangle ? cross(p[1] - p[0], p[2] - p[0]) : cross(p[2] - p[0], p[3] - p[1]);
  bool counting = counts(face.element);
  vec3 fill = counting ? fill_of(face.element).rgb : u_faded_colour.rgb;
  bool away = looks_away(p[0], p[1], p[2], p[3]), is_inverted = inverted(face.element);
  v_fill = fill * brightness(normal, middle) * side_brightness(away, is_inverted);
  if (!counting && u_others == 1 || hidden_by_others(away, is_inverted)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  // Area without foreshortening: squares face the eye, and everything behind them must not show between them.
  float area = 0.5 * length(normal);
  float pixels_a_unit = 0.5 * u_viewport.y * length(vec3(u_to_clip_space[0][1], u_to_clip_space[1][1], u_to_clip_space[2][1])) / gl_Position.w;
  gl_PointSize = clamp(1.6 * sqrt(area * float(u_stride)) * pixels_a_unit + 0.5, 1.0, 64.0);
}
