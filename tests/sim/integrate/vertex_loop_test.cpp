// Loops over vertices: the same bits on any number of threads, for the state and for reductions.
#include "sim/integrate/vertex_loop.h"

#include "sim/random_meshes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace rend::vertex_loop_test {
namespace {

struct Many final : System {
  std::size_t count;
  int threads;
  Many(std::size_t count_, int threads_) : count(count_), threads(threads_) {}
  std::size_t vertices() const override { return count; }
  int parts() const override { return threads; }
  void forces(double, const Record*, const Record*, Record*) override {}
  void constrain(double, Record*, Record*) override {}
};

REND_INLINE void twice(std::size_t begin, std::size_t end, const System&, const Record* from, State& next,
                       Double4& probe) {
  Double4 seen = probe;
  for (std::size_t i = begin; i < end; ++i) next.write(i, 2.0 * load(from[i]), load(from[i]), seen);
  probe = seen;
}
REND_INLINE void copy(std::size_t begin, std::size_t end, const System&, const Record* from, Record* to) {
  for (std::size_t i = begin; i < end; ++i) store(to[i], load(from[i]));
}

State put(std::size_t count, int threads, const std::vector<Record>& from) {
  State next;
  next.resize(count);
  write_vertices<twice>(Many(count, threads), next, from.data());
  return next;
}

std::vector<Record> random_records(std::size_t count) {
  meshes::Noise noise(1);
  std::vector<Record> records(count);
  for (Record& r : records) r = Record(noise.vector());
  return records;
}

TEST(VertexLoop, gives_the_same_bits_on_any_number_of_threads) {
  for (const std::size_t count :
       {std::size_t{1}, probed_vertices, probed_vertices + 1, 5 * probed_vertices - 7, std::size_t{210000}}) {
    const std::vector<Record> from = random_records(count);
    const State one = put(count, 1, from);
    double squares = 0;
    for (const Record& v : from) squares += v.vec().squaredNorm();
    EXPECT_NEAR(one.motion(), squares, 1e-12 * squares);
    EXPECT_EQ(one.position[count / 2].vec(), 2 * from[count / 2].vec());
    for (const int threads : {2, 3, 7}) {
      const State several = put(count, threads, from);
      EXPECT_EQ(std::memcmp(one.position.data(), several.position.data(), count * sizeof(Record)), 0);
      EXPECT_EQ(std::memcmp(one.velocity.data(), several.velocity.data(), count * sizeof(Record)), 0);
      EXPECT_EQ(one.motion(), several.motion());
      std::vector<Record> copied(count);
      over_vertices<copy>(Many(count, threads), from.data(), copied.data());
      EXPECT_EQ(std::memcmp(from.data(), copied.data(), count * sizeof(Record)), 0);
    }
  }
}

TEST(VertexLoop, sees_a_number_that_is_not_finite_in_any_stretch) {
  std::vector<Record> from = random_records(3 * probed_vertices);
  EXPECT_TRUE(put(from.size(), 2, from).finite());
  from[2 * probed_vertices + 5].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(put(from.size(), 2, from).finite());
}

} // namespace
} // namespace rend::vertex_loop_test
