// rend diff --update: what it changes of the expected pictures, and that it changes nothing else, whatever
// links the folders hold.
#include "render/files/png.h"
#include "tests/render/commands/program_run.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <random>

namespace rend::diff_update_test {
namespace {

using program::content;
using program::Outcome;
using program::TestFolder;
using testing::HasSubstr;
namespace fs = std::filesystem;

class DiffUpdate : public testing::Test {
protected:
  void SetUp() override {
    NEEDS_PNG;
    for (const char* folder : {"exp", "now", "outside"}) fs::create_directories(place.path() / folder);
  }
  fs::path at(const std::string& name) const { return place.path() / name; }
  void put(const std::string& name, int seed) const {
    fs::create_directories(at(name).parent_path());
    write_png(at(name), test::pattern(12, 10, 3, seed));
  }
  Outcome update(const std::string& arguments = "exp now") const {
    return place.rend("diff " + arguments + " --update '*'");
  }
  // What lies below a folder: the bytes of each file and the target of each link, by name.
  static std::map<std::string, std::string> tree(const fs::path& folder) {
    std::map<std::string, std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      std::string& what = out[fs::relative(entry.path(), folder).string()];
      if (entry.is_symlink())
        what = "-> " + fs::read_symlink(entry.path()).string();
      else if (entry.is_regular_file())
        what = content(entry.path());
    }
    return out;
  }

  const TestFolder place;
};

TEST_F(DiffUpdate, replaces_a_link_itself_and_never_its_target) {
  put("now/a.png", 1);
  put("now/b.png", 2);
  place.write("outside/victim.txt", "precious");
  fs::create_symlink("../outside/victim.txt", at("exp/a.png"));
  fs::create_symlink("../outside/born.txt", at("exp/b.png")); // dangling
  const auto before = tree(at("outside"));
  EXPECT_EQ(update().code, 0);
  EXPECT_EQ(tree(at("outside")), before);
  for (const char* name : {"a.png", "b.png"}) {
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(at("exp") / name)));
    EXPECT_EQ(content(at("exp") / name), content(at("now") / name));
  }
}

TEST_F(DiffUpdate, refuses_a_link_to_a_folder_elsewhere_and_changes_nothing) {
  put("exp/a.png", 1);
  put("now/a.png", 2);
  put("outside/kept.png", 3);
  place.write("outside/notes.png", "no picture");
  fs::create_directory_symlink("../outside", at("exp/more"));
  put("now/more/new/one.png", 4);
  const auto before = tree(place.path());
  const Outcome outcome = update();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("nothing was updated"));
  EXPECT_EQ(tree(place.path()), before);
  EXPECT_EQ(place.rend("diff exp now --update a").code, 2) << "more/ still differs";
  EXPECT_EQ(content(at("exp/a.png")), content(at("now/a.png")));
}

TEST_F(DiffUpdate, follows_a_link_to_a_folder_of_the_expected_pictures) {
  put("exp/in/a.png", 1);
  fs::create_directory_symlink("in", at("exp/same"));
  put("now/same/a.png", 2);
  put("now/in/a.png", 2);
  EXPECT_EQ(update().code, 0);
  EXPECT_EQ(content(at("exp/in/a.png")), content(at("now/in/a.png")));
  EXPECT_TRUE(fs::is_symlink(at("exp/same")));
}

TEST_F(DiffUpdate, removes_only_what_is_a_picture) {
  put("exp/a.png", 1);
  put("now/a.png", 1);
  put("exp/old.png", 2);
  place.write("exp/notes.png", "no picture at all");
  fs::create_symlink("../outside/nothing", at("exp/dangling.png"));
  const Outcome outcome = update();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("notes.png: not removed, since it is no picture that can be read"));
  EXPECT_FALSE(fs::exists(at("exp/old.png")));
  EXPECT_EQ(content(at("exp/notes.png")), "no picture at all");
  EXPECT_TRUE(fs::is_symlink(at("exp/dangling.png")));
}

TEST_F(DiffUpdate, refuses_folders_of_which_one_lies_in_the_other) {
  put("exp/a.png", 1);
  put("exp/new/a.png", 2);
  fs::create_directory_symlink("exp/new", at("link"));
  const auto before = tree(place.path());
  for (const char* folders :
       {"exp exp/new", "exp/new exp", "exp exp", "exp link", "link exp", "exp/ exp/new/"}) {
    const Outcome outcome = update(folders);
    EXPECT_EQ(outcome.code, 64) << folders;
    EXPECT_THAT(outcome.err, HasSubstr("beside each other")) << folders;
    EXPECT_EQ(tree(place.path()), before) << folders;
  }
  EXPECT_EQ(place.rend("diff exp exp/new").code, 1) << "they can be compared";
}

