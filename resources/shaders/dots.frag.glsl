uniform float u_casing_width;
uniform float u_ring_width;
noperspective in vec2 v_offset;
flat in vec2 v_size;
flat in vec4 v_fill;
flat in vec4 v_casing;
layout(location = 0) out vec4 colour;

void main() {
  // Signed distance from the filled shape's border.
  float away;
  if (v_size.y == 1.0) {
    away = max(abs(v_offset.x), abs(v_offset.y)) - v_size.x;
  } else if (v_size.y == 3.0) {
    vec2 side = abs(v_offset);
    away = max(0.7071 * abs(side.x - side.y) - 0.5 * u_ring_width, max(side.x, side.y) - v_size.x);
  } else if (v_size.y == 4.0) {
    away = 0.7071 * (abs(v_offset.x) + abs(v_offset.y) - v_size.x);
  } else {
    away = length(v_offset) - v_size.x;
    if (v_size.y == 2.0) away = abs(away) - 0.5 * u_ring_width;
  }
  float fill = clamp(0.5 - away, 0.0, 1.0) * v_fill.a;
  float casing = clamp(0.5 + u_casing_width - away, 0.0, 1.0) * v_casing.a;
  vec4 under = vec4(v_casing.rgb * casing, casing);
  colour = vec4(v_fill.rgb * fill, fill) + under * (1.0 - fill);
  if (colour.a <= 0.0) discard;
}
