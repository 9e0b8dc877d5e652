// Share of its colour that a pixel keeps: less in corners, which little light would reach, and along edges and outlines. It depends only on
// depths, without chance, so that the same scene gives the same picture, in one piece or in parts.
uniform sampler2D u_depth;
flat in mat4 v_from_clip_space;
uniform float u_reach;  // radius in pixels of the neighbourhood that counts
uniform float u_line;   // width of edges in pixels
uniform float u_most;   // greatest share that corners take away
uniform float u_line_strength;  // greatest share that sharp edges take away
layout(location = 0) out vec4 colour;

const int kAround = 20, kNear = 8;
const mat2 kGoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888), kEighthTurn = 0.70710678 * mat2(1.0, 1.0, -1.0, 1.0);

float depth_at(ivec2 pixel) { return texelFetch(u_depth, clamp(pixel, ivec2(0), textureSize(u_depth, 0) - 1), 0).r; }

// Point at a pixel and depth, as the sum of columns: `to_here` is that of this pixel at depth 0, and `away` leads from it to the other one.
vec3 point_at(vec4 to_here, vec2 away, float depth) {
  vec4 point = to_here + 2.0 * (away.x / u_viewport.x * v_from_clip_space[0] + away.y / u_viewport.y * v_from_clip_space[1] + depth * v_from_clip_space[2]);
  return point.xyz / point.w;
}

// Step along the surface from one pixel to the next, on the side where it goes on.
vec3 along(vec4 to_here, ivec2 pixel, vec3 here, float depth, ivec2 step) {
  float after = depth_at(pixel + step), before = depth_at(pixel - step);
  if (abs(after - depth) < abs(before - depth)) return point_at(to_here, vec2(step), after) - here;
  return here - point_at(to_here, vec2(-step), before);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  if (depth >= 1.0) discard;
  vec4 to_here = v_from_clip_space * vec4((vec2(pixel) + 0.5) * 2.0 / u_viewport - 1.0, -1.0, 1.0);
  vec3 here = point_at(to_here, vec2(0.0), depth);
  float unit = distance(point_at(to_here, vec2(1.0, 0.0), depth), here);  // width of a pixel, in units of the mesh
  vec3 outwards = normalize(cross(along(to_here, pixel, here, depth, ivec2(1, 0)), along(to_here, pixel, here, depth, ivec2(0, 1))));
  float reach = u_reach * unit, closed = 0.0;
  vec2 turned = vec2(1.0, 0.0);
  for (int i = 0; i < kAround; ++i) {
    vec2 away = floor(u_reach * sqrt((float(i) + 0.5) / float(kAround)) * turned + 0.5);
    turned = kGoldenTurn * turned;
    float there = depth_at(pixel + ivec2(away));
    if (there >= 1.0) continue;
    vec3 way = point_at(to_here, away, there) - here;
    float square = dot(way, way), rises = dot(outwards, way) * inversesqrt(max(square, 1e-30));
    closed += max(rises - 0.1, 0.0) * max(1.0 - square / (reach * reach), 0.0);
  }
  float edge = 0.0;
  turned = vec2(1.0, 0.0);
  for (int i = 0; i < kNear; ++i) {
    vec2 away = floor(u_line * turned + 0.5);
    turned = kEighthTurn * turned;
    float there = depth_at(pixel + ivec2(away));
    if (there >= 1.0) continue;
    vec3 way = point_at(to_here, away, there) - here;
    edge += max(-dot(outwards, way) * inversesqrt(max(dot(way, way), 1e-30)) - 0.15, 0.0);
  }
  // Faces keep most of their colour; a sharp edge is a line, like the edges of elements.
  float taken = clamp(2.6 * closed / (0.5 * float(kAround)), 0.0, 1.0), line = smoothstep(0.14, 0.26, edge / float(kNear));
  colour = vec4(vec3((1.0 - u_most * taken) * (1.0 - u_line_strength * line)), 1.0);
}
