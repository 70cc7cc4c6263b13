#ifdef CUT_OUT
in vec2 on_picture;
uniform sampler2D front;
void main() {
  if (texture(front, on_picture).a < 0.5) discard;
}
#else
void main() {}
#endif
