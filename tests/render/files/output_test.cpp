#include "render/files/output.h"

#include "sim/base/error.h"
#include "tests/render/pictures.h"

#include <array>
#include <fcntl.h>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rend::output_test {
namespace {

namespace fs = std::filesystem;

const std::array<std::uint8_t, 3> abc{'a', 'b', 'c'};

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Exit code_of(const std::function<void()>& what) {
  try {
    what();
  } catch (const UserError& error) {
    return error.code;
  }
  return Exit::Done;
}

// A user's file, and six temporary names taken by what is not a killed run's file.
class OutputAmongOthers : public testing::Test {
protected:
  OutputAmongOthers() {
    put(folder / "mine", "precious");
    fs::create_symlink("mine", part(1));
    fs::create_symlink("nowhere", part(2));
    fs::create_hard_link(folder / "mine", part(3));
    EXPECT_EQ(::mkfifo(part(4).c_str(), 0666), 0);
    reader_ = ::open(part(4).c_str(), O_RDONLY | O_NONBLOCK);
    fs::create_directory(part(5));
    put(part(6), "another program writes");
    locked_ = ::open(part(6).c_str(), O_WRONLY);
    EXPECT_EQ(::flock(locked_, LOCK_EX), 0);
  }
  ~OutputAmongOthers() override {
    ::close(reader_);
    ::close(locked_);
  }
  fs::path part(int n) const { return folder / (n == 1 ? "x.part" : "x." + std::to_string(n) + ".part"); }

  void expect_all_as_before() const {
    EXPECT_EQ(content(folder / "mine"), "precious");
    EXPECT_EQ(fs::read_symlink(part(1)), "mine");
    EXPECT_EQ(fs::read_symlink(part(2)), "nowhere");
    EXPECT_FALSE(fs::exists(folder / "nowhere"));
    EXPECT_EQ(fs::hard_link_count(part(3)), 2u);
    EXPECT_TRUE(fs::is_fifo(part(4)));
    pollfd other{reader_, POLLIN, 0};
    ::poll(&other, 1, 0);
    EXPECT_EQ(other.revents, 0) << "somebody opened the pipe, and left";
    EXPECT_TRUE(fs::is_directory(part(5)));
    EXPECT_EQ(content(part(6)), "another program writes");
  }

  const test::Folder folder;

private:
  int reader_ = -1, locked_ = -1;
};

TEST_F(OutputAmongOthers, WritesNowhereElseAndWaitsForNoPipe) {
  OutputFile file(folder / "x");
  EXPECT_EQ(file.temporary(), part(7));
  file.write(abc);
  file.commit();
  EXPECT_EQ(content(folder / "x"), "abc");
  expect_all_as_before();
  EXPECT_FALSE(fs::exists(part(7)));
}

TEST_F(OutputAmongOthers, LeavesThemWhereLeftoversGo) {
  put(part(7), "of a killed run");
  remove_leftover(folder / "x");
  EXPECT_FALSE(fs::exists(part(7)));
  expect_all_as_before();
}

TEST(OutputFile, LeavesTheTemporaryFileOfAnotherUserAlone) {
  if (::geteuid() != 0) GTEST_SKIP() << "to be run as root";
  const test::Folder folder;
  put(folder / "x.part", "theirs");
  put(folder / "x", "theirs too");
  for (const char* name : {"x.part", "x"}) ASSERT_EQ(::chown((folder / name).c_str(), 1, 1), 0);
  remove_leftover(folder / "x");
  write_atomically(folder / "x", "ours");
  EXPECT_EQ(content(folder / "x.part"), "theirs");
  EXPECT_EQ(content(folder / "x"), "ours") << "a final file may be replaced";
}

TEST(OutputFile, ReplacesALinkAndNotWhatItLeadsTo) {
  const test::Folder folder;
  put(folder / "mine", "precious");
  fs::create_symlink("mine", folder / "soft");
  fs::create_hard_link(folder / "mine", folder / "hard");
  for (const char* name : {"soft", "hard"}) {
    write_atomically(folder / name, name);
    EXPECT_EQ(content(folder / name), name);
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / name)));
  }
  EXPECT_EQ(content(folder / "mine"), "precious");
}

