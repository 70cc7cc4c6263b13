#include "render/compare/compare.h"

#include "render/compare/heat.h"
#include "render/files/input_file.h"
#include "render/files/png.h"
#include "sim/base/check.h"
#include "sim/base/enum_words.h"
#include "sim/base/error.h"
#include "sim/base/threads.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <new>

namespace rend {

namespace fs = std::filesystem;

const std::vector<CaseState>& all_states() {
  static const std::vector<CaseState> states{CaseState::Unreadable, CaseState::Size,   CaseState::Missing,
                                             CaseState::New,        CaseState::Differ, CaseState::Match};
  return states;
}

const char* name_of(CaseState state) {
  static constexpr EnumWords<CaseState::Unreadable> words{"match",   "differ", "size",
                                                          "missing", "new",    "unreadable"};
  return words[state];
}

namespace {

bool same_size(const PngInfo& a, const PngInfo& b) {
  return a.width == b.width && a.height == b.height;
}

// [bytes], upper bound
std::size_t comparing_bytes(const PngInfo& a, const PngInfo& b, const PngInfo& mask) {
  const std::size_t decoding = a.decoding_bytes() + b.decoding_bytes();
  if (!same_size(a, b)) return decoding;
  const std::size_t pixels = static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height);
  return std::max(decoding, a.file_bytes + b.file_bytes + mask.file_bytes + compared_bytes_a_pixel * pixels);
}

void check_room(std::size_t bytes, const fs::path& path, const PngInfo& head, const MemoryBudget& memory) {
  if (bytes <= memory.whole()) return;
  const Place place{path.string()};
  if (!head.is_plausible())
    throw UserError(Exit::BadInput, place,
                    fmt::format("its header says {} x {} pixels, but its {} bytes cannot hold them", head.width,
                                head.height, head.file_bytes));
  throw UserError(Exit::DiffError, place,
                  fmt::format("it has {} x {} pixels in {} bytes: comparing it takes {:.3g} GB of memory, and "
                              "{:.3g} GB are available",
                              head.width, head.height, head.file_bytes, static_cast<double>(bytes) / 1e9,
                              static_cast<double>(memory.whole()) / 1e9));
}

// One side of a case. An error on it ends the comparison.
struct Side {
  fs::path path;
  PngInfo head;
  std::vector<std::uint8_t> bytes;
  HighDepthImage image;
  std::string trouble; // the error; empty: it was read

  void look() {
    attempt([&] { head = png_info(path); });
  }
  void read() {
    attempt([&] { bytes = bytes_of(path, head); });
  }
  void decode() {
    attempt([&] { image = read_high_depth_png(bytes, path.string()); });
    bytes = std::vector<std::uint8_t>(); // assigning {} would keep the capacity
  }

