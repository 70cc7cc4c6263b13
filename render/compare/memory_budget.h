// A memory budget that concurrent comparisons of pictures share.
//
// A valid PNG of some kilobytes can decode to gigabytes, and several pairs are compared in parallel. So each
// comparison computes an upper bound from the PNG headers before anything is decoded, and reserves that from
// the budget until it is done. It waits while others hold too much; it is refused if it exceeds the whole
// budget by itself. Whether it is refused depends on that pair alone, not on the number of threads.
//
//   whole = the least of 8 GiB and 3/4 of the memory that is available (available_memory.h)
//   one   = the files, and 96 bytes a pixel of two pictures of one size
//
// Two pictures of 89 million pixels fit, such as 9400 x 9400. For two pictures of different sizes the bound is
// that of decoding them; for a single one, its file and a few rows (PngInfo, png_reader.h).
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace rend {

constexpr std::size_t most_compared_bytes = std::size_t{8} << 30;

// Planes of two pictures take 24 bytes a pixel, the largest differences 4, filtered planes of FLIP 56, its map
// 4; the rest is for the mask and for encoding the map as PNG. SSIM needs a few rows only.
constexpr std::size_t compared_bytes_a_pixel = 96;

class MemoryBudget {
public:
  explicit MemoryBudget(std::size_t whole) : whole_(whole), left_(whole) {}
  // `whole` as above, for a machine with `available` bytes of free memory. [bytes]
  static std::size_t of_machine(std::size_t available);

  std::size_t whole() const { return whole_; } // [bytes]

  // The reservation of one comparison, returned on destruction.
  class Share {
  public:
    Share(MemoryBudget& budget, std::size_t bytes) : budget_(budget), bytes_(bytes) {}
    ~Share() { budget_.give_back(bytes_); }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

  private:
    MemoryBudget& budget_;
    std::size_t bytes_;
  };
  // Blocks until so much is free; at most the whole budget (CHECK). A thread must not hold two at once: two
  // threads could then deadlock.
  Share take(std::size_t bytes);

private:
  void give_back(std::size_t bytes);

  const std::size_t whole_;
  std::size_t left_;
  std::mutex mutex_; // guards left_
  std::condition_variable given_back_;
};

} // namespace rend
