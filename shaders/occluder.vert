// Bodies as occluders of the floor, with their height above it. CUT_OUT: bodies that may have holes.
layout(location = 0) in vec3 position; // [m]
uniform mat4 world_to_clip;
uniform float floor_z; // [m]
uniform float reach;   // height that counts as 1 [m]
out float height;
#ifdef CUT_OUT
layout(location = 4) in vec2 place;
out vec2 on_picture;
#endif
void main() {
#ifdef CUT_OUT
  on_picture = place;
#endif
  gl_Position = world_to_clip * vec4(position, 1.0);
  height = (position.z - floor_z) / reach;
}