  // The memory budget was taken by the size that `head` states.
  static std::vector<std::uint8_t> bytes_of(const fs::path& path, const PngInfo& head) {
    std::vector<std::uint8_t> bytes = file_bytes(path);
    if (png_info(bytes, path.string()) != head)
      throw UserError(Exit::BadInput, {path.string()}, "it changed while it was read");
    return bytes;
  }

private:
  template <class Action> void attempt(const Action& action) {
    if (!trouble.empty()) return;
    try {
      action();
    } catch (const UserError& error) {
      trouble = error.what();
    }
  }
};
using Sides = std::array<Side, 2>;

bool both_are_well(const Sides& sides) {
  return sides[0].trouble.empty() && sides[1].trouble.empty();
}

// Reads both pictures, on two threads if allowed. Returns whether their bytes are equal: then only the first
// has an image.
bool read_both(int threads, Sides& sides) {
  for (Side& side : sides) side.read();
  const bool equal = both_are_well(sides) && sides[0].bytes == sides[1].bytes;
  const std::size_t count = equal ? 1 : 2;
  parallel_ranges(std::min<int>(threads, static_cast<int>(count)), count,
                  [&](std::size_t begin, std::size_t end) {
                    for (std::size_t n = begin; n < end; ++n) sides[n].decode();
                  });
  return equal;
}

void note_kinds(const HighDepthImage& a, const HighDepthImage& b, CaseResult& out) {
  if (a.kind != b.kind) out.notes.push_back(fmt::format("expected: {}; now: {}", a.kind, b.kind));
  if (a.bits != b.bits)
    out.notes.emplace_back("one has 16 bits a channel, the other fewer: all bits are compared");
  if (a.channels != b.channels) out.notes.emplace_back("one has no alpha: it is taken as opaque");
}

PngInfo head_of_mask(const fs::path& path, const PngInfo& picture) {
  if (path.empty()) return {};
  const PngInfo head = png_info(path);
  if (!same_size(head, picture))
    throw UserError(Exit::BadInput, {path.string()},
                    fmt::format("the mask has {} x {} pixels, but the pictures have {} x {}", head.width,
                                head.height, picture.width, picture.height));
  return head;
}

PixelMask read_mask(const fs::path& path, const PngInfo& head) {
  if (path.empty()) return {};
  return mask_of(picture_of(read_high_depth_png(Side::bytes_of(path, head), path.string())));
}

Picture taken(HighDepthImage& image) {
  Picture picture = picture_of(image);
  image.samples = std::vector<std::uint16_t>();
  return picture;
}

void judge(Sides& sides, bool equal, const PngInfo& mask_head, const CompareOptions& options, CaseResult& out) {
  const PixelMask mask = read_mask(options.mask, mask_head);
  Picture a = taken(sides[0].image);
  Picture b = equal ? a : taken(sides[1].image);
  Metrics metrics = measure(std::move(a), std::move(b), mask,
                            {options.tolerance.threshold, options.tolerance.window_side, options.threads,
                             options.tolerance.leave_out_smoothed});
  for (const Excess& excess : excesses(options.tolerance, metrics)) out.why.push_back(excess.text());
  if (metrics.difference.counted == 0) out.notes.emplace_back("the mask leaves no pixel to compare");
  if (metrics.smoothed > 0)
    out.notes.push_back(fmt::format("{} pixel{} left out as smoothed edges", metrics.smoothed,
                                    metrics.smoothed == 1 ? "" : "s"));
  out.state = out.why.empty() ? CaseState::Match : CaseState::Differ;
  if (options.heat && out.state == CaseState::Differ && !metrics.flip_map.empty())
    out.heat = encode_png(heat_of(metrics.flip_map, out.width, out.height, mask));
  metrics.flip_map = Levels();
  metrics.difference.largest = Levels();
  out.metrics = std::move(metrics);
}

// Only one side exists: tests whether it is a valid picture at all.
void look_at_one(const fs::path& path, MemoryBudget& memory, CaseResult& out) {
  const PngInfo head = check_picture(path, memory);
  out.width = head.width;
  out.height = head.height;
}

void compare_both(const CompareOptions& options, MemoryBudget& memory, CaseResult& out) {
  Sides sides;
  sides[0].path = out.paths.a;
  sides[1].path = out.paths.b;
  for (Side& side : sides) side.look();
  const PngInfo &a = sides[0].head, &b = sides[1].head;
  const bool same = both_are_well(sides) && same_size(a, b);
  const PngInfo mask = same ? head_of_mask(options.mask, a) : PngInfo{};
  const std::size_t bytes = comparing_bytes(a, b, mask);
  const bool of_a = a.decoding_bytes() >= b.decoding_bytes();
  check_room(bytes, sides[of_a ? 0 : 1].path, of_a ? a : b, memory);
  const MemoryBudget::Share share = memory.take(bytes);
  const bool equal = read_both(options.threads, sides);
  for (const Side& side : sides)
    if (!side.trouble.empty()) out.why.push_back(side.trouble);
  if (!out.why.empty()) {
    out.state = CaseState::Unreadable;
    return;
  }
  out.width = a.width;
  out.height = a.height;
  note_kinds(sides[0].image, sides[equal ? 0 : 1].image, out);
  if (!same) {
    out.state = CaseState::Size;
    out.why = {
        fmt::format("{} x {} pixels are expected, but it has {} x {}", a.width, a.height, b.width, b.height)};
    return;
  }
  judge(sides, equal, mask, options, out);
}

void compare_or_throw(const CompareOptions& options, MemoryBudget& memory, CaseResult& out) {
  if (!out.paths.a.empty() && !out.paths.b.empty()) return compare_both(options, memory, out);
  const bool is_new = out.paths.a.empty();
  out.state = is_new ? CaseState::New : CaseState::Missing;
  out.why = {is_new ? "there is no expected picture of this name; --update adds it"
                    : "it is expected, but missing; --update removes it from what is expected"};
  look_at_one(is_new ? out.paths.b : out.paths.a, memory, out);
}

} // namespace

PngInfo check_picture(const fs::path& path, MemoryBudget& memory) {
  const PngInfo head = png_info(path);
  check_room(head.checking_bytes(), path, head, memory);
  const MemoryBudget::Share share = memory.take(head.checking_bytes());
  check_png(Side::bytes_of(path, head), path.string());
  return head;
}

// An error with one pair must not end the others: one bad file must not cost a page of a thousand.
CaseResult compare_case(const CasePaths& paths, const CompareOptions& options, MemoryBudget& memory) {
  const auto trouble = [&](const std::string& what) {
    CaseResult out;
    out.paths = paths;
    out.tolerance = options.tolerance;
    out.state = CaseState::Unreadable;
    out.why = {what};
    return out;
  };
  try {
    CaseResult out;
    out.paths = paths;
    out.tolerance = options.tolerance;
    compare_or_throw(options, memory, out);
    return out;
  } catch (const UserError& error) {
    return trouble(error.what());
  } catch (const std::bad_alloc&) {
    return trouble("there is not enough memory to compare it");
  } catch (const std::exception& error) { // including InternalError
    return trouble(fmt::format("it cannot be compared, by a fault of rend itself: {}", error.what()));
  }
}

} // namespace rend
