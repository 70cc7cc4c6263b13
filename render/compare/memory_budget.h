// How much memory pictures that are compared may take together.
//
// A PNG of some kilobytes may hold a picture of gigabytes, rightly, and several pairs are compared side by
// side. So each says from the headers what it will take at most, before anything is decoded, and takes that off
// a budget until it is done: where others hold too much it waits for them, and where it would be too large
// alone it is not compared. Which ones are depends on themselves alone, on any number of threads.
//
//   whole = the least of 8 GiB and 3/4 of the memory that is available (available_memory.h)
//   one   = the files, and 96 bytes a pixel of two pictures of one size
//
// Two pictures of 89 million pixels fit, such as 9400 x 9400. Of two that differ in size it is what decoding
// takes, of one alone the file and some rows (PngHead, png_reader.h).
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace rend {

constexpr std::size_t most_compared_bytes = std::size_t{8} << 30;

// While two pictures are measured their planes take 24, the largest differences 4, what FLIP has filtered 56,
// its map 4; the rest is for the mask and for what makes the map a PNG. SSIM works in a few rows.
constexpr std::size_t compared_bytes_a_pixel = 96;

class MemoryBudget {
public:
  explicit MemoryBudget(std::size_t whole) : whole_(whole), left_(whole) {}
  // The one above, of a machine where so much is available. [bytes]
  static std::size_t of_machine(std::size_t available);

  std::size_t whole() const { return whole_; } // [bytes]

  // What one comparison has taken, until it ends.
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
  // Waits until there is so much; at most the whole (CHECK). No thread takes two at once: each might wait for
  // the other.
  Share take(std::size_t bytes);

private:
  void give_back(std::size_t bytes);

  const std::size_t whole_;
  std::size_t left_;
  std::mutex mutex_; // of left_
  std::condition_variable given_back_;
};

} // namespace rend
