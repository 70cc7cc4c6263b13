#include "sim/topology/gmap.h"

#include "sim/base/archive.h"
#include "sim/base/bytes.h"
#include "sim/base/check.h"
#include "sim/topology/validate.h"

namespace rend {

GMap::GMap(int dimension) : dimension_(dimension) {
  CHECK(dimension == 2 || dimension == 3);
}

// The map as stored in an archive.
struct GMap::Stored {
  std::vector<Links> links;
  std::vector<std::uint32_t> free;

  bool removed(std::uint32_t dart) const { return links[dart][0] == Dart::none_value; }
  bool is_free(std::size_t i, std::uint32_t dart) const { return links[dart][i] == dart; }

  // A dart that is alive, compared to its links `was` in a valid map: within its element it must have the same
  // links, to darts that are alive; across the border of the element (αn) the same or a free one, consistently
  // over the whole face, which keeps αiαn an involution. Unchanged links of a valid map need no further check.
  void check_dart(std::uint32_t d, const Links& was, std::size_t n) const {
    const Links& now = links[d];
    for (std::size_t i = 0; i < n; ++i) {
      refuse_unless(now[i] == was[i], "a dart's link within its element is another");
      refuse_unless(!removed(now[i]), "an element is there in part");
    }
    if (n == 2) refuse_unless(now[3] == d, "a dart of a sheet is not α3-free");
    if (!is_free(n, d)) {
      refuse_unless(now[n] == was[n], "a dart's link across its element's border is another");
      refuse_unless(links[now[n]][n] == d, "a border is open on one side");
    }
    for (std::size_t i = 0; i + 2 <= n; ++i)
      refuse_unless(is_free(n, now[i]) == is_free(n, d), "a border is open in part");
  }

  // Every link leads to a dart that is alive; a removed dart has none.
  void check_links(int dimension) const {
    constexpr Links none{Dart::none_value, Dart::none_value, Dart::none_value, Dart::none_value};
    for (std::uint32_t d = 0; d < links.size(); ++d) {
      if (removed(d)) {
        refuse_unless(links[d] == none, "a dart is removed in part");
        continue;
      }
      for (std::uint32_t link : links[d])
        refuse_unless(link < links.size() && !removed(link), "a link leads to no dart");
      refuse_unless(dimension == 3 || links[d][3] == d, "a dart of a sheet is not α3-free");
    }
  }

  // The free list must name each removed dart once.
  void check_free(std::size_t removed_darts) const {
    std::vector<bool> named(links.size());
    refuse_unless(free.size() == removed_darts, "the free darts are not as many as were removed");
    for (const std::uint32_t d : free) {
      refuse_unless(d < links.size() && removed(d) && !named[d], "a free dart is none, or is free twice");
      named[d] = true;
    }
  }
};

void GMap::store(Archive& archive) {
  archive.same(static_cast<std::uint64_t>(dimension_), "dimension");
  if (!archive.reading()) return archive(links_, free_);
  Stored stored;
  stored.links.resize(links_.size());
  archive.fixed(stored.links, "number of darts");
  archive.list(stored.free, links_.size(), "there are more free darts than darts");
  std::size_t removed = 0;
  constexpr Links none{Dart::none_value, Dart::none_value, Dart::none_value, Dart::none_value};
  for (std::uint32_t d = 0; d < links_.size(); ++d) {
    if (!stored.removed(d)) {
      stored.check_dart(d, links_[d], static_cast<std::size_t>(dimension_));
      continue;
    }
    refuse_unless(stored.links[d] == none, "a dart is removed in part");
    ++removed;
  }
  stored.check_free(removed);
  links_.swap(stored.links);
  free_.swap(stored.free);
}

void GMap::store_any(Archive& archive, std::size_t most_darts) {
  archive.same(static_cast<std::uint64_t>(dimension_), "dimension");
  if (!archive.reading()) {
    archive.list(links_, most_darts, "");
    return archive.list(free_, most_darts, "");
  }
  Stored stored;
  archive.list(stored.links, most_darts, "there are more darts than rules can have made");
  archive.list(stored.free, stored.links.size(), "there are more free darts than darts");
  stored.check_links(dimension_);
  std::size_t removed = 0;
  for (std::uint32_t d = 0; d < stored.links.size(); ++d) removed += stored.removed(d);
  stored.check_free(removed);
  GMap read(dimension_);
  read.links_ = std::move(stored.links);
  read.free_ = std::move(stored.free);
  if (const auto broken = validate(read)) throw ArchiveError(broken->text());
  *this = std::move(read);
}

std::size_t GMap::bytes() const {
  return bytes_of(links_) + bytes_of(free_);
}

} // namespace rend
