#include "render/draw/composite.h"

#include "render/draw/device.h"
#include "render/draw/light.h"
#include "tests/render/draw/drawing.h"
#include "tests/render/pictures.h"

#include <cmath>
#include <random>

namespace rend::composite_test {
namespace {

using namespace test;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int width = 107, height = 70; // blocks are cut off at the right and at the top
constexpr double aspect = static_cast<double>(width) / height;
constexpr Pixel garbage{11, 222, 33, 144}; // the picture before the pass

Vector2d place_of(int x, int y) { // normalized device coordinates
  return {2 * (x + 0.5) / width - 1, 2 * (y + 0.5) / height - 1};
}

// Textures with known samples. Colours are premultiplied by alpha.
class KnownBodies {
public:
  // Size of the textures [pixels of the picture], from the picture's corner. seed 0: all samples are empty.
  KnownBodies(int across, int up, int samples, int supersampling, unsigned seed)
      : across_(across * supersampling), up_(up * supersampling), samples_(samples),
        supersampling_(supersampling) {
    std::mt19937 random(seed);
    const auto up_to = [&](int most) {
      return static_cast<std::uint8_t>(std::uniform_int_distribution(0, most)(random));
    };
    for (int k = 0; k < samples; ++k) {
      Pixels& all = layers_.emplace_back(static_cast<std::size_t>(across_) * static_cast<std::size_t>(up_));
      for (Pixel& pixel : all) {
        if (seed == 0) continue;
        const std::array<std::uint8_t, 4> alphas{0, 255, 255, up_to(255)};
        const std::uint8_t alpha = alphas[up_to(3)];
        pixel = {up_to(alpha), up_to(alpha), up_to(alpha), alpha};
      }
    }
    samples == 1 ? upload(colours_, layers_[0]) : draw_samples();
  }

  BodyTargets picture() const { return {colours_.name(), 0, samples_, supersampling_, {0, 0, width, height}}; }

  // Of one pixel of the picture [0 to 255].
  Eigen::Vector4d mean(int x, int y) const {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (const Pixels& all : layers_)
      for (int j = supersampling_ * y; j < supersampling_ * (y + 1); ++j)
        for (int i = supersampling_ * x; i < supersampling_ * (x + 1); ++i) {
          const Pixel& pixel = all[static_cast<std::size_t>(j * across_ + i)];
          sum += Eigen::Vector4d(pixel[0], pixel[1], pixel[2], pixel[3]);
        }
    return sum / (samples_ * supersampling_ * supersampling_);
  }

private:
  void upload(const GlTexture& texture, const Pixels& pixels) const {
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, across_, up_, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  }
  // Draws one sample after another from a texture with the wanted values.
  void draw_samples() const {
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, colours_.name());
    glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples_, GL_RGBA8, across_, up_, GL_TRUE);
    const GlFramebuffer target;
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, colours_.name(), 0);
    check_framebuffer("KnownBodies");
    glViewport(0, 0, across_, up_);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_SAMPLE_MASK);
    const FragmentProgram copy("uniform sampler2D source; out vec4 pixel;\n"
                               "void main() { pixel = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }");
    copy.use();
    glActiveTexture(GL_TEXTURE0);
    RectPainter boxes;
    for (int k = 0; k < samples_; ++k) {
      const GlTexture source;
      upload(source, layers_[static_cast<std::size_t>(k)]);
      glSampleMaski(0, 1U << static_cast<unsigned>(k));
      boxes.draw({{0, 0, across_, up_}}, across_, up_);
    }
    glDisable(GL_SAMPLE_MASK);
  }

  int across_, up_, samples_, supersampling_; // [texels]
  std::vector<Pixels> layers_;                // one per sample
  GlTexture colours_;
};

class CompositeTest : public testing::Test {
protected:
  static void SetUpTestSuite() { device_ = make_device(); }
  static void TearDownTestSuite() { device_.reset(); }

  static View view(const Frame& frame) { return view_of(frame.camera, {}, aspect); }
  static Frame over_a_floor(const Vector3d& eye) {
    Frame frame;
    frame.camera.eye = eye;
    frame.camera.target = {0.2, 0.1, 0.3};
    frame.floor = FrameFloor{-0.4};
    frame.background = {0.8f, 0.9f, 0.5f};
    return frame;
  }
  // Looking down, with the horizon in the picture, and from below the floor.
  static std::vector<Frame> frames() {
    std::vector<Frame> all{over_a_floor({3, -3, 4}), over_a_floor({3, -3, 0.5}), over_a_floor({1, -3, -1})};
    all.push_back(all[0]);
    all.back().floor.reset();
    return all;
  }

