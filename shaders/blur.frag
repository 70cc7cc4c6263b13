// How blurred the key light's shadow is around a point of the floor: a level of the pyramid, 0 to 1 for 0 to 4.
// It follows from the average height of the occluders, read from a coarse level.
in vec2 place;
uniform sampler2D occluders;
uniform float penumbra; // level at height 1: log2 of the penumbra in texels
out vec4 pixel;

void main() {
  vec2 around = smoothly(occluders, 0.5 * place + 0.5, 4.0);
  float height = clamp(1.0 - around.y / max(around.x, 1e-4), 0.002, 1.0);
  height = mix(0.002, height, min(8.0 * around.x, 1.0)); // no occluder near: no blur needed
  pixel = vec4(0.25 * clamp(penumbra + log2(height), 0.5, 4.0), 0.0, 0.0, 1.0);
}
