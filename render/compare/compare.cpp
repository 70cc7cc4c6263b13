#include "render/compare/compare.h"

#include "render/compare/heat.h"
#include "render/png.h"
#include "sim/base/check.h"
#include "sim/base/error.h"
#include "sim/program/threads.h"

#include <array>
#include <fmt/format.h>

namespace rend {

namespace fs = std::filesystem;

const std::vector<CaseState>& all_states() {
  static const std::vector<CaseState> states{CaseState::Unreadable, CaseState::Size,   CaseState::Missing,
                                             CaseState::New,        CaseState::Differ, CaseState::Match};
  return states;
}

const char* name_of(CaseState state) {
  switch (state) {
  case CaseState::Match:
    return "match";
  case CaseState::Differ:
    return "differ";
  case CaseState::Size:
    return "size";
  case CaseState::Missing:
    return "missing";
  case CaseState::New:
    return "new";
  case CaseState::Unreadable:
    break;
  }
  return "unreadable";
}

namespace {

// One side of a case.
struct Side {
  std::vector<std::uint8_t> bytes;
  DeepImage image;
  std::string trouble; // empty: it was read

  void read(const fs::path& path, bool decode) {
    try {
      if (bytes.empty()) bytes = file_bytes(path);
      if (decode) image = read_deep_png(bytes, path.string());
    } catch (const UserError& error) {
      trouble = error.what();
    }
  }
};

// Both at once, on two threads where there are two; equal bytes are decoded once.
bool read_both(const CasePaths& paths, int threads, std::array<Side, 2>& sides) {
  for (std::size_t n = 0; n < 2; ++n) sides[n].read(n == 0 ? paths.a : paths.b, false);
  if (!sides[0].trouble.empty() || !sides[1].trouble.empty()) return false;
  const bool equal = sides[0].bytes == sides[1].bytes;
  const std::size_t count = equal ? 1 : 2;
  in_parts(std::min<int>(threads, static_cast<int>(count)), count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) sides[n].read(n == 0 ? paths.a : paths.b, true);
  });
  if (equal) {
    sides[1].image = sides[0].image;
    sides[1].trouble = sides[0].trouble;
  }
  return equal;
}

void note_kinds(const DeepImage& a, const DeepImage& b, Compared& out) {
  if (a.kind != b.kind) out.notes.push_back(fmt::format("expected: {}; now: {}", a.kind, b.kind));
  if (a.bits != b.bits)
    out.notes.push_back("one has 16 bits a channel, the other fewer: all bits are compared");
  if (a.channels != b.channels) out.notes.push_back("one has no alpha: it is taken as opaque");
}

Mask read_mask(const fs::path& path, int width, int height) {
  if (path.empty()) return {};
  const Picture picture = picture_of(read_deep_png(file_bytes(path), path.string()));
  if (picture.width != width || picture.height != height)
    throw UserError(Exit::BadInput, {path.string()},
                    fmt::format("the mask has {} x {} pixels, and the pictures have {} x {}", picture.width,
                                picture.height, width, height));
  return mask_of(picture);
}

void judge(const std::array<Side, 2>& sides, bool equal, const CompareOptions& options, Compared& out) {
  const Mask mask = read_mask(options.mask, out.width, out.height);
  Picture a = picture_of(sides[0].image);
  Picture b = equal ? a : picture_of(sides[1].image);
  Metrics metrics = measure(std::move(a), std::move(b), mask,
                            {options.tolerance.threshold, options.tolerance.window_side, options.threads});
  for (const Excess& excess : excesses(options.tolerance, metrics)) out.why.push_back(excess.text());
  if (metrics.difference.counted == 0) out.notes.push_back("the mask leaves no pixel to compare");
  out.state = out.why.empty() ? CaseState::Match : CaseState::Differ;
  if (options.heat && out.state == CaseState::Differ && !metrics.flip_map.empty())
    out.heat = encode_png(heat_of(metrics.flip_map, out.width, out.height, mask));
  metrics.flip_map = {};
  metrics.difference.largest = {};
  out.metrics = std::move(metrics);
}

// Only one side is there: whether it is a picture at all.
void look_at_one(const fs::path& path, Compared& out) {
  Side side;
  side.read(path, true);
  out.width = side.image.width;
  out.height = side.image.height;
  if (side.trouble.empty()) return;
  out.state = CaseState::Unreadable;
  out.why = {side.trouble};
}

} // namespace

Compared compare_case(const CasePaths& paths, const CompareOptions& options) {
  Compared out;
  out.paths = paths;
  out.tolerance = options.tolerance;
  if (paths.a.empty() || paths.b.empty()) {
    out.state = paths.a.empty() ? CaseState::New : CaseState::Missing;
    out.why = {paths.a.empty() ? "nothing is expected of this name" : "it is expected, and not there"};
    look_at_one(paths.a.empty() ? paths.b : paths.a, out);
    return out;
  }
  std::array<Side, 2> sides;
  const bool equal = read_both(paths, options.threads, sides);
  for (const Side& side : sides)
    if (!side.trouble.empty() && (out.why.empty() || !equal)) out.why.push_back(side.trouble);
  if (!out.why.empty()) {
    out.state = CaseState::Unreadable;
    return out;
  }
  const DeepImage &a = sides[0].image, &b = sides[1].image;
  out.width = a.width;
  out.height = a.height;
  note_kinds(a, b, out);
  if (a.width != b.width || a.height != b.height) {
    out.state = CaseState::Size;
    out.why = {fmt::format("{} x {} pixels are expected, and there are {} x {}", a.width, a.height, b.width,
                           b.height)};
    return out;
  }
  judge(sides, equal, options, out);
  return out;
}

} // namespace rend