TEST(OutputFile, FollowsALinkThatTheUserNames) {
  const test::Folder folder;
  fs::create_directory(folder / "other");
  put(folder / "other/file", "old");
  fs::create_symlink("other/link", folder / "x");
  fs::create_symlink("file", folder / "other/link");
  write_atomically(resolve_link(folder / "x"), "new");
  EXPECT_EQ(content(folder / "other/file"), "new");
  EXPECT_TRUE(fs::is_symlink(folder / "x"));

  fs::create_symlink(folder / "other/later", folder / "y"); // a dangling link
  write_atomically(resolve_link(folder / "y"), "new");
  EXPECT_EQ(content(folder / "other/later"), "new");
  EXPECT_TRUE(fs::is_symlink(folder / "y"));

  fs::create_symlink("z", folder / "z");
  EXPECT_EQ(code_of([&] { resolve_link(folder / "z"); }), Exit::CannotCreate);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0666), 0);
  fs::create_symlink("pipe", folder / "p");
  EXPECT_EQ(code_of([&] { resolve_link(folder / "p"); }), Exit::CannotCreate);
}

TEST(OutputFile, SaysWhenItsTemporaryFileBecameAnothers) {
  const test::Folder folder;
  put(folder / "mine", "precious");
  {
    OutputFile file(folder / "x"), given_up(folder / "y");
    for (const char* name : {"x.part", "y.part"}) {
      fs::remove(folder / name);
      fs::create_symlink("mine", folder / name);
    }
    EXPECT_EQ(code_of([&] { file.commit(); }), Exit::ReadWrite);
  }
  EXPECT_FALSE(fs::exists(folder / "x"));
  for (const char* name : {"x.part", "y.part"}) EXPECT_TRUE(fs::is_symlink(folder / name)) << name;
  EXPECT_EQ(content(folder / "mine"), "precious");
}

TEST(OutputFile, AppearsOnlyWhenItIsCommitted) {
  const test::Folder folder;
  OutputFile file(folder / "x");
  file.write(abc);
  EXPECT_FALSE(std::filesystem::exists(folder / "x"));
  file.commit();
  EXPECT_EQ(std::filesystem::file_size(folder / "x"), 3u);
  EXPECT_EQ(folder.files(), 1);
}

TEST(OutputFile, LeavesNothingWhenItIsGivenUp) {
  const test::Folder folder;
  {
    OutputFile file(folder / "x");
    file.write(abc);
  }
  EXPECT_EQ(folder.files(), 0);
}

TEST(OutputFile, TwoThatWriteTheSameFileAtOnceDoNotDisturbEachOther) {
  const test::Folder folder;
  OutputFile first(folder / "x");
  first.write(abc);
  {
    OutputFile second(folder / "x"), third(folder / "x");
    EXPECT_EQ(first.temporary(), folder / "x.part");
    EXPECT_EQ(second.temporary(), folder / "x.2.part");
    EXPECT_EQ(third.temporary(), folder / "x.3.part");
    remove_leftover(folder / "x"); // not a temporary file
    second.write(abc);
    second.write(abc);
    second.commit();
    EXPECT_EQ(std::filesystem::file_size(folder / "x"), 6u);
  }
  first.commit();
  EXPECT_EQ(std::filesystem::file_size(folder / "x"), 3u);
  EXPECT_EQ(folder.files(), 1);
}

TEST(OutputFile, ALeftoverGoes) {
  const test::Folder folder;
  write_atomically(folder / "x.part", "of a killed run");
  remove_leftover(folder / "x");
  EXPECT_EQ(folder.files(), 0);
}

TEST(OutputFile, LeftoversOfSecondProgramsGo) {
  const test::Folder folder;
  const auto leave = [&] {
    for (const char* name : {"x.2.part", "x.3.part"}) write_atomically(folder / name, "of a killed run");
  };
  leave();
  remove_leftover(folder / "x");
  EXPECT_EQ(folder.files(), 0);
  leave();
  write_atomically(folder / "x", "whole");
  EXPECT_EQ(folder.files(), 1);

  OutputFile first(folder / "x"), second(folder / "x");
  write_atomically(folder / "x.3.part", "of a killed run");
  first.commit();
  EXPECT_FALSE(std::filesystem::exists(folder / "x.3.part"));
  EXPECT_TRUE(std::filesystem::exists(second.temporary())) << "it is being written";
}

TEST(OutputFile, OverwritesWhatAKilledRunLeftBehind) {
  const test::Folder folder;
  for (int run = 0; run < 2; ++run) {
    OutputFile file(folder / "x");
    file.write(abc);
    std::filesystem::copy_file(file.temporary(), folder / "kept",
                               std::filesystem::copy_options::overwrite_existing);
    file.commit();
    std::filesystem::copy_file(folder / "kept", file.temporary()); // as if the rename had not happened
  }
  EXPECT_EQ(std::filesystem::file_size(folder / "x"), 3u);
}

} // namespace
} // namespace rend::output_test
