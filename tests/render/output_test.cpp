#include "render/output.h"

#include "tests/render/pictures.h"

#include <array>
#include <gtest/gtest.h>

namespace rend {
namespace {

const std::array<std::uint8_t, 3> bytes{'a', 'b', 'c'};

TEST(OutputFile, AppearsOnlyWhenItIsCommitted) {
  const test::Folder folder;
  OutputFile file(folder / "x");
  file.write(bytes);
  EXPECT_FALSE(std::filesystem::exists(folder / "x"));
  file.commit();
  EXPECT_EQ(std::filesystem::file_size(folder / "x"), 3u);
  EXPECT_EQ(folder.files(), 1);
}

TEST(OutputFile, LeavesNothingWhenItIsGivenUp) {
  const test::Folder folder;
  {
    OutputFile file(folder / "x");
    file.write(bytes);
  }
  EXPECT_EQ(folder.files(), 0);
}

TEST(OutputFile, TwoThatWriteTheSameFileAtOnceDoNotDisturbEachOther) {
  const test::Folder folder;
  OutputFile first(folder / "x");
  first.write(bytes);
  {
    OutputFile second(folder / "x"), third(folder / "x");
    EXPECT_EQ(first.temporary(), folder / "x.part");
    EXPECT_EQ(second.temporary(), folder / "x.2.part");
    EXPECT_EQ(third.temporary(), folder / "x.3.part");
    remove_leftover(folder / "x"); // it is none
    second.write(bytes);
    second.write(bytes);
    second.commit();
    EXPECT_EQ(std::filesystem::file_size(folder / "x"), 6u);
  }
  first.commit();
  EXPECT_EQ(std::filesystem::file_size(folder / "x"), 3u);
  EXPECT_EQ(folder.files(), 1);
}

TEST(OutputFile, ALeftoverGoes) {
  const test::Folder folder;
  write_whole(folder / "x.part", "of a killed run");
  remove_leftover(folder / "x");
  EXPECT_EQ(folder.files(), 0);
}

TEST(OutputFile, LeftoversOfSecondProgramsGo) {
  const test::Folder folder;
  const auto leave = [&] {
    for (const char* name : {"x.2.part", "x.3.part"}) write_whole(folder / name, "of a killed run");
  };
  leave();
  remove_leftover(folder / "x");
  EXPECT_EQ(folder.files(), 0);
  leave();
  write_whole(folder / "x", "whole");
  EXPECT_EQ(folder.files(), 1);

  OutputFile first(folder / "x"), second(folder / "x");
  write_whole(folder / "x.3.part", "of a killed run");
  first.commit();
  EXPECT_FALSE(std::filesystem::exists(folder / "x.3.part"));
  EXPECT_TRUE(std::filesystem::exists(second.temporary())) << "it is being written";
}

TEST(OutputFile, OverwritesWhatAKilledRunLeftBehind) {
  const test::Folder folder;
  for (int run = 0; run < 2; ++run) {
    OutputFile file(folder / "x");
    file.write(bytes);
    std::filesystem::copy_file(file.temporary(), folder / "kept",
                               std::filesystem::copy_options::overwrite_existing);
    file.commit();
    std::filesystem::copy_file(folder / "kept", file.temporary()); // as if it had never been renamed
  }
  EXPECT_EQ(std::filesystem::file_size(folder / "x"), 3u);
}

} // namespace
} // namespace rend
