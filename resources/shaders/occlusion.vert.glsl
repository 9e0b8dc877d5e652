// Draws one triangle over the whole picture, with the matrix that leads from clip space back to the mesh.
uniform mat4 u_to_clip_space;
flat out mat4 v_from_clip_space;

void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
  v_from_clip_space = inverse(u_to_clip_space);
}
