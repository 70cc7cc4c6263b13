// A file named twice, or both read and written: refused before anything is written.
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <gmock/gmock.h>

#include <map>

namespace rend::named_files_test {
namespace {

using program::content;
using program::Outcome;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

class NamedFiles : public testing::Test {
protected:
  NamedFiles() {
    place.write("pulled.xml", program::pulled);
    fs::create_directories(place.path() / "d");
    fs::create_directory_symlink("d", place.path() / "same");
    fs::create_symlink("d/s.csv", place.path() / "link.csv"); // a dangling link
    fs::create_symlink("pulled.xml", place.path() / "preset.csv");
    place.write("d/00001.obj", triangle);
    place.write("d/mesh.xml", R"(<scene name="mesh"><body><mesh file="00001.obj"/><mass total="1"/></body>
      <time step="1e-3" integrator="symplectic" duration="0.1"/></scene>)");
  }
  std::map<std::string, std::string> all() const {
    std::map<std::string, std::string> out;
    for (const std::string& name : place.files()) {
      const fs::path path = place.path() / name;
      if (fs::is_symlink(path))
        out[name] = fs::read_symlink(path).string();
      else
        out[name] = fs::is_directory(path) ? "a folder" : content(path);
    }
    return out;
  }
  void expect_refused(const std::string& line, const std::string& why) const {
    const auto before = all();
    const Outcome outcome = place.rend(line);
    EXPECT_EQ(outcome.code, 64) << line;
    EXPECT_THAT(outcome.err, HasSubstr(why)) << line;
    EXPECT_EQ(all(), before) << line;
  }
  const program::TestFolder place;
};

TEST_F(NamedFiles, no_file_is_written_twice) {
  const std::string twice = "--diagnostics and --events would both be written to";
  expect_refused("run pulled.xml --diagnostics s.csv --events s.csv", twice);
  expect_refused("run pulled.xml --diagnostics s.csv --events ./d/../s.csv", twice);
  expect_refused("run pulled.xml --diagnostics s.csv --events $PWD/s.csv", twice);
  expect_refused("run pulled.xml --diagnostics d/s.csv --events same/s.csv", twice);
  expect_refused("run pulled.xml --diagnostics link.csv --events d/s.csv", twice);
  expect_refused("run pulled.xml --diagnostics s.csv --events s.csv.part", twice);
  const std::string exported = "--diagnostics and --export vtu would both be written to";
  expect_refused("run pulled.xml --export vtu -o d --diagnostics same/00003.vtu", exported);
  expect_refused("run pulled.xml --export vtu -o d --diagnostics d/pulled.pvd", exported);
}

TEST_F(NamedFiles, nothing_is_written_where_standard_output_goes) {
  for (const char* line : {"run pulled.xml --json --diagnostics s.json > s.json",
                           "run pulled.xml --json --diagnostics s.json 2> d/../s.json"}) {
    const Outcome outcome = place.rend(line);
    EXPECT_EQ(outcome.code, 64) << line;
    EXPECT_FALSE(fs::exists(place.path() / "s.json.part"));
  }
  EXPECT_THAT(content(place.path() / "s.json"), HasSubstr("standard error and --diagnostics"));
}

TEST_F(NamedFiles, a_preset_and_its_meshes_are_not_written_over) {
  const std::string preset = "the preset 'pulled.xml' would be overwritten by";
  expect_refused("run pulled.xml --diagnostics pulled.xml", preset);
  expect_refused("run pulled.xml --events preset.csv", preset);
  expect_refused("run preset.csv --diagnostics pulled.xml", "the preset 'preset.csv'");
  expect_refused("run d/mesh.xml --diagnostics same/00001.obj", "the mesh 'd/00001.obj'");
  expect_refused("run d/mesh.xml --export obj -o d", "the mesh 'd/00001.obj' would be overwritten by --export");
  EXPECT_EQ(place.rend("run d/mesh.xml --export obj -o d --frames 0,2 -q").code, 0) << "by no other frame";
  EXPECT_EQ(content(place.path() / "d/00001.obj"), triangle);
}

TEST_F(NamedFiles, a_mesh_is_not_converted_onto_itself) {
  ASSERT_EQ(place.rend("mesh convert d/00001.obj m.msh").code, 0);
  fs::create_symlink("m.msh", place.path() / "link.msh");
  for (const char* line : {"mesh convert m.msh m.msh", "mesh convert m.msh d/../m.msh",
                           "mesh convert m.msh link.msh", "mesh convert link.msh m.msh"})
    expect_refused(line, "would be overwritten");
  fs::create_hard_link(place.path() / "m.msh", place.path() / "hard.msh");
  EXPECT_EQ(place.rend("mesh convert m.msh hard.msh").code, 0) << "two names, two files";
  EXPECT_EQ(fs::hard_link_count(place.path() / "m.msh"), 1u);
}

TEST_F(NamedFiles, reports_and_pictures_are_not_written_over_presets) {
  NEEDS_PNG;
  for (const char* name : {"d/00002.png", "d/pulled.checkpoint", "d/pulled.mp4", "d/index.html", "d/study.csv"})
    place.write(name, program::pulled);
  expect_refused("render d/00002.png -o d", "would be overwritten by a picture");
  expect_refused("render d/pulled.checkpoint -o same", "would be overwritten by the stored state");
  if (video_available())
    expect_refused("render d/pulled.mp4 -o d --video mp4 --no-png", "would be overwritten by the video");
  expect_refused("sheet pulled.xml d/00002.png -o same/00002.png", "would be overwritten by the contact sheet");
  expect_refused("batch d/index.html -o d", "would be overwritten by the page");
  expect_refused("check d/index.html -o d --quick", "would be overwritten by the report");
  expect_refused("study d/study.csv -o d --quick", "would be overwritten by the study");
  expect_refused("study --lean d/index.html -o d --quick", "would be overwritten by the study");
}

class NamedFilesOfDiff : public NamedFiles {
protected:
  void SetUp() override {
    NEEDS_PNG;
    fs::create_directories(place.path() / "a/in");
    fs::create_directories(place.path() / "b");
    fs::create_directories(place.path() / "elsewhere");
    for (const char* name : {"a/in/1.png", "a/2.png", "b/2.png", "elsewhere/3.png"})
      write_png(place.path() / name, test::pattern(40, 30));
    fs::create_directory_symlink("../elsewhere", place.path() / "a/more");
    fs::create_directory_symlink("a", place.path() / "to-a");
    place.write("t.xml", "<tolerances><default max=\"1\"/></tolerances>");
  }
};

TEST_F(NamedFilesOfDiff, a_report_lies_outside_of_what_is_compared) {
  for (const char* folder : {"a", "a/", "b", "a/report", "b/in/report", "a/in", "to-a/report", "b/../a/x/y",
                             "elsewhere", "a/more/report"})
    expect_refused("diff a b -o " + std::string(folder), "whose pictures are compared");
  ASSERT_EQ(place.rend("diff a/2.png b/2.png --limit max=0 -o report").code, 0);
  fs::create_directories(place.path() / "report/maps");
  fs::rename(place.path() / "b", place.path() / "report/maps/b");
  expect_refused("diff a report/maps/b -o report", "would write its maps into");
  expect_refused("diff a/2.png report/maps/b/2.png -o report", "would write its maps into");
  EXPECT_EQ(place.rend("diff a/2.png report/maps/b/2.png -o a/in/report").code, 0) << "two pictures, no folder";
  EXPECT_EQ(place.rend("diff a/in elsewhere -o a/report").code, 1) << "beside them";
}

TEST_F(NamedFilesOfDiff, findings_are_not_written_over_what_is_read) {
  expect_refused("diff a b --junit a/2.png", "the picture 'a/2.png' would be overwritten by --junit");
  expect_refused("diff a b --junit to-a/in/1.png", "would be overwritten by --junit");
  expect_refused("diff a b -t t.xml --junit d/../t.xml", "the file of tolerances");
  expect_refused("diff a b --mask a/2.png --junit a/2.png", "the mask");
  expect_refused("diff a b -o r --junit r/index.html", "would both be written to");
}

} // namespace
} // namespace rend::named_files_test
