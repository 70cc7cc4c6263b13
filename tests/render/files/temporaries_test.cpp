#include "render/files/temporaries.h"

#include "render/files/output.h"
#include "tests/render/pictures.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

namespace rend::temporaries_test {
namespace {

namespace fs = std::filesystem;

// In a child process, since the program has to end afterwards.
TEST(Temporaries, go_where_the_program_ends_at_once) {
  const test::Folder folder;
  const std::string empty = folder / "empty", full = folder / "full", cases = folder / "cases";
  for (const std::string& one : {empty, full, cases}) fs::create_directory(one);
  write_atomically(full + "/stays", "whole");
  write_atomically(cases + "/a", "goes");
  write_atomically(cases + "/b", "goes");
  EXPECT_EXIT(
      {
        const TemporaryPath first(empty.c_str());
        const TemporaryPath second(full.c_str());
        const OutputFile file(full + "/x");
        OutputFile kept(folder / "z");
        kept.commit();
        TemporaryPath with_files(cases.c_str());
        with_files.remove_contents();
        remove_temporaries();
        _exit(0);
      },
      testing::ExitedWithCode(0), "");
  EXPECT_EQ(folder.files(), 2);
  EXPECT_TRUE(fs::exists(folder / "z"));
  EXPECT_TRUE(fs::exists(full + "/stays"));
  EXPECT_FALSE(fs::exists(empty));
  EXPECT_FALSE(fs::exists(cases));
  EXPECT_FALSE(fs::exists(full + "/x.part"));
}

TEST(Temporaries, those_that_are_kept_stay) {
  const test::Folder folder;
  const std::string name = folder / "x";
  EXPECT_EXIT(
      {
        write_atomically(name, "whole");
        TemporaryPath path(name.c_str());
        path.unregister();
        remove_temporaries();
        _exit(0);
      },
      testing::ExitedWithCode(0), "");
  EXPECT_TRUE(fs::exists(name));
}

// A file that another thread has created, but not registered yet.
TEST(Temporaries, one_that_is_being_created_is_waited_for) {
  const test::Folder folder;
  const std::string name = folder / "x";
  EXPECT_EXIT(
      {
        TemporaryPath path;
        const int file = ::open(name.c_str(), O_WRONLY | O_CREAT, 0666);
        std::thread ending([] {
          remove_temporaries();
          _exit(0);
        });
        path.register_path(name.c_str());
        ending.join();
        ::close(file);
      },
      testing::ExitedWithCode(0), "");
  EXPECT_FALSE(fs::exists(name));
}

} // namespace
} // namespace rend::temporaries_test
