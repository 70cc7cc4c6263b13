// Pictures that presets name: where they may lie, what is refused and how, and that they count as a part of the
// scene.
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"
#include "tests/render/png_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace rend::texture_command_test {
namespace {

using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string preset(const std::string& look, const std::string& shape = R"(<sheet cells="2 2" size="1 1"/>)") {
  return R"(<scene name="s"><body>)" + shape + R"(<mass total="0.1"/><springs><stretch k="60"/></springs>)" +
         "\n" + look + R"(</body><time step="1e-2" duration="0.1"/><image size="64 36" fps="10"/></scene>)";
}

// As run and render say it; nothing is written.
void expect_refused(const TestFolder& place, int code, const std::string& at, const std::string& words,
                    const std::string& options = "") {
  const auto before = place.files();
  for (const std::string command : {"run s.xml", "render s.xml -o out"}) {
    const Outcome outcome = place.rend(command + " " + options);
    EXPECT_EQ(outcome.code, code) << command << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.rfind("rend: error: " + at + ": ", 0), 0U) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_TRUE(words == "scale" || outcome.err.find("hint: ") != std::string::npos) << outcome.err;
    EXPECT_EQ(place.files(), before);
  }
}

TEST(Texture, that_is_no_picture_is_refused_at_the_attribute) {
  NEEDS_PNG;
  const TestFolder place;
  const std::string good = test::black_png(test::header_of(8, 8));
  const auto damaged = [&](std::size_t at) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] + 1);
    return bytes;
  };
  const std::vector<std::tuple<std::string, std::string>> cases{
      {"", "the file is empty"},
      {"no picture at all", "this is not a PNG or JPEG file"},
      {"GIF89a and so on", "this is a GIF, not a PNG or JPEG file"},
      {good.substr(0, 20), "its header is damaged"},
      {good.substr(0, good.size() - 20), "the PNG cannot be read"},
      {damaged(good.size() - 20), "the PNG cannot be read"},
      {damaged(18), "the PNG cannot be read"},
      {good.substr(0, 8) + test::png_chunk("tEXt", "first") + good.substr(8), "its header is damaged"},
  };
  place.write("s.xml", preset(R"(<look texture="p.png"/>)"));
  for (const auto& [bytes, words] : cases) {
    place.write("p.png", bytes);
    expect_refused(place, 65, "s.xml:2:16", words);
  }
  place.write("p.png", good);
  EXPECT_EQ(place.rend("run s.xml -q").code, 0);
}

TEST(Texture, that_is_not_there_is_refused_with_its_own_exit_code) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("s.xml", preset(R"(<look texture="missing.png"/>)"));
  expect_refused(place, 66, "s.xml:2:16", "relative to the folder of the preset");
  fs::create_directories(place.path() / "missing.png");
  expect_refused(place, 66, "s.xml:2:16", "this is a folder, not a picture");
}

// 4097 pixels are one too many; a header is believed only as far as the file can hold what it says.
TEST(Texture, that_is_too_large_is_refused_before_it_is_decoded) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("s.xml", preset(R"(<look texture="p.png"/>)"));
  for (const auto& [width, height] : {std::pair{4097U, 1U}, {1U, 4097U}, {60000U, 4000U}}) {
    place.write("p.png", test::png_file(test::header_of(width, height), ""));
    expect_refused(place, 65, "s.xml:2:16", "at most 4096 x 4096 are allowed");
  }
  place.write("p.png",
              test::png_file(test::header_of(4096, 4096), test::png_chunk("IDAT", test::deflated("x"))));
  expect_refused(place, 65, "s.xml:2:16", "cannot hold them");
  place.write("p.png", test::black_png(test::header_of(4096, 1)));
  EXPECT_EQ(place.rend("run s.xml -q").code, 0);
}

