#include "fill.glsl"
#include "hatch.glsl"
uniform float u_wire_half_width;  // pixels
uniform vec4 u_wire_colour;       // straight alpha
uniform vec4 u_hollow_fill;       // inside of an element of which only the outline is drawn; premultiplied
uniform vec4 u_hollow_colour;     // outline of such an element

flat in vec4 g_fill;
flat in vec2 g_wire_and_size;
noperspective in vec3 g_distance;
#ifdef BY_CORNERS
flat in vec4 g_corners[2];
flat in vec4 g_values;
#endif
layout(location = 0) out vec4 colour;

void main() {
  vec2 pixel = gl_FragCoord.xy - 0.5 * u_viewport;
  vec4 plain = g_fill;
#ifdef BY_CORNERS
  if (plain.a == 0.0 || plain.a == 2.0) {
    vec4 away = vec4(distance(pixel, g_corners[0].xy), distance(pixel, g_corners[0].zw), distance(pixel, g_corners[1].xy),
                     distance(pixel, g_corners[1].zw));
    float nearest = min(min(away.x, away.y), min(away.z, away.w));
    plain = colour_of(away.x == nearest ? g_values.x : away.y == nearest ? g_values.y : away.z == nearest ? g_values.z : g_values.w);
  }
#endif
  float nearest = min(g_distance.x, min(g_distance.y, g_distance.z));
  if (plain.a == 1.0) {
    // Inverted elements lie over others, which stay visible between their stripes and their outline. A small one is all colour.
    float solid = 1.0 - smoothstep(0.6, 1.6, g_wire_and_size.y / u_hatch_period);
    if (nearest > 2.0 * u_wire_half_width + 0.5 && max(solid, stripes(pixel)) < 0.5) discard;
    colour = vec4(plain.rgb, 1.0);
    return;
  }
  vec3 fill = hatched(plain, pixel, g_wire_and_size.y);
  float line = clamp(u_wire_half_width + 0.5 - nearest, 0.0, 1.0) * min(1.0, 2.0 * u_wire_half_width + 0.5) * g_wire_and_size.x;
  colour = plain.a == 3.0 ? mix(u_hollow_fill, vec4(u_hollow_colour.rgb, 1.0), line)
                          : vec4(mix(fill, u_wire_colour.rgb, line * u_wire_colour.a), 1.0);
}
