// Bodies as occluders of the floor, with their height above it.
layout(location = 0) in vec3 position; // [m]
uniform mat4 world_to_clip;
uniform float floor_z; // [m]
uniform float reach;   // height that counts as 1 [m]
out float height;
void main() {
  gl_Position = world_to_clip * vec4(position, 1.0);
  height = (position.z - floor_z) / reach;
}