TEST(Texture, lies_in_the_folder_of_its_preset_or_below) {
  NEEDS_PNG;
  const TestFolder place;
  fs::create_directories(place.path() / "scenes/pictures");
  fs::create_directories(place.path() / "elsewhere");
  write_png(place.path() / "scenes/pictures/p.png", test::pattern(8, 8));
  write_png(place.path() / "elsewhere/p.png", test::pattern(8, 8));
  fs::create_symlink("../elsewhere", place.path() / "scenes/link");
  const auto run = [&](const std::string& file, const std::string& options = "") {
    place.write("scenes/s.xml", preset(R"(<look texture=")" + file + R"("/>)"));
    return place.rend("run scenes/s.xml -q " + options);
  };
  EXPECT_EQ(run("pictures/p.png").code, 0);
  for (const std::string& file : {std::string("../elsewhere/p.png"), std::string("link/p.png"),
                                  (place.path() / "scenes/pictures/p.png").string()}) {
    const Outcome outside = run(file);
    EXPECT_EQ(outside.code, 65);
    EXPECT_THAT(outside.err, HasSubstr("outside of the preset's folder"));
    EXPECT_THAT(outside.err, HasSubstr("put the picture beside the preset"));
    EXPECT_THAT(outside.err, HasSubstr("scenes/s.xml:2:16"));
    EXPECT_EQ(run(file, "--allow-path").code, 0);
  }
  for (const char* attribute : {"texture-back", "texture-inside"}) {
    place.write("scenes/s.xml", preset(fmt::format(R"(<look {}="../elsewhere/p.png"/>)", attribute)));
    EXPECT_THAT(place.rend("run scenes/s.xml -q").err, HasSubstr("outside of the preset's folder"));
  }
  // named on the command line it is relative to the preset all the same
  place.write("scenes/s.xml", preset(""));
  EXPECT_EQ(place.rend("run scenes/s.xml -q --set body.look.texture=pictures/p.png").code, 0);
  EXPECT_EQ(place.rend("run scenes/s.xml -q --set body.look.texture=p.png").code, 66);
  EXPECT_EQ(place.rend("run scenes/s.xml -q --set body.look.texture=../elsewhere/p.png").code, 65);
}

TEST(Texture, is_refused_where_it_cannot_be_seen) {
  NEEDS_PNG;
  const TestFolder place;
  const std::string bar = R"(<bar cells="1 1 1" size="1 1 1"/>)";
  write_png(place.path() / "p.png", test::pattern(8, 8));
  Image clear = test::pattern(8, 8, 4);
  clear.pixels[3] = 254;
  write_png(place.path() / "clear.png", clear);
  const auto refuse = [&](const std::string& look, const std::string& words, const std::string& shape = "") {
    place.write("s.xml", shape.empty() ? preset(look) : preset(look, shape));
    expect_refused(place, 65, "s.xml:2:" + std::to_string(look.find('"') + 2), words);
  };
  refuse(R"(<look wrap="mirrored" texture="p.png"/>)", "did you mean 'mirror'?");
  refuse(R"(<look scale="0 1" texture="p.png"/>)", "scale");
  refuse(R"(<look wrap="mirror"/>)", "has no use without a texture");
  refuse(R"(<look rotate="30"/>)", "has no use without a texture");
  refuse(R"(<look texture-inside="p.png"/>)", "is a sheet, which has no inside");
  refuse(R"(<look texture-back="p.png"/>)", "is a solid, which shows no back", bar);
  refuse(R"(<look texture="p.png" as="exploded"/>)", "shown as=\"exploded\"");
  refuse(R"(<look texture="p.png" as="darts"/>)", "shown as=\"darts\"");
  refuse(R"(<look texture="clear.png"/>)", "a solid has nothing behind its surface", bar);
  refuse(R"(<look texture-inside="clear.png"/>)", "a solid has nothing behind its surface", bar);
  refuse(R"(<look texture-back="clear.png"/>)", "holes of a sheet are those of its texture");
  refuse(R"(<look thickness="0.1" texture="clear.png"/>)", "the holes of a picture have no rim");
  place.write("s.xml", preset(R"(<look texture="clear.png" texture-back="p.png" as="wires"/>)"));
  EXPECT_EQ(place.rend("render s.xml -q -o out").code, 0);
}

TEST(Texture, is_no_file_that_may_be_written_over) {
  NEEDS_PNG;
  const TestFolder place;
  write_png(place.path() / "00000.png", test::pattern(8, 8));
  place.write("s.xml", preset(R"(<look texture="00000.png"/>)"));
  const Outcome outcome = place.rend("render s.xml -o . --frames 0");
  EXPECT_EQ(outcome.code, 64);
  EXPECT_THAT(outcome.err, HasSubstr("the picture '00000.png' would be overwritten"));
  EXPECT_EQ(read_png(place.path() / "00000.png"), test::pattern(8, 8));
}

TEST(Texture, is_a_part_of_the_scene_for_resume) {
  NEEDS_PNG;
  const TestFolder place;
  place.write("s.xml", preset(R"(<look texture="p.png"/>)"));
  const auto rendered = [&](int seed) {
    write_png(place.path() / "p.png", test::pattern(8, 8, 3, seed));
    const Outcome outcome = place.rend("render s.xml -q -o out --resume");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_png(place.path() / "out/00001.png");
  };
  const Image first = rendered(0);
  EXPECT_EQ(rendered(0), first);
  EXPECT_GT(test::largest_difference(rendered(20), first), 50);
}

} // namespace
} // namespace rend::texture_command_test
