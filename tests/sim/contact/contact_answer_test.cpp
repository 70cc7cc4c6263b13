// The answer to contacts, against mechanics: momentum, Coulomb's law, and that no impulse makes energy.
#include "sim/contact/contact_answer.h"

#include "sim/presets.h"

#include <gtest/gtest.h>

#include <random>

namespace rend::contact_answer_test {
namespace {

// A sheet of free vertices that fly about, some of which are held along an axis or two.
presets::Loaded flying(const std::string& scheme) {
  return presets::load(
      R"(<scene><body><sheet cells="5 5" size="1 1"/><mass total="2"/><springs><stretch k="1e-6"/></springs>
      <fix side="-x" axes="z"/><fix side="+x" axes="xy"/><contact with="obstacles self" thickness="0"/></body>
      <world gravity="0 0 0"><sphere centre="9 9 9" radius="1" mass="0.7"/></world>
      <time step="1e-2" integrator=")" +
      scheme + R"(" duration="1"/></scene>)");
}

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution(low, high)(engine); }
  Vec3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
};

// Vertices get random velocities before and after the scheme; contacts are random pairs of a vertex and a point
// of a face, or the sphere, that are closer than they should be.
class RandomContacts {
public:
  RandomContacts(const std::string& scheme, unsigned seed)
      : scene_(flying(scheme)), body_(scene_.body(), scene_->scheme().contact), draw_{std::mt19937(seed)},
        halves_(scheme == "verlet") {
    Body& body = scene_.body();
    scene_->step();
    body.next.resize(body.vertices());
    body_.prepare(0, 1);
    sphere_ = scene_->world().spheres[0];
    for (Slot v = 0; v < body.vertices(); ++v) {
      body.map->velocity().values()[v] = Record(free(v, draw_.vector(1)));
      body.next.velocity[v] = Record(body.map->velocity()[v].vec() + free(v, draw_.vector(2)));
      body.next.position[v] = body.map->position()[v];
    }
    sphere_.velocity = draw_.vector(1);
    sphere_.next_velocity = draw_.vector(1);
    answer_.begin();
    for (int n = 0; n < 12; ++n) add();
  }

  // [J]: Σ ½ m Δv·(v + v') of all vertices and the sphere, from the velocities themselves.
  double solved() {
    const auto of = [](double mass, const Vec3& before, const Vec3& free, const Vec3& now) {
      return 0.5 * mass * (now - free).dot(before + now);
    };
    const Body& body = scene_.body();
    const std::vector<Record> free = body.next.velocity;
    const Vec3 sphere = sphere_.next_velocity;
    answer_.solve(1e-2);
    double sum = of(sphere_.mass, sphere_.velocity, sphere, sphere_.next_velocity);
    for (Slot v = 0; v < body.vertices(); ++v)
      sum +=
          of(1 / body.inverse_mass[v],
             halves_ ? Vec3(2 * body.map->velocity()[v].vec() - free[v].vec()) : body.map->velocity()[v].vec(),
             free[v], body.next.velocity[v]);
    return sum;
  }
  std::size_t touching() const { return answer_.touching(); }

private:
  // Held axes do not move, so that supports do no work.
  Vec3 free(Slot v, Vec3 u) const {
    for (int a = 0; a < 3; ++a)
      if (body_.inverse_mass(v)[a] == 0) u[a] = 0;
    return u;
  }
  void add() {
    const auto vertex = [&] { return static_cast<Slot>(draw_(0, 35.99)); };
    const Vec3 normal = draw_.vector(1).normalized();
    const ContactPoint a = ContactPoint::at(body_, vertex());
    if (a.held(normal)) return; // its support takes what it does not
    const ContactPoint b{&body_, {vertex(), vertex(), vertex()}, {0.2, 0.3, 0.5}};
    ContactConstraint contact{.a = ContactSide::of(a, a.held(normal)),
                              .b = draw_(0, 1) < 0.3 || b.held(normal) ? ContactSide::of(sphere_)
                                                                       : ContactSide::of(b, false),
                              .normal = normal,
                              .friction = draw_(0, 1),
                              .restitution = draw_(0, 1)};
    contact.apart = contact.gap() + draw_(0, 0.03);
    answer_.add(contact);
  }

  presets::Loaded scene_;
  ContactBody body_;
  Draw draw_;
  bool halves_;
  Sphere sphere_;
  ContactAnswer answer_{false};
};

TEST(ContactAnswer, makes_no_energy_whatever_touches) {
  std::size_t touching = 0;
  double most = 0, taken = 0;
  for (const char* scheme : {"symplectic", "verlet"}) {
    for (unsigned seed = 0; seed < 100; ++seed) {
      RandomContacts contacts(scheme, seed);
      const double energy = contacts.solved();
      most = std::max(most, energy);
      taken -= energy;
      touching += contacts.touching();
    }
  }
  EXPECT_LT(most, 1e-9);
  EXPECT_GT(taken, 1);
  EXPECT_GT(touching, 500u);
}

} // namespace
} // namespace rend::contact_answer_test
