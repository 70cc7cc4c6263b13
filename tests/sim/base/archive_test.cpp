#include "sim/base/archive.h"

#include <gtest/gtest.h>

namespace rend {
namespace {

struct Thing {
  int number = 0;
  std::string name;
  void store(Archive& a) { a(number, name); }
  bool operator==(const Thing&) const = default;
};

struct Everything {
  bool flag = false;
  double real = 0;
  Vec3 vector = Vec3::Zero();
  std::vector<Dart> darts;
  std::vector<Thing> things;
  std::optional<double> some, none;
  std::map<std::uint32_t, std::size_t> numbers;
  void store(Archive& a) {
    a.mark("everything");
    a(flag, real, vector, darts, things, some, none, numbers);
  }
  bool operator==(const Everything&) const = default;
};

Everything example() {
  Everything e;
  e.flag = true;
  e.real = 1.0 / 3;
  e.vector = {1, -0.0, 5e-324};
  e.darts = {Dart(7u), Dart()};
  e.things = {{1, "one"}, {2, ""}};
  e.some = 2.5;
  e.numbers = {{3, 4}, {5, 6}};
  return e;
}

std::vector<std::uint8_t> written(Everything e) {
  Archive out;
  out(e);
  return out.bytes();
}

TEST(Archive, reads_what_it_wrote_over_what_was_there) {
  Everything there;
  there.none = 7;
  there.numbers = {{9, 9}};
  there.darts.resize(100);
  const auto bytes = written(example());
  Archive in{std::span<const std::uint8_t>(bytes)};
  in(there);
  in.end();
  EXPECT_EQ(there, example());
  EXPECT_TRUE(std::signbit(there.vector.y()));
  EXPECT_EQ(written(there), bytes);
}

TEST(Archive, refuses_what_ends_too_early_wherever_that_is) {
  const auto bytes = written(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    Everything there;
    Archive in{std::span(bytes).first(size)};
    EXPECT_THROW(in(there), ArchiveError) << size;
  }
}

TEST(Archive, hands_on_pieces_that_are_together_what_it_would_have_kept) {
  std::vector<std::uint32_t> numbers(1'000'000);
  for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = static_cast<std::uint32_t>(n * n);
  Archive kept;
  kept(numbers, numbers);
  std::vector<std::uint8_t> together;
  std::vector<std::size_t> sizes;
  Archive handed([&](std::span<const std::uint8_t> piece) {
    together.insert(together.end(), piece.begin(), piece.end());
    sizes.push_back(piece.size());
  });
  handed(numbers, numbers);
  handed.end();
  EXPECT_TRUE(together == kept.bytes());
  for (std::size_t n = 0; n + 1 < sizes.size(); ++n) EXPECT_EQ(sizes[n], Archive::piece);
  EXPECT_EQ(sizes.size(), 8u);
}

TEST(Archive, refuses_other_marks_and_other_numbers_and_what_is_left_over) {
  Archive out;
  out.mark("map");
  out.same(3, "dimension");
  const auto bytes = out.bytes();
  EXPECT_THROW(Archive{std::span<const std::uint8_t>(bytes)}.mark("guard"), ArchiveError);
  Archive in{std::span<const std::uint8_t>(bytes)};
  in.mark("map");
  EXPECT_THROW(in.end(), ArchiveError);
  EXPECT_THROW(in.same(2, "dimension"), ArchiveError);
}

} // namespace
} // namespace rend
