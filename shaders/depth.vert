// Bodies as seen from the key light: depth only. CUT_OUT: of bodies that may have holes.
layout(location = 0) in vec3 position; // [m]
uniform mat4 world_to_clip;
#ifdef CUT_OUT
layout(location = 4) in vec2 place;
out vec2 on_picture;
#endif
void main() {
#ifdef CUT_OUT
  on_picture = place;
#endif
  gl_Position = world_to_clip * vec4(position, 1.0);
}
