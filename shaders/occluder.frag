// x: something is there, y: how near to the floor. Blended by maximum: the lowest counts.
in float height;
uniform float sharpness; // 1: nearness falls with the height, 2: with its square
out vec4 pixel;
void main() {
  if (height < -0.02) discard; // under the floor
  float near = 1.0 - clamp(height, 0.0, 1.0);
  pixel = vec4(1.0, sharpness > 1.5 ? near * near : near, 0.0, 1.0);
}
