// A dot, drawn as a square of six vertices around it.
struct Dot {
  vec4 place;   // middle in pixels, diameter, shape: 0 round, 1 square, 2 ring, 3 cross, 4 diamond
  vec4 fill;    // straight alpha
  vec4 casing;
};
layout(std430, binding = 4) readonly buffer Dots { Dot dots[]; };
uniform float u_casing_width;  // pixels
noperspective out vec2 v_offset;
flat out vec2 v_size;  // radius, shape
flat out vec4 v_fill;
flat out vec4 v_casing;

void main() {
  Dot dot = dots[uint(gl_VertexID) / 6u];
  uint corner = uint(gl_VertexID) % 6u;
  vec2 side = vec2(corner == 0u || corner == 2u || corner == 3u ? -1.0 : 1.0, corner == 0u || corner == 1u || corner == 4u ? -1.0 : 1.0);
  v_size = vec2(0.5 * dot.place.z, dot.place.w);
  v_fill = dot.fill;
  v_casing = dot.casing;
  v_offset = side * (v_size.x + 2.0 * u_casing_width + 2.0);
  gl_Position = to_clip(dot.place.xy + v_offset, 0.0);
}