  // Casts shadows of the frame's bodies onto its floor.
  static void cast(FloorShadow& shadow, const Frame& frame) {
    if (!frame.floor) return;
    const std::vector<Corner> none;
    const std::vector<Corner>& corners = frame.bodies.empty() ? none : frame.bodies[0].corners;
    const GlVertexArray array;
    const GlBuffer buffer;
    glBindVertexArray(array.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(Corner)), corners.data(),
                 GL_STATIC_DRAW);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Corner), nullptr);
    glEnableVertexAttribArray(0);
    Eigen::AlignedBox3d bounds;
    for (const Corner& corner : corners)
      bounds.extend(Eigen::Map<const Eigen::Vector3f>(corner.position.data()).cast<double>());
    glEnable(GL_DEPTH_CLAMP);
    shadow.build(frame.floor->z, view(frame).distance, lights_of(frame).key,
                 lit_bounds(frame.camera, aspect, bounds), {corners}, [&] {
                   glBindVertexArray(array.name());
                   glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
                 });
    glDisable(GL_DEPTH_CLAMP);
  }

  static Pixels drawn(const Frame& frame, const KnownBodies& bodies, const CoverageGrid& blocks) {
    FloorShadow shadow;
    cast(shadow, frame);
    const Canvas canvas(width, height, garbage);
    Composite composite(width, height);
    canvas.bind();
    composite.draw(frame, view(frame), bodies.picture(), blocks, shadow, nullptr);
    return canvas.read();
  }

  static CoverageGrid all_blocks() {
    CoverageGrid blocks = blocks_of(width, height);
    blocks.mark_all();
    return blocks;
  }

private:
  static inline std::unique_ptr<Device> device_;
};

// The studio without shadows, by a ray to the floor for each pixel [0 to 255].
Vector3d studio(const Frame& frame, const View& view, int x, int y) {
  const Vector2d place = place_of(x, y), from = place - Vector2d(0, 0.15);
  const double fall = 0.11 * from.x() * from.x() + 0.16 * from.y() * from.y();
  double left = 1;
  if (frame.floor && view.eye.z() > frame.floor->z) {
    const Eigen::Vector4d far = view.world_to_clip().inverse() * Eigen::Vector4d(place.x(), place.y(), 1, 1);
    const Vector3d along = far.head<3>() / far.w() - view.eye;
    if (along.z() < 0) {
      const Vector3d hit = view.eye + (frame.floor->z - view.eye.z()) / along.z() * along;
      const double reach = 4 * view.distance; // where the floor has faded into the backdrop
      const double away = std::min((hit - frame.camera.target).head<2>().squaredNorm() / (reach * reach), 1.0);
      const double pool = std::max(1 - 4 * away, 0.0), fade = away * away * (3 - 2 * away);
      left = (0.94 + 0.08 * pool * pool) * (1 - fade) + fade;
    }
  }
  Vector3d out;
  for (int c = 0; c < 3; ++c) {
    const double background = frame.background[static_cast<std::size_t>(c)];
    out[c] = 255 * std::sqrt(std::clamp(background * background * (1 - fall) * left, 0.0, 1.0));
  }
  return out;
}

double apart(const Pixel& pixel, const Vector3d& colour) {
  return (Vector3d(pixel[0], pixel[1], pixel[2]) - colour).cwiseAbs().maxCoeff();
}

TEST_F(CompositeTest, WhereNoBodyIsTheStudioIsSeen) {
  const KnownBodies none(1, 1, 4, 1, 0);
  for (const Frame& frame : frames()) {
    const Pixels found = drawn(frame, none, blocks_of(width, height));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Pixel& pixel = found[static_cast<std::size_t>(y * width + x)];
        ASSERT_LE(apart(pixel, studio(frame, view(frame), x, y)), 1) << x << " " << y;
        ASSERT_EQ(pixel[3], 255);
      }
  }
}

