// Comparing one case: errors of a pair stay with that pair, and its memory is known beforehand.
#include "render/compare/compare.h"

#include "render/files/png.h"
#include "tests/render/needs.h"
#include "tests/render/peak_memory.h"
#include "tests/render/pictures.h"
#include "tests/render/png_files.h"

#include <atomic>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <thread>

namespace rend::compare_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t plenty = std::size_t{4} << 30;

class CompareCase : public testing::Test {
protected:
  void SetUp() override { NEEDS_PNG; }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
  void write(const std::string& name, const Image& image) const { write_png(folder / name, image); }
  CaseResult compare(std::size_t whole = plenty, const std::string& mask = "", bool heat = false) const {
    MemoryBudget memory(whole);
    CompareOptions options;
    options.heat = heat;
    if (!mask.empty()) options.mask = folder / mask;
    return compare_case({"a.png", folder / "a.png", folder / "b.png"}, options, memory);
  }

  const Folder folder;
};

TEST_F(CompareCase, wants_no_more_memory_than_it_is_given) {
  write("a.png", pattern(200, 100));
  write("b.png", pattern(200, 100, 3, 1));
  const CaseResult small = compare(1'000'000);
  EXPECT_EQ(small.state, CaseState::Unreadable);
  EXPECT_THAT(small.why, ElementsAre(HasSubstr("200 x 100 pixels in")));
  EXPECT_THAT(small.why[0], HasSubstr("GB of memory, and 0.001 GB are available"));
  EXPECT_EQ(compare(2'000'000).state, CaseState::Differ);
}

// So that a report of a thousand pictures does not accumulate maps.
TEST_F(CompareCase, gives_back_the_memory_of_its_maps) {
  write("a.png", pattern(200, 100));
  write("b.png", pattern(200, 100, 3, 1));
  const CaseResult out = compare();
  ASSERT_TRUE(out.metrics);
  EXPECT_EQ(out.metrics->flip_map.capacity(), 0u);
  EXPECT_EQ(out.metrics->difference.largest.capacity(), 0u);
}

TEST_F(CompareCase, takes_what_the_header_of_the_budget_says) {
  const auto noise = [](int channels, int seed) {
    Image image(1500, 1000, channels);
    std::uint32_t state = static_cast<std::uint32_t>(seed);
    for (std::uint8_t& value : image.pixels)
      value = static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
    return image;
  };
  constexpr std::int64_t pixels = 1500 * 1000;
  write("mask.png", Image(noise(3, 5)));
  const auto expect_within = [&](const char* what) {
    std::int64_t files = 0;
    for (const char* name : {"a.png", "b.png", "mask.png"})
      files += static_cast<std::int64_t>(std::filesystem::file_size(folder / name));
    const std::int64_t peak = peak_of([&] {
      if (compare(plenty, "mask.png", true).state != CaseState::Differ) throw 1;
    });
    EXPECT_GT(peak, 80 * pixels) << what; // so that something is measured at all
    EXPECT_LT(peak, files + 96 * pixels + 10 * megabyte) << what;
  };
  write("a.png", noise(4, 1));
  write("b.png", noise(4, 2));
  expect_within("8 bits");
  const PngHeader header = header_of(1500, 1000, 16, 6);
  std::string rows(png_rows_bytes(header), '\0');
  for (std::size_t n = 0; n < rows.size(); ++n)
    if (n % (1 + 1500 * 8) != 0) rows[n] = static_cast<char>(n * n >> 7);
  write("a.png", png_file(header, png_chunk("IDAT", deflated(rows))));
  expect_within("16 bits");
}

// Enough to read both pictures (at most 162 MB), but not for their planes (216 MB).
TEST_F(CompareCase, running_out_of_memory_fails_that_pair_only) {
  write("a.png", pattern(3000, 3000));
  write("b.png", pattern(3000, 3000, 3, 1));
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  const auto compare_within = [&](long bytes) {
    const rlimit tight{static_cast<rlim_t>(pages * sysconf(_SC_PAGESIZE) + bytes), before.rlim_max};
    setrlimit(RLIMIT_AS, &tight);
    const CaseResult out = compare();
    setrlimit(RLIMIT_AS, &before);
    EXPECT_EQ(out.state, CaseState::Unreadable);
    return out.why;
  };
  EXPECT_THAT(compare_within(195'000'000), ElementsAre("there is not enough memory to compare it"));
  EXPECT_THAT(compare_within(20'000'000), ElementsAre(HasSubstr("a.png: there is not enough memory to read"),
                                                      HasSubstr("b.png: there is not enough memory to read")));
}

TEST_F(CompareCase, a_mask_that_does_not_fit_is_the_trouble_of_that_pair) {
  write("a.png", pattern(20, 10));
  write("b.png", pattern(20, 10));
  write("mask.png", pattern(10, 20));
  EXPECT_THAT(compare(plenty, "mask.png").why, ElementsAre(HasSubstr("10 x 20")));
  write("mask.png", std::string("RIFF"));
  EXPECT_THAT(compare(plenty, "mask.png").why, ElementsAre(HasSubstr("not a PNG file")));
  EXPECT_THAT(compare(plenty, "none.png").why, ElementsAre(HasSubstr("none.png")));
  EXPECT_EQ(compare(plenty, "none.png").state, CaseState::Unreadable);
}

TEST_F(CompareCase, both_sides_are_looked_at) {
  write("a.png", std::string("RIFF"));
  write("b.png", std::string("RIFF\1\2\3\4WEBP"));
  EXPECT_THAT(compare().why, ElementsAre(HasSubstr("not a PNG file"), HasSubstr("a WebP")));
  write("b.png", png_file(header_of(9, 9), png_chunk("IDAT", "nothing")));
  EXPECT_THAT(compare().why,
              ElementsAre(HasSubstr("a.png: this is not a PNG file"), HasSubstr("cannot be read")));
}

TEST(MemoryBudget, lets_as_many_at_once_as_fit) {
  MemoryBudget memory(100);
  std::atomic<int> held = 0, most = 0;
  std::atomic<bool> over = false;
  std::vector<std::jthread> all;
  for (int n = 0; n < 4; ++n)
    all.emplace_back([&, n] {
      for (int k = 0; k < 500; ++k) {
        const int bytes = 1 + (n * 37 + k * 11) % 100;
        const MemoryBudget::Share share = memory.take(static_cast<std::size_t>(bytes));
        const int now = held += bytes;
        if (now > 100) over = true;
        most = std::max(most.load(), now);
        held -= bytes;
      }
    });
  all.clear();
  EXPECT_FALSE(over);
  EXPECT_GT(most, 0);
  const MemoryBudget::Share all_of_it = memory.take(100); // the whole budget was returned
}

TEST(MemoryBudget, is_three_quarters_of_what_is_available_and_8_GiB_at_most) {
  EXPECT_EQ(MemoryBudget::of_machine(4000), 3000u);
  EXPECT_EQ(MemoryBudget::of_machine(std::size_t{1} << 40), std::size_t{8} << 30);
}

} // namespace
} // namespace rend::compare_test
