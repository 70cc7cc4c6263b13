#include "render/pipeline/queue.h"

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace rend::queue_test {
namespace {

TEST(BoundedQueue, HandsThingsOnInOrderAndNeverHoldsMoreThanItMay) {
  BoundedQueue<int> queue(3);
  std::atomic<int> pushed = 0, popped = 0;
  std::thread producer([&] {
    for (int i = 0; i < 1000; ++i) {
      ASSERT_TRUE(queue.push(i));
      ++pushed;
    }
    queue.close();
  });
  int expected = 0;
  while (const auto thing = queue.pop()) {
    EXPECT_EQ(*thing, expected++);
    ++popped;
    EXPECT_LE(pushed - popped, 4); // three inside, and one just taken
  }
  producer.join();
  EXPECT_EQ(expected, 1000);
}

TEST(BoundedQueue, GivesOutWhatIsInsideAfterItWasClosed) {
  BoundedQueue<int> queue(2);
  queue.push(1);
  queue.close();
  EXPECT_FALSE(queue.push(2));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, WakesAPusherWhenItIsAbandoned) {
  BoundedQueue<int> queue(1);
  queue.push(1);
  std::thread producer([&] { EXPECT_FALSE(queue.push(2)); });
  queue.abandon();
  producer.join();
  EXPECT_EQ(queue.pop(), std::nullopt);
}

} // namespace
} // namespace rend::queue_test
