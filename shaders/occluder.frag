// x: coverage, y: proximity to the floor. Blended by maximum: the lowest counts.
in float height;
uniform float sharpness; // exponent of the decrease of proximity with height: 1 or 2
out vec4 pixel;
#ifdef CUT_OUT
in vec2 on_picture;
uniform sampler2D front;
#endif
void main() {
#ifdef CUT_OUT
  if (texture(front, on_picture).a < 0.5) discard;
#endif
  if (height < -0.02) discard; // below the floor
  float near = 1.0 - clamp(height, 0.0, 1.0);
  pixel = vec4(1.0, sharpness > 1.5 ? near * near : near, 0.0, 1.0);
}