// Its shadows, laid over the studio's light, take as much of it as they do in the opaque picture.
TEST_F(CompositeTest, AFloorThatShowsByItsShadowsAlone) {
  const KnownBodies none(width, height, 4, 1, 0);
  const CoverageGrid blocks = blocks_of(width, height);
  for (Frame frame : frames()) {
    frame.background = {0.8f, 0.8f, 0.8f};
    const Pixels bare = drawn(frame, none, blocks);
    frame.bodies.push_back(table(-0.1f, 0.3f, red));
    const Pixels opaque = drawn(frame, none, blocks);
    frame.transparent = frame.floor_shadow = true;
    const Pixels found = drawn(frame, none, blocks);
    int shaded = 0;
    for (std::size_t n = 0; n < found.size(); ++n) {
      ASSERT_EQ(std::max({found[n][0], found[n][1], found[n][2]}), 0);
      const double left = 1 - found[n][3] / 255.0;
      ASSERT_NEAR(bare[n][1] * left, opaque[n][1], 2.5) << n;
      shaded += found[n][3] > 20;
    }
    const bool floor_seen = frame.floor && frame.camera.eye.z() > frame.floor->z;
    EXPECT_EQ(shaded > 50, floor_seen) << shaded;
  }
}

// The textures cover only the blocks that bodies may cover: two of four columns, two of three rows.
TEST_F(CompositeTest, APixelIsTheMeanOfItsSamplesOverWhatIsBehind) {
  CoverageGrid blocks = blocks_of(width, height);
  blocks.mark(0, 0, 1.5f, 0.5f);
  blocks.mark(0, 1, 0.5f, 1.5f);
  for (const auto& [samples, supersampling] : {std::pair(1, 1), {1, 2}, {4, 1}, {4, 2}}) {
    const KnownBodies bodies(64, 64, samples, supersampling, 5);
    for (const Frame& frame : frames()) {
      const Pixels found = drawn(frame, bodies, blocks);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const bool covered = blocks.at(x / block_side, y / block_side);
          const Eigen::Vector4d own = covered ? bodies.mean(x, y) : Eigen::Vector4d::Zero();
          const Vector3d colour = own.head<3>() + (1 - own.w() / 255) * studio(frame, view(frame), x, y);
          ASSERT_LE(apart(found[static_cast<std::size_t>(y * width + x)], colour), 1)
              << x << " " << y << ", " << samples << " samples of " << supersampling;
        }
    }
  }
}

TEST_F(CompositeTest, ATransparentPictureHasNothingBehind) {
  CoverageGrid blocks = blocks_of(width, height);
  blocks.mark(1.2f, 0.2f, 2.8f, 1.5f);
  for (const int samples : {1, 4}) {
    const KnownBodies bodies(width, height, samples, 1, 9);
    for (Frame frame : frames()) {
      frame.transparent = true;
      const Pixels found = drawn(frame, bodies, blocks);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const Pixel& pixel = found[static_cast<std::size_t>(y * width + x)];
          if (!blocks.at(x / block_side, y / block_side)) {
            ASSERT_EQ(pixel, Pixel{}) << x << " " << y;
            continue;
          }
          const Eigen::Vector4d own = bodies.mean(x, y);
          ASSERT_LE(apart(pixel, own.head<3>()), 0.51) << x << " " << y;
          ASSERT_LE(std::abs(pixel[3] - own.w()), 0.51) << x << " " << y;
        }
    }
  }
}

// Most blocks are drawn by specialized programs that omit what a block does not need. Compares with drawing all
// of them with bodies and shadow.
TEST_F(CompositeTest, BlocksOfEveryKindComeOutAsByTheMostGeneralProgram) {
  const KnownBodies none(width, height, 4, 1, 0);
  CoverageGrid some = blocks_of(width, height);
  some.mark(1, 1, 1.5f, 1.5f);
  for (Frame frame : frames()) {
    const Pixels bare = drawn(frame, none, all_blocks());
    frame.bodies.push_back(table(-0.1f, 0.3f, red));
    const Pixels general = drawn(frame, none, all_blocks()), found = drawn(frame, none, some);
    int worst = 0, shaded = 0;
    for (std::size_t n = 0; n < found.size(); ++n) {
      for (std::size_t c = 0; c < 4; ++c) worst = std::max(worst, std::abs(found[n][c] - general[n][c]));
      shaded += bare[n] != general[n];
    }
    EXPECT_LE(worst, 1); // rounding between two of 255 levels
    const bool floor_seen = frame.floor && frame.camera.eye.z() > frame.floor->z;
    EXPECT_EQ(shaded > 50, floor_seen) << shaded;
    EXPECT_LT(shaded, width * height / 2) << "there is floor without a shadow";
  }
}

} // namespace
} // namespace rend::composite_test
