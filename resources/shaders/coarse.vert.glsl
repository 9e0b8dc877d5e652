// One square stands for u_stride elements that follow each other along the drawn order, which keeps neighbours together.
layout(std430, binding = 0) readonly buffer Positions { vec2 positions[]; };
layout(std430, binding = 1) readonly buffer Shades { float shades[]; };
layout(std430, binding = 2) readonly buffer Order { uint order[]; };
layout(std430, binding = 3) readonly buffer Corners { uint corners[]; };
uniform uint u_first;
uniform uint u_last;
uniform uint u_stride;
uniform uint u_corner_count;
uniform sampler2D u_colours;
uniform vec2 u_range;
uniform vec4 u_inverted_colour;
uniform vec4 u_undefined_colour;
flat out vec3 v_fill;

void main() {
  uint drawn = u_first + uint(gl_VertexID) * u_stride;
  uint base = drawn * u_corner_count;
  vec2 corner[4];
  vec2 middle = vec2(0.0);
  for (uint i = 0u; i < u_corner_count; ++i) {
    corner[i] = to_pixels(positions[corners[base + i]]);
    middle += corner[i];
  }
  middle /= float(u_corner_count);
  float area = 0.0;
  for (uint i = 0u; i < u_corner_count; ++i) {
    vec2 a = corner[i] - middle, b = corner[(i + 1u) % u_corner_count] - middle;
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  float shade = shades[order[drawn]];
  // An inverted element must not vanish among its neighbours.
  for (uint i = 1u; i < u_stride && drawn + i < u_last; ++i) {
    float other = shades[order[drawn + i]];
    if (other < -1e38) shade = other;
  }
  bool inverted = shade < -1e38;
  if (inverted) {
    v_fill = u_inverted_colour.rgb;
  } else if (shade > 1e38) {
    v_fill = u_undefined_colour.rgb;
  } else {
    int last = textureSize(u_colours, 0).x - 1;
    float t = clamp((shade - u_range.x) / (u_range.y - u_range.x), 0.0, 1.0);
    v_fill = texelFetch(u_colours, ivec2(int(t * float(last) + 0.5), 0), 0).rgb;
  }
  gl_Position = to_clip(middle, inverted ? -0.5 : 0.0);
  gl_PointSize = clamp(1.7 * sqrt(abs(area) * float(u_stride)) + 0.5, 1.0, 64.0);
}
