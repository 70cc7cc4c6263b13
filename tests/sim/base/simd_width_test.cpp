// The versions of a loop for each SIMD width against each other, bit for bit, and the values of REND_SIMD.
#include "sim/base/simd_width.h"

#include "sim/base/simd.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

namespace rend::simd_width_test {
namespace {

// Products and sums that a fused multiply-add would round differently, roots, quotients, and a sum over lanes.
REND_INLINE double mix(const Record* a, const Record* b, std::size_t count, Record* out) {
  Double4 total{};
  for (std::size_t i = 0; i + 4 <= count; i += 4) {
    Double4 c[4];
    for (std::size_t n = 0; n < 4; ++n) c[n] = load(a[i + n]) * load(b[i + n]) + load(a[i + n]);
    const Double4 length = square_root(sums_of(c[0] * c[0], c[1] * c[1], c[2] * c[2], c[3] * c[3]));
    for (int n = 0; n < 4; ++n) store(out[i + static_cast<std::size_t>(n)], c[n] / splat(length[n]));
    total += length;
  }
  return (total[0] + total[1]) + (total[2] + total[3]);
}

std::vector<Record> random_records(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Record> records(1000);
  for (Record& r : records) r = Record(Vec3(number(random), number(random), number(random)));
  return records;
}

#ifdef __x86_64__
TEST(SimdWidth, EveryCopyGivesTheSameBits) {
  const std::vector<Record> a = random_records(1), b = random_records(2);
  std::vector<Record> narrow(a.size()), wide(a.size());
  const Record *pa = a.data(), *pb = b.data();
  const std::size_t count = a.size();
  Record* out = narrow.data();
  const double sum = in_sse2<mix>(pa, pb, count, out);
  const auto expect_same = [&](double other) {
    EXPECT_EQ(sum, other);
    EXPECT_EQ(std::memcmp(narrow.data(), wide.data(), narrow.size() * sizeof(Record)), 0);
    std::fill(wide.begin(), wide.end(), Record{});
  };
  out = wide.data();
  if (has_width(SimdWidth::Avx2)) expect_same(in_avx2<mix>(pa, pb, count, out));
  expect_same(at_width<mix>(pa, pb, count, out));
}
#endif

TEST(SimdWidth, TheNarrowestIsEverywhere) {
  EXPECT_TRUE(has_width(SimdWidth::Sse2));
  EXPECT_TRUE(has_width(simd_width()));
}

struct Ended {
  int code = 0;
  std::string text; // of both streams
};
Ended run_with(const std::string& word) {
  const std::string command = "REND_SIMD='" + word + "' " + std::string(test::rend_program) + " --version 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  Ended ended;
  std::array<char, 256> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe)) ended.text += buffer.data();
  ended.code = WEXITSTATUS(pclose(pipe));
  return ended;
}

TEST(SimdWidth, EveryWordOfThisProcessorIsTaken) {
  for (SimdWidth width : {SimdWidth::Sse2, SimdWidth::Avx2}) {
    const Ended ended = run_with(name_of(width));
    EXPECT_EQ(ended.code, has_width(width) ? 0 : 64) << ended.text;
  }
  EXPECT_EQ(run_with("").code, 0);
}

TEST(SimdWidth, AnUnknownWordIsRefused) {
  const Ended ended = run_with("avx");
  EXPECT_EQ(ended.code, 64);
  EXPECT_THAT(ended.text, testing::HasSubstr("REND_SIMD: there is no vector unit 'avx'"));
  EXPECT_THAT(ended.text, testing::HasSubstr("there are: sse2"));
}

} // namespace
} // namespace rend::simd_width_test
