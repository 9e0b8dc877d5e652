// Colours faces. With GHOST a face is very faint.
#include "hatch.glsl"
uniform float u_wire_half_width;  // pixels
uniform vec4 u_wire_colour;       // straight alpha
uniform vec4 u_ghost_colour;      // straight alpha
flat in vec4 v_fill;
flat in vec2 v_wire_and_size;
flat in vec3 v_edges[3];
layout(location = 0) out vec4 colour;

void main() {
  vec2 pixel = gl_FragCoord.xy - 0.5 * u_viewport;
  vec3 place = vec3(pixel, 1.0);
  float nearest = min(dot(v_edges[0], place), min(dot(v_edges[1], place), dot(v_edges[2], place)));
  float line = clamp(u_wire_half_width + 0.5 - nearest, 0.0, 1.0) * min(1.0, 2.0 * u_wire_half_width + 0.5) * v_wire_and_size.x;
#ifdef GHOST
  float alpha = mix(u_ghost_colour.a, max(u_ghost_colour.a, u_wire_colour.a), line);
  colour = vec4(u_ghost_colour.rgb * alpha, alpha);
#else
  vec3 fill = hatched(v_fill, pixel, v_wire_and_size.y);
  colour = vec4(mix(fill, u_wire_colour.rgb, line * u_wire_colour.a), 1.0);
#endif
}
