#include "sim/base/archive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rend::archive_test {
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
    a(flag, real, vector, darts, things, some, none);
    a.table(numbers, 2, "too many numbers");
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

TEST(Archive, reads_pieces_as_it_reads_the_whole) {
  const auto bytes = written(example());
  for (const std::size_t piece : {1, 3, 8, 1000}) {
    std::vector<std::uint8_t> held;
    std::size_t at = 0;
    const auto source = [&]() -> std::span<const std::uint8_t> {
      const std::size_t size = std::min(piece, bytes.size() - at);
      held.assign(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
      at += size;
      return held;
    };
    Everything there;
    Archive in(source, bytes.size());
    in(there);
    in.end();
    EXPECT_EQ(there, example()) << piece;
    at = 0;
    Archive promised(source, bytes.size() + 1);
    promised(there);
    EXPECT_THROW(promised.end(), ArchiveError) << "a byte is to come";
    std::uint8_t byte = 0;
    EXPECT_THROW(promised(byte), ArchiveError) << "and does not";
  }
}

template <class T> void expect_refused(T wrong) {
  Archive out;
  out.raw(&wrong, sizeof wrong);
  T there{};
  EXPECT_THROW(Archive{std::span<const std::uint8_t>(out.bytes())}(there), ArchiveError);
}

TEST(Archive, refuses_numbers_that_never_were_written) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  expect_refused(nan);
  expect_refused(infinite);
  expect_refused(-std::numeric_limits<float>::infinity());
  expect_refused(std::array{0.0, nan});
  Record fourth;
  fourth.w = 1;
  expect_refused(fourth);
  for (double Record::*each : {&Record::x, &Record::y, &Record::z, &Record::w}) {
    Record record;
    record.*each = nan;
    expect_refused(record);
  }
  std::uint8_t two = 2;
  bool flag = false;
  EXPECT_THROW(Archive{std::span<const std::uint8_t>(&two, 1)}(flag), ArchiveError);
}

TEST(Archive, takes_what_is_infinite_where_that_is_said_and_never_a_nan) {
  double written = -std::numeric_limits<double>::infinity(), read = 0;
  std::optional<double> some = 2.5, other;
  Archive out;
  out.unbounded(written, some);
  Archive in{std::span<const std::uint8_t>(out.bytes())};
  in.unbounded(read, other);
  in.end();
  EXPECT_EQ(read, written);
  EXPECT_EQ(other, some);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::uint8_t> bytes(sizeof nan);
  std::memcpy(bytes.data(), &nan, sizeof nan);
  EXPECT_THROW(Archive{std::span<const std::uint8_t>(bytes)}.unbounded(read), ArchiveError);
}

TEST(Archive, refuses_lists_that_are_longer_than_they_may_be_before_there_is_room_for_them) {
  std::vector<std::uint8_t> bytes(1'000'000);
  const auto first = [&](std::uint64_t count) { std::memcpy(bytes.data(), &count, sizeof count); };
  std::vector<Thing> things; // each takes 12 bytes in the archive, and 40 in memory
  std::vector<std::uint8_t> plain;
  for (const std::uint64_t count :
       {std::uint64_t{11}, std::uint64_t{900'000}, std::uint64_t{1} << 60U, ~std::uint64_t{0}}) {
    first(count);
    EXPECT_THROW(Archive{std::span<const std::uint8_t>(bytes)}.list(things, 10, "more than ten"), ArchiveError);
    EXPECT_THROW(Archive{std::span<const std::uint8_t>(bytes)}.list(plain, 10, "more than ten"), ArchiveError);
    EXPECT_THROW(Archive{std::span<const std::uint8_t>(bytes)}.fixed(plain, "none"), ArchiveError);
  }
  EXPECT_EQ(things.capacity() + plain.capacity(), 0u);
  first(900'000);
  EXPECT_THROW(Archive{std::span<const std::uint8_t>(bytes)}(things), ArchiveError) << "there are fewer";
  EXPECT_LT(things.capacity(), 200'000u);
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
} // namespace rend::archive_test
