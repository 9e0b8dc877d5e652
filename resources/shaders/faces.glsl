// Faces of volume elements, with their positions. Included by shaders that need them.
struct Face {
  uint corners[4];  // the last of a triangle: 0xffffffff less 1, 2, 4 for every edge that is none (from its first, second, third corner)
  uint element;
};
layout(std430, binding = 0) readonly buffer Positions { float positions[]; };  // relative to the middle of the mesh
layout(std430, binding = 3) readonly buffer Faces { Face faces[]; };
layout(std430, binding = 4) readonly buffer Means { float means[]; };  // mean of an element's corners; only while elements are shrunk
uniform mat4 u_to_clip_space;
uniform vec4 u_eye;     // place of the eye, 1; or direction towards it, 0
uniform vec4 u_light;   // direction towards the light
uniform float u_shading;  // 1: faces are lit; 0: their colours depend only on their values
uniform vec4 u_plane;   // clip plane: normal, offset; everything beyond it is left out
uniform float u_shrink; // factor of size about the means; 1: not shrunk
uniform int u_sides;    // 1: the skin of the visible part is closed; 2: both sides of a surface are seen

bool is_triangle(Face face) { return face.corners[3] >= 0xfffffff0u; }

vec3 corner_of(Face face, uint i) {
  uint v = 3u * face.corners[i];
  vec3 point = vec3(positions[v], positions[v + 1u], positions[v + 2u]);
  if (u_shrink == 1.0) return point;
  uint m = 3u * face.element;
  return mix(vec3(means[m], means[m + 1u], means[m + 2u]), point, u_shrink);
}

float kept_by_plane(vec3 point) { return u_plane.w - dot(u_plane.xyz, point); }

vec3 towards_eye(vec3 point) { return u_eye.w > 0.0 ? normalize(u_eye.xyz - point) : u_eye.xyz; }

// Whether a face looks away from the eye: in a closed skin others hide it, but not if its element is inverted, whose outside is inside.
bool looks_away(vec3 a, vec3 b, vec3 c, vec3 d) {
  vec3 to_eye = u_eye.w > 0.0 ? u_eye.xyz - a : u_eye.xyz;
  return dot(cross(b - a, c - a), to_eye) < 0.0 && dot(cross(c - a, d - a), to_eye) <= 0.0;
}

bool hidden_by_others(bool away, bool is_inverted) { return u_sides == 1 && away && !is_inverted; }

// Factor of brightness: a surface is a little darker where its elements look away.
float side_brightness(bool away, bool is_inverted) { return u_sides == 2 && away && !is_inverted ? 0.8 : 1.0; }

// Brightness by a light beside the eye: faces that are turned away are darker, none is dark.
float brightness(vec3 normal, vec3 middle) {
  if (u_shading == 0.0) return 1.0;
  vec3 to_eye = towards_eye(middle);
  float size = length(normal);
  vec3 towards = size > 0.0 ? normal / size : to_eye;
  if (dot(towards, to_eye) < 0.0) towards = -towards;
  return 0.70 + 0.30 * max(dot(towards, u_light.xyz), 0.0);
}
