uniform float u_wire_half_width;  // pixels
uniform vec4 u_wire_colour;       // straight alpha
uniform float u_hatch_period;     // pixels
uniform vec2 u_hatch_phase;       // of the rising and of the falling stripes, periods

flat in vec4 g_fill;
flat in vec2 g_wire_and_size;
noperspective in vec3 g_distance;
layout(location = 0) out vec4 colour;

void main() {
  vec3 fill = g_fill.rgb;
  if (g_fill.a > 0.0) {
    // Diagonal stripes, rising for inverted elements and falling for those without a quality; they need some room.
    vec2 pixel = gl_FragCoord.xy - 0.5 * u_viewport;
    float along = g_fill.a == 1.0 ? (pixel.x - pixel.y) / u_hatch_period + u_hatch_phase.x
                                  : (pixel.x + pixel.y) / u_hatch_period + u_hatch_phase.y;
    float stripe = abs(fract(along) - 0.5) * u_hatch_period;  // distance from the stripe's middle, pixels along x
    float cover = clamp(0.16 * u_hatch_period - stripe + 0.7, 0.0, 1.0) * smoothstep(0.6, 1.6, g_wire_and_size.y / u_hatch_period);
    fill = mix(fill, fill * 0.35, cover);
  }
  float nearest = min(g_distance.x, min(g_distance.y, g_distance.z));
  float line = clamp(u_wire_half_width + 0.5 - nearest, 0.0, 1.0) * min(1.0, 2.0 * u_wire_half_width + 0.5);
  colour = vec4(mix(fill, u_wire_colour.rgb, line * g_wire_and_size.x * u_wire_colour.a), 1.0);
}
