// The only writer of a GMap. Its journal tells which derived data must be updated.
//
// The journal: for every i, the darts whose αi changed; the darts created; the darts removed. A dart may be
// listed more than once. Touched darts come in pairs, which were linked to each other or unlinked from each
// other.
//
// The journal is also what an edit is undone by, and nothing else is recorded for it:
//   links     Read backwards, each pair of touched[i] is found as the change left it: linked to each other by
//             αi, so that the change was a link; or free, so that it was an unlink. What happens to αj or to
//             the list of free darts in between does not matter.
//   darts     The list of free darts is a stack. Read backwards, the last change was a removal if and only if
//             the dart on top is the last of `removed`: whatever was created after it would have taken it off
//             first.
#pragma once

#include "sim/base/check.h"
#include "sim/topology/gmap.h"

#include <array>
#include <span>
#include <vector>

namespace rend {

struct Journal {
  std::array<std::vector<Dart>, 4> touched; // touched[i]: darts whose αi changed
  std::vector<Dart> created, removed;
  bool empty() const;
  void clear();
};

class MapEdit {
public:
  // Without a journal: for building a map from which nothing is derived yet.
  explicit MapEdit(GMap& map, Journal* journal = nullptr) : map_(map), journal_(journal) {}

  // How far an edit had come. Valid until a rollback to an earlier one.
  struct Savepoint {
    std::array<std::size_t, 4> touched{}; // lengths of the lists of the journal
    std::size_t created = 0, removed = 0;
    std::size_t capacity = 0; // of the map
  };

  const GMap& map() const { return map_; }
  const Journal* journal() const { return journal_; } // null: no journal

  Dart add_dart();                  // free in all its links; none that this edit has removed
  void remove_dart(Dart d);         // CHECK: free in all its links
  void link(int i, Dart a, Dart b); // αi(a) = b, αi(b) = a. CHECK: both αi-free
  void unlink(int i, Dart a);       // a and αi(a) become αi-free. CHECK: a is not free
  void reserve(std::size_t darts);

  Savepoint savepoint() const; // CHECK: there is a journal

  // Takes back all changes since then, in time proportional to their number: links, capacity and the list of
  // free darts, to its order, are as they were, and so is the journal. Allocates nothing.
  void rollback(const Savepoint& to) noexcept;

  // Appends links.size() darts, dart n with αi = first + links[n][i], where `first` is the dart that is
  // returned. CHECK: no journal, and no dart was removed. The caller guarantees that the links are involutions.
  Dart add_linked(std::span<const GMap::Links> links);

private:
  friend bool unsew(MapEdit& edit, int i, Dart d);
  Dart cut(int i, Dart a);                   // unlinks without a journal entry; returns what a was linked to
  void join(int i, Dart a, Dart b) noexcept; // the opposite
  void note(int i, std::span<const Dart> pairs) {
    if (!journal_) return;
    std::vector<Dart>& touched = journal_->touched[static_cast<std::size_t>(i)];
    touched.insert(touched.end(), pairs.begin(), pairs.end());
  }
  void note_cut(int i,
                std::span<const Dart> pairs); // of cut pairs; joins them again if there is no memory left
  void undo_links(std::size_t i, std::size_t from) noexcept;
  void undo_darts(const Savepoint& to) noexcept;

  GMap& map_;
  Journal* journal_;
};

inline void MapEdit::link(int i, Dart a, Dart b) {
  CHECK(map_.alive(a) && map_.alive(b));
  CHECK(map_.is_free(i, a) && map_.is_free(i, b));
  CHECK_NOTE(i < 3 || map_.dimension() == 3, "the darts of a sheet stay α3-free");
  if (a == b) return;
  note(i, std::array{a, b});
  join(i, a, b);
}

inline void MapEdit::join(int i, Dart a, Dart b) noexcept {
  map_.links_[a.value][static_cast<std::size_t>(i)] = b.value;
  map_.links_[b.value][static_cast<std::size_t>(i)] = a.value;
}

inline Dart MapEdit::cut(int i, Dart a) {
  CHECK(map_.alive(a));
  const Dart b = map_.alpha(i, a);
  CHECK(a != b);
  map_.links_[a.value][static_cast<std::size_t>(i)] = a.value;
  map_.links_[b.value][static_cast<std::size_t>(i)] = b.value;
  return b;
}

inline void MapEdit::unlink(int i, Dart a) {
  note_cut(i, std::array{a, cut(i, a)});
}

// Sews d and e by αi, and all corresponding darts of <0..i-2, i+2..3>(d) and (e). False, and nothing changed:
// one of them is not αi-free, the orbits are not isomorphic, or d and e belong to one orbit whose sewing
// contradicts itself.
bool sew(MapEdit& edit, int i, Dart d, Dart e);

// The inverse of sew. False, and nothing changed: d is αi-free.
bool unsew(MapEdit& edit, int i, Dart d);

// The orbit along which αi is sewn: <0..i-2, i+2..3>.
constexpr Orbit sewing_orbit(int i) {
  Orbit orbit;
  for (int j = 0; j < 4; ++j)
    if (j <= i - 2 || j >= i + 2) orbit.mask = static_cast<std::uint8_t>(orbit.mask | 1 << j);
  return orbit;
}

// Unlinks the darts of orbit(d) from all others, then removes them.
void remove_orbit(MapEdit& edit, Orbit orbit, Dart d);

} // namespace rend
