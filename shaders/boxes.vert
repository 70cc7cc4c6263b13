// Rectangles of a picture (render/draw/rect_painter.h).
layout(location = 0) in vec2 at; // corners of the picture at -1 and 1
out vec2 place;
void main() {
  place = at;
  gl_Position = vec4(at, 1.0, 1.0);
}
