#include "render/picture/playback.h"

#include "sim/base/key_times.h"

#include <algorithm>
#include <cmath>

namespace rend {

template <> const Fields<SpeedKey>& fields_of() {
  using S = SpeedKey;
  static const Fields<S> fields{
      field(&S::at, number("at", "s", "when, in the time of the simulation").at_least(0).is_required()),
      field(&S::speed,
            number("speed", "", "seconds of simulation in a second of the clip; 0.1: ten times slower")
                .at_least(least_speed)
                .at_most(most_speed)
                .is_required())};
  return fields;
}

Playback::Playback(double speed) : pieces_{{.speed = speed}} {
  CHECK(speed > 0 && std::isfinite(speed));
}

Playback::Playback(double speed, const std::vector<SpeedKey>& keys)
    : Playback(keys.empty() ? speed : keys.front().speed) {
  for (std::size_t n = 1; n < keys.size(); ++n) add_key(keys[n - 1], keys[n]);
}

// The last piece is the one with the speed of `from`, however long.
void Playback::add_key(const SpeedKey& from, const SpeedKey& to) {
  CHECK(to.speed > 0 && std::isfinite(to.speed));
  check_key_times(from.at, to.at, to.source);
  Piece changing{.simulated = from.at, .clip = clip(from.at), .speed = from.speed};
  changing.change = (to.speed * to.speed - from.speed * from.speed) / (2 * (to.at - from.at));
  if (pieces_.back().simulated == from.at) pieces_.pop_back(); // a constant speed of no length
  pieces_.push_back(changing);
  const double took = 2 * (to.at - from.at) / (from.speed + to.speed); // [s] of the clip
  pieces_.push_back({.simulated = to.at, .clip = changing.clip + took, .speed = to.speed});
}

double Playback::Piece::speed_at(double time) const {
  return change == 0 ? speed : std::sqrt(std::max(speed * speed + 2 * change * (time - simulated), 0.0));
}

double Playback::Piece::clip_at(double time) const {
  if (change == 0) return clip + (time - simulated) / speed;
  return clip + 2 * (time - simulated) / (speed + speed_at(time));
}

namespace {

// The last piece that starts at or before a time; the first where none does.
template <class Pieces, class Start> const auto& piece_at(const Pieces& pieces, double time, Start start) {
  std::size_t n = pieces.size() - 1;
  while (n > 0 && pieces[n].*start > time) --n;
  return pieces[n];
}

} // namespace

double Playback::slowest() const {
  double least = pieces_.front().speed;
  for (const Piece& piece : pieces_) least = std::min(least, piece.speed);
  return least;
}

double Playback::simulated(double clip) const {
  const Piece& piece = piece_at(pieces_, clip, &Piece::clip);
  const double passed = clip - piece.clip; // [s]
  return piece.simulated + (piece.speed + piece.change * passed / 2) * passed;
}

double Playback::clip(double simulated) const {
  return piece_at(pieces_, simulated, &Piece::simulated).clip_at(simulated);
}

double Playback::speed_at(double simulated) const {
  return piece_at(pieces_, simulated, &Piece::simulated).speed_at(simulated);
}

} // namespace rend
