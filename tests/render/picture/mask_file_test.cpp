// Pictures whose brightness expressions use: what is read of a file, and where it lies on bodies.
#include "render/picture/mask_file.h"

#include "render/clip/inputs.h"
#include "render/files/png.h"
#include "render/picture/scene_preset.h"
#include "sim/fracture/strength.h"
#include "sim/scene/scene.h"
#include "sim/topology/walk.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace rend::mask_file_test {
namespace {

Image image_of(int channels, const std::vector<std::vector<std::uint8_t>>& pixels, int width) {
  Image image(width, static_cast<int>(pixels.size()) / width, channels);
  image.pixels.clear();
  for (const auto& pixel : pixels) image.pixels.insert(image.pixels.end(), pixel.begin(), pixel.end());
  return image;
}

double decoded(int level) { // IEC 61966-2-1
  const double share = level / 255.0;
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

TEST(MaskFile, is_the_luminance_of_the_picture_in_linear_light) {
  NEEDS_PNG;
  const test::Folder folder;
  write_png(
      folder / "mask.png",
      image_of(3, {{0, 0, 0}, {255, 255, 255}, {188, 188, 188}, {255, 0, 0}, {0, 128, 0}, {0, 0, 255}}, 3));
  const auto mask = read_mask(folder / "mask.png");
  EXPECT_EQ(mask->width, 3);
  EXPECT_EQ(mask->height, 2);
  const std::vector<double> expected{0, 1, decoded(188), 0.2126, 0.7152 * decoded(128), 0.0722};
  EXPECT_THAT(mask->brightness, testing::Pointwise(testing::DoubleNear(2e-4), expected));
  EXPECT_EQ(mask->brightness[0], 0);
  EXPECT_EQ(mask->brightness[1], 1);
  EXPECT_NEAR(mask->brightness[2], 0.5, 0.005);
}

TEST(MaskFile, is_white_where_the_picture_is_transparent) {
  NEEDS_PNG;
  const test::Folder folder;
  write_png(folder / "mask.png", image_of(4, {{0, 0, 0, 0}, {0, 0, 0, 255}, {0, 0, 0, 51}}, 3));
  EXPECT_THAT(read_mask(folder / "mask.png")->brightness,
              testing::Pointwise(testing::DoubleNear(1e-6), std::vector<double>{1, 0, 0.8}));
}

// A scene in a folder with a picture four times as wide as high, mask.png, and mesh.obj.
struct Scened {
  explicit Scened(const std::string& body, const std::string& strength, const std::string& mesh = "") {
    std::ofstream(folder / "mesh.obj") << mesh;
    write_png(folder / "mask.png",
              image_of(3, {{0, 0, 0}, {255, 255, 255}, {255, 255, 255}, {255, 255, 255}}, 4));
    preset = load_scene_text(
        fmt::format(
            R"(<scene name="masked"><body>{}<mass total="0.1"/><elasticity young="1e5" thickness="1e-3"/>
                       <tear criterion="vertex-stress" threshold="1e9" {}/></body>
                       <time step="1e-5" duration="1"/></scene>)",
            body, strength),
        (folder / "masked.xml").string());
    scene = std::make_unique<Scene>(read_scene(*preset, scene_pictures()), SceneOptions{});
  }
  const EmbeddedMap& map() const { return *scene->bodies()[0]->map; }

  // Calls f(darts of an element, its strength).
  template <class F> void each_element(F&& f) const {
    const auto* column = find_column<ElementStrength>(map());
    ASSERT_NE(column, nullptr);
    const CellIndex& elements = map().cells(column->orbit());
    for (Slot e = 0; e < elements.slots(); ++e)
      f(darts_of(map().map(), column->orbit(), elements.first_dart(e)), (*column)[e]);
  }

  test::Folder folder;
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
};

TEST(MaskFile, lies_by_the_texture_coordinates_of_a_mesh) {
  NEEDS_PNG;
  // The square of two triangles, whose pictures are apart: means (0.2, 0.1) and (0.6, 0.8).
  const Scened scened(R"(<mesh file="mesh.obj"/>)", R"(strength="1 + u + 10*v")",
                      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                      "vt 0 0\nvt 0.6 0\nvt 0 0.3\nvt 0.3 0.6\nvt 0.9 0.9\nvt 0.6 0.9\n"
                      "f 1/1 2/2 3/3\nf 1/4 3/5 4/6\n");
  int faces = 0;
  scened.each_element([&](const std::vector<Dart>& darts, double strength) {
    bool upper = false;
    for (Dart d : darts) upper = upper || scened.map().rest_of(d) == Vec3(0, 1, 0);
    EXPECT_NEAR(strength, upper ? 1 + 0.6 + 8 : 1 + 0.2 + 1, 1e-6); // the file's numbers are doubles
    ++faces;
  });
  EXPECT_EQ(faces, 2);
}

TEST(MaskFile, lies_on_an_outline_as_its_texture_does) {
  NEEDS_PNG;
  const Scened scened(R"(<outline shape="star" size="0.2" cell="0.02"/>
                         <place scale="2" rotate="90 0 0" translate="1 2 3"/>)",
                      R"(picture="mask.png" strength="100 + u + 10*v + 0*picture")");
  Vec3 low = Vec3::Constant(1e9), high = -low;
  scened.map().map().for_each_dart([&](Dart d) {
    low = low.cwiseMin(scened.map().rest_of(d));
    high = high.cwiseMax(scened.map().rest_of(d));
  });
  const Vec3 whole = (low + high) / 2;
  const double extent = (high - low).maxCoeff();
  ASSERT_GT(extent, 0.3);
  int faces = 0;
  scened.each_element([&](const std::vector<Dart>& darts, double strength) {
    Vec3 middle = Vec3::Zero();
    for (Dart d : darts) middle += scened.map().rest_of(d) / static_cast<double>(darts.size());
    const Vec3 from = middle - whole;
    const double u = from.x() / extent + 0.5, v = 4 * from.z() / extent + 0.5; // four times as wide as high
    EXPECT_NEAR(strength, 100 + u + 10 * v, 1e-6);
    ++faces;
  });
  EXPECT_GT(faces, 50);
}

TEST(MaskFile, is_a_file_of_the_preset_as_others_are) {
  NEEDS_PNG;
  const Scened scened(R"(<sheet cells="4 4" size="1 1"/>)", R"(picture="mask.png")");
  const std::string before = hashes_of_files(*scened.preset);
  EXPECT_THAT(before, testing::StartsWith("tear "));
  write_png(scened.folder / "mask.png", image_of(3, {{1, 2, 3}}, 1));
  EXPECT_NE(hashes_of_files(*scened.preset), before) << "a checkpoint of the other picture is not resumed";
}

} // namespace
} // namespace rend::mask_file_test
