#include "render/files/png.h"

#include "sim/base/error.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <csignal>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>

namespace rend::png_test {
namespace {

using namespace test;

Exit code_of(const auto& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.code;
  }
  return Exit::Done;
}

TEST(Png, ReadsBackWhatItWrote) {
  NEEDS_PNG;
  const Folder folder;
  for (const int channels : {3, 4}) {
    const Image image = pattern(37, 23, channels);
    write_png(folder / "a.png", image);
    EXPECT_EQ(read_png(folder / "a.png"), image);
  }
}

TEST(Png, TheSamePictureGivesTheSameBytes) {
  NEEDS_PNG;
  EXPECT_EQ(encode_png(pattern(64, 48)), encode_png(pattern(64, 48)));
  EXPECT_NE(encode_png(pattern(64, 48)), encode_png(pattern(64, 48, 3, 1)));
}

TEST(Png, IntoAFolderThatIsNotThereCannotBeCreatedAndLeavesNothing) {
  NEEDS_PNG;
  const Folder folder;
  EXPECT_EQ(code_of([&] { write_png(folder / "missing/a.png", pattern(4, 4)); }), Exit::CannotCreate);
  EXPECT_EQ(folder.files(), 0);
}

TEST(Png, OverAFolderCannotBeCreated) {
  NEEDS_PNG;
  const Folder folder;
  std::filesystem::create_directory(folder / "a.png");
  EXPECT_EQ(code_of([&] { write_png(folder / "a.png", pattern(4, 4)); }), Exit::CannotCreate);
  EXPECT_EQ(folder.files(), 1);
}

// A limit on file size simulates a full disk.
TEST(Png, AFailedWriteLeavesTheOldPictureAndNothingElse) {
  NEEDS_PNG;
  const Folder folder;
  const Image old = pattern(8, 8);
  write_png(folder / "a.png", old);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{64, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const Exit code = code_of([&] { write_png(folder / "a.png", pattern(200, 200)); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(code, Exit::ReadWrite);
  EXPECT_EQ(read_png(folder / "a.png"), old);
  EXPECT_EQ(folder.files(), 1);
}

TEST(Png, AFileThatIsNotThereIsNoInput) {
  NEEDS_PNG;
  const Folder folder;
  EXPECT_EQ(code_of([&] { read_png(folder / "a.png"); }), Exit::NoInput);
}

TEST(Png, AFileThatIsCutOffOrNoPngIsBadInput) {
  NEEDS_PNG;
  const Folder folder;
  const std::vector<std::uint8_t> bytes = encode_png(pattern(64, 64));
  const auto write = [&](std::size_t count) {
    std::ofstream file(folder / "a.png", std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(count));
  };
  for (const std::size_t count : {std::size_t{0}, std::size_t{5}, std::size_t{40}, bytes.size() / 2}) {
    write(count);
    EXPECT_EQ(code_of([&] { read_png(folder / "a.png"); }), Exit::BadInput) << count << " bytes";
  }
}

TEST(Png, WhatCannotBeReadIsSaidAsInComparisons) {
  NEEDS_PNG;
  const Folder folder;
  const auto said = [&](const std::string& bytes) -> std::string {
    std::ofstream(folder / "a.png", std::ios::binary) << bytes;
    try {
      read_png(folder / "a.png");
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(said("\xff\xd8\xff\xe0 JFIF").find("a JPEG"), std::string::npos);
  const std::vector<std::uint8_t> png = encode_png(pattern(64, 64));
  std::string bytes(png.begin(), png.end());
  EXPECT_NE(said(bytes.substr(0, bytes.size() - 12)).find("cut off"), std::string::npos);
  // A header that claims 2^32 pixels, with a valid CRC: no memory of that size is allocated.
  bytes = bytes.substr(0, 16) + std::string("\0\1\0\0\0\1\0\0\10\2\0\0\0"
                                            "\xe3\xe6\xa7\xb4",
                                            17);
  bytes += std::string("\0\0\0\0IDAT", 8);
  EXPECT_NE(said(bytes).find("65536 x 65536"), std::string::npos);
}

} // namespace
} // namespace rend::png_test