TEST_F(DiffUpdate, takes_back_the_folders_that_it_made_where_it_fails) {
  put("exp/a.png", 1);
  put("now/a.png", 2);
  put("now/deep/er/b.png", 3);
  fs::create_directories(at("exp/a.png.update.part/in-the-way"));
  const auto before = tree(place.path());
  EXPECT_EQ(update().code, 73);
  EXPECT_EQ(tree(place.path()), before);
}

// What stands behind the names: the folders are the last two words, whatever follows.
TEST_F(DiffUpdate, takes_no_folder_for_a_name) {
  put("now/a.png", 1);
  put("now/more/c.png", 2);
  for (const char* line :
       {"--update a exp now", "--update a exp now -q", "exp --update a now -q", "-q --update a -q exp now",
        "exp now --update a", "--update more a exp now --json"}) {
    fs::remove(at("exp/a.png"));
    const Outcome outcome = place.rend(std::string("diff ") + line);
    EXPECT_LE(outcome.code, 2) << line << "\n" << outcome.err;
    EXPECT_TRUE(fs::exists(at("exp/a.png"))) << line;
  }
  EXPECT_EQ(place.rend("diff --update a exp").code, 64);
  EXPECT_THAT(place.rend("diff exp").err, HasSubstr("NOW is missing"));
  EXPECT_THAT(place.rend("diff").err, HasSubstr("EXPECTED is missing"));
  EXPECT_THAT(place.rend("diff --help").out, HasSubstr("rend diff [options] EXPECTED NOW"));
}

TEST_F(DiffUpdate, names_no_frame_as_not_matching_that_it_has_updated) {
  for (int n = 0; n < 4; ++n) {
    put(fmt::format("exp/{:05d}.png", n), 1);
    put(fmt::format("now/{:05d}.png", n), n == 2 ? 2 : 1);
  }
  EXPECT_THAT(place.rend("diff exp now").out, HasSubstr("the first that does not match is 00002.png"));
  const Outcome outcome = update();
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("1 updated"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("does not match")));
}

// Trees of pictures, other files, folders, and links to all of these and to nothing, in EXPECTED, in NOW and
// beside them: an update changes what lies below EXPECTED, or nothing.
TEST_F(DiffUpdate, changes_nothing_outside_of_what_is_expected_over_thirty_trees_of_links) {
  int updated = 0, refused = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937 random(seed);
    const auto any = [&](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
    for (const char* folder : {"exp", "now", "outside"}) fs::remove_all(at(folder));
    std::vector<std::string> folders, files;
    for (const char* top : {"exp", "now", "outside"})
      for (const char* name : {"", "/in", "/in/deep", "/more"}) folders.push_back(top + std::string(name));
    for (const std::string& folder : folders) fs::create_directories(at(folder));
    for (const std::string& folder : folders)
      for (const char* name : {"a.png", "b.png", "c.png"}) {
        files.push_back(folder + "/" + name);
        if (any(3) > 0)
          put(files.back(), any(3));
        else if (any(2) > 0)
          place.write(files.back(), "text " + std::to_string(any(9)));
      }
    for (int n = 0, links = 1 + any(4); n < links; ++n) {
      const std::string name = folders[static_cast<std::size_t>(any(8))] + "/" +
                               (any(3) > 0   ? "a.png"
                                : any(2) > 0 ? "link"
                                             : "link.png");
      const std::string target = any(2) > 0   ? files[static_cast<std::size_t>(any(36))]
                                 : any(2) > 0 ? folders[static_cast<std::size_t>(8 + any(4))]
                                 : any(2) > 0 ? folders[static_cast<std::size_t>(any(12))]
                                              : "outside/nothing.png";
      std::error_code taken;
      if (!fs::is_directory(at(name))) fs::remove(at(name), taken);
      fs::create_symlink(at(target), at(name), taken);
    }
    const auto expected = tree(at("exp")), now = tree(at("now")), outside = tree(at("outside"));
    const Outcome outcome = update();
    EXPECT_EQ(tree(at("now")), now) << "tree " << seed;
    EXPECT_EQ(tree(at("outside")), outside) << "tree " << seed;
    EXPECT_TRUE(outcome.code <= 2 || outcome.code == 73) << "tree " << seed << ": " << outcome.err;
    const bool changed = tree(at("exp")) != expected;
    updated += changed;
    refused += outcome.err.find("a link leads from the expected pictures") != std::string::npos;
    if (outcome.err.find("nothing was updated") != std::string::npos) {
      EXPECT_FALSE(changed) << "tree " << seed;
    }
  }
  EXPECT_GE(updated, 5);
  EXPECT_GE(refused, 3);
}

} // namespace
} // namespace rend::diff_update_test
