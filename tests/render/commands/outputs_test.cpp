// Where outputs are written: beside files that are not rend's; and that they are flushed to the disk.
#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>

#include <sstream>
#include <sys/stat.h>

namespace rend::outputs_test {
namespace {

using program::content;
using program::Files;
using program::Outcome;
using testing::ElementsAre;
namespace fs = std::filesystem;

class Outputs : public program::StoppedClip {
protected:
  Outputs() { place.write("pulled.xml", program::pulled); }
};

TEST_F(Outputs, of_a_run_go_through_no_link_and_wait_for_no_pipe) {
  NEEDS_PNG;
  NEEDS_VIDEO;
  ASSERT_EQ(place.rend("render pulled.xml -q -o alone --video mp4").code, 0);
  const Files alone = in("alone");
  ASSERT_EQ(alone.size(), 8u);
  place.write("mine", "precious");
  const fs::path c = place.path() / "c";
  fs::create_directory(c);
  fs::create_hard_link(place.path() / "mine", c / "00001.png.part");
  fs::create_directory(c / "00002.png.part");
  ASSERT_EQ(::mkfifo((c / "00003.png.part").c_str(), 0666), 0);
  std::map<std::string, std::string> links{{"00000.png.part", "../mine"}, {"00004.png.part", "../nowhere"}};
  for (const char* name : {"00005.png", "pulled.part.mp4", "pulled.mp4.part", "pulled.checkpoint.part"})
    links[name] = "../mine";
  for (const auto& [name, to] : links) fs::create_symlink(to, c / name);
  const Outcome outcome = place.shell("timeout -s KILL 60 " + std::string(test::rend_program) +
                                      " render pulled.xml -q -o c --video mp4 "
                                      "--checkpoint-every 1e-9");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const auto& [name, bytes] : alone) EXPECT_TRUE(content(c / name) == bytes) << name;
  EXPECT_EQ(content(place.path() / "mine"), "precious");
  EXPECT_FALSE(fs::exists(place.path() / "nowhere"));
  EXPECT_FALSE(fs::is_symlink(c / "00005.png")) << "it was replaced";
  links.erase("00005.png");
  for (const auto& [name, to] : links) EXPECT_EQ(fs::read_symlink(c / name), to);
  EXPECT_EQ(fs::hard_link_count(place.path() / "mine"), 2u);
  EXPECT_TRUE(fs::is_directory(c / "00002.png.part"));
  EXPECT_TRUE(fs::is_fifo(c / "00003.png.part"));
  const std::size_t given = 3, around = 3; // files beside the folders, and files in c that are not links
  EXPECT_EQ(place.files().size(), given + 2 * (1 + alone.size()) + around + links.size()) << "no more";
}

// Each of these files is named on the command line.
TEST_F(Outputs, that_the_user_names_go_where_his_links_lead) {
  NEEDS_PNG;
  place.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  fs::create_directory(place.path() / "there");
  for (const char* name : {"s.csv", "e.jsonl", "s.png", "j.xml", "m.msh"}) {
    fs::create_symlink(fs::path("there") / name, place.path() / name);
    // the targets of the other links do not exist yet
    if (*name != 's') place.write(std::string("there/") + name, "old");
  }
  EXPECT_EQ(place.rend("run pulled.xml -q --diagnostics s.csv --events e.jsonl").code, 0);
  EXPECT_EQ(place.rend("sheet pulled.xml -q -o s.png --size 32x32").code, 0);
  EXPECT_EQ(place.rend("diff s.png s.png -q --junit j.xml").code, 0);
  EXPECT_EQ(place.rend("mesh convert t.obj m.msh").code, 0);
  const auto begins = [&](const std::string& name) {
    return content(place.path() / "there" / name).substr(0, 5);
  };
  EXPECT_EQ(begins("s.csv"), "frame");
  EXPECT_EQ(begins("e.jsonl"), "{\"tim");
  EXPECT_EQ(begins("s.png").substr(1, 3), "PNG");
  EXPECT_EQ(begins("j.xml"), "<?xml");
  EXPECT_EQ(begins("m.msh"), "$Mesh");
  for (const char* name : {"s.csv", "e.jsonl", "s.png", "j.xml", "m.msh"})
    EXPECT_TRUE(fs::is_symlink(place.path() / name)) << name;
}

class Watched : public Outputs {
protected:
  // The system calls of `rend ARGUMENTS`: "sync" and "rename", each with the file name.
  std::vector<std::string> watch(const std::string& arguments, int code) const {
    const fs::path log = place.path() / "log";
    fs::remove(log);
    const Outcome outcome =
        place.shell("LD_PRELOAD=" + std::string(test::watch_disk_library) + " REND_WATCH=" + log.string() +
                    " " + std::string(test::rend_program) + " " + arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    std::vector<std::string> did;
    std::istringstream lines(content(log));
    for (std::string what, name; lines >> what >> name;)
      did.push_back(what + " " + fs::path(name).filename().string());
    return did;
  }
};

TEST_F(Watched, a_folder_is_on_the_disk_before_a_stored_state_and_at_the_end) {
  NEEDS_PNG;
  const std::vector<std::string> did = watch("render clip.xml -q -o new/c --checkpoint-every 1e-3", 0);
  int stored = 0;
  bool on_disk = true;
  for (const std::string& one : did) {
    if (one.ends_with(".png")) on_disk = false;
    if (one == "sync c") on_disk = true;
    if (one != "rename clip.checkpoint") continue;
    ++stored;
    EXPECT_TRUE(on_disk) << "a picture before stored state " << stored << " is not";
  }
  EXPECT_GT(stored, 0);
  ASSERT_FALSE(did.empty());
  EXPECT_EQ(did.back(), "sync c");
  EXPECT_EQ(std::count(did.begin(), did.end(), "sync new"), 1) << "the folder of the new folder";
  EXPECT_LE(std::count(did.begin(), did.end(), "sync c"), stored + 1) << "not for each picture";
}

TEST_F(Watched, so_is_the_folder_of_other_files) {
  const std::string sync_here = "sync " + place.path().filename().string();
  for (const char* line : {"run pulled.xml -q --diagnostics d.csv", "run pulled.xml -q --events e.jsonl"})
    EXPECT_EQ(watch(line, 0).back(), sync_here) << line;
  EXPECT_EQ(watch("run pulled.xml -q --export vtu -o v", 0).back(), "sync v");
  EXPECT_EQ(watch("check pulled.xml -q --only 'as it is' -o k", 0).back(), "sync k");
}

} // namespace
} // namespace rend::outputs_test
