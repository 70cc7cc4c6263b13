#include "render/draw/rect_painter.h"

namespace rend {

RectPainter::RectPainter() {
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(Eigen::Vector2f), nullptr);
  glEnableVertexAttribArray(0);
}

void RectPainter::draw(const std::vector<PixelRect>& boxes, int width, int height) {
  corners_.clear();
  for (const PixelRect& box : boxes) {
    const auto corner = [&](int x, int y) {
      return Eigen::Vector2f(2.0f * static_cast<float>(x) / static_cast<float>(width) - 1,
                             2.0f * static_cast<float>(y) / static_cast<float>(height) - 1);
    };
    const int right = box.x + box.width, top = box.y + box.height;
    corners_.insert(corners_.end(), {corner(box.x, box.y), corner(right, box.y), corner(right, top),
                                     corner(box.x, box.y), corner(right, top), corner(box.x, top)});
  }
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners_.size() * sizeof(Eigen::Vector2f)),
               corners_.data(), GL_STREAM_DRAW);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners_.size()));
}

} // namespace rend
