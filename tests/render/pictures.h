// Small frames and a temporary folder, for the tests of render/.
#pragma once

#include "render/draw/frame.h"
#include "render/files/image.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace rend::test {

using Colour = std::array<std::uint8_t, 4>;
constexpr Colour red{220, 30, 30, 255}, green{30, 200, 40, 255}, grey{180, 180, 180, 255};

// A temporary folder, removed at the end of the test.
class Folder {
public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "rend-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  int files() const { return static_cast<int>(std::distance(std::filesystem::directory_iterator(path_), {})); }

private:
  std::filesystem::path path_;
};

// A triangle with a zero normal (flat), and the lines opposite to a, b and c.
inline void add_triangle(FrameBody& body, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                         const Eigen::Vector3f& c, Colour colour, std::array<Line, 3> lines = {}) {
  for (const Eigen::Vector3f& point : {a, b, c}) {
    Corner corner{};
    for (std::size_t k = 0; k < 3; ++k) corner.position[k] = point[static_cast<Eigen::Index>(k)];
    corner.colour = colour;
    for (std::size_t k = 0; k < 3; ++k) corner.line[k] = static_cast<std::uint8_t>(lines[k]);
    body.corners.push_back(corner);
  }
}

// A square of two triangles across the y axis, |x|, |z| < half, at y; `line` along its four sides.
inline FrameBody screen(float y, float half, Colour colour, Line line = Line::None) {
  FrameBody body;
  const Eigen::Vector3f a(-half, y, -half), b(half, y, -half), c(half, y, half), d(-half, y, half);
  add_triangle(body, a, b, c, colour, {line, Line::None, line});
  add_triangle(body, a, c, d, colour, {line, line, Line::None});
  return body;
}

// A horizontal square, |x|, |y| < half, at z.
inline FrameBody table(float z, float half, Colour colour) {
  FrameBody body;
  const Eigen::Vector3f a(-half, -half, z), b(half, -half, z), c(half, half, z), d(-half, half, z);
  add_triangle(body, a, b, c, colour);
  add_triangle(body, a, c, d, colour);
  return body;
}

// Seen from -y, straight on: x to the right, z up.
inline Frame front_view() {
  Frame frame;
  frame.camera.eye = {0, -4, 0};
  frame.camera.target = {0, 0, 0};
  return frame;
}

inline int brightness(const Image& image, int x, int y) {
  const std::uint8_t* pixel = image.at(x, y);
  return pixel[0] + pixel[1] + pixel[2];
}

inline int largest_difference(const Image& a, const Image& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
  return largest;
}

// A picture whose content depends on `seed`.
inline Image pattern(int width, int height, int channels = 3, int seed = 0) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width * channels; ++x)
      image.row(y)[x] = static_cast<std::uint8_t>(x * 3 + y * 5 + seed * 7);
  return image;
}

} // namespace rend::test
