// Share of its colour that a pixel keeps: less in corners, which little light would reach, and along edges and outlines. It depends only on
// depths, without chance, so that the same scene gives the same picture, in one piece or in parts.
uniform sampler2D u_depth;
uniform mat4 u_from_clip_space;
uniform float u_reach;  // radius in pixels of the neighbourhood that counts
uniform float u_line;   // width of edges in pixels
uniform float u_most;   // greatest share that corners take away
uniform float u_line_strength;  // greatest share that sharp edges take away
layout(location = 0) out vec4 colour;

const int kAround = 20, kNear = 8;

float depth_at(ivec2 pixel) { return texelFetch(u_depth, clamp(pixel, ivec2(0), textureSize(u_depth, 0) - 1), 0).r; }

vec3 point_at(vec2 pixel, float depth) {
  vec4 point = u_from_clip_space * vec4((pixel + 0.5) * 2.0 / u_viewport - 1.0, 2.0 * depth - 1.0, 1.0);
  return point.xyz / point.w;
}

// Step along the surface from one pixel to the next, on the side where it goes on.
vec3 along(ivec2 pixel, vec3 here, float depth, ivec2 step) {
  float after = depth_at(pixel + step), before = depth_at(pixel - step);
  if (abs(after - depth) < abs(before - depth)) return point_at(vec2(pixel + step), after) - here;
  return here - point_at(vec2(pixel - step), before);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  if (depth >= 1.0) discard;
  vec3 here = point_at(vec2(pixel), depth);
  float unit = distance(point_at(vec2(pixel) + vec2(1.0, 0.0), depth), here);  // width of a pixel, in units of the mesh
  vec3 outwards = normalize(cross(along(pixel, here, depth, ivec2(1, 0)), along(pixel, here, depth, ivec2(0, 1))));
  float reach = u_reach * unit, closed = 0.0, all = 0.0;
  for (int i = 0; i < kAround; ++i) {
    float turn = 2.39996323 * float(i);
    vec2 away = u_reach * sqrt((float(i) + 0.5) / float(kAround)) * vec2(cos(turn), sin(turn));
    ivec2 at = pixel + ivec2(floor(away + 0.5));
    float share = 1.0 - dot(away, away) / (u_reach * u_reach);
    all += share;
    float there = depth_at(at);
    if (there >= 1.0) continue;
    vec3 way = point_at(vec2(at), there) - here;
    float square = dot(way, way), rises = dot(outwards, way) * inversesqrt(max(square, 1e-30));
    closed += max(rises - 0.1, 0.0) * max(1.0 - square / (reach * reach), 0.0);
  }
  float edge = 0.0;
  for (int i = 0; i < kNear; ++i) {
    float turn = 0.78539816 * float(i);
    ivec2 at = pixel + ivec2(floor(u_line * vec2(cos(turn), sin(turn)) + 0.5));
    float there = depth_at(at);
    if (there >= 1.0) continue;
    vec3 way = point_at(vec2(at), there) - here;
    edge += max(-dot(outwards, way) * inversesqrt(max(dot(way, way), 1e-30)) - 0.15, 0.0);
  }
  // Faces keep most of their colour; a sharp edge is a line, like the edges of elements.
  float taken = clamp(2.6 * closed / all, 0.0, 1.0), line = smoothstep(0.14, 0.26, edge / float(kNear));
  colour = vec4(vec3((1.0 - u_most * taken) * (1.0 - u_line_strength * line)), 1.0);
}
