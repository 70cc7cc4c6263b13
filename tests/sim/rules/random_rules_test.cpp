// Random legal rules and scripts over random maps: none breaks an axiom, all darts of a vertex agree where it
// is, and a script that is refused leaves every byte as it was. 20,000 applications of rules and 4,000 of
// scripts; 1,000,000 and 200,000 with REND_WHOLE=1.
#include "sim/base/archive.h"
#include "sim/rules/rule_values.h"
#include "sim/rules/script_run.h"
#include "tests/sim/assets.h"
#include "tests/sim/rules/random_rules.h"
#include "tests/sim/rules/random_scripts.h"
#include "tests/sim/rules/rule_text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

namespace rend::random_rules_test {
namespace {

bool near(const Vec3& a, const Vec3& b) {
  return (a - b).norm() <= 1e-9 * std::max({1.0, a.norm(), b.norm()});
}

// The instances at which the right graph says that the vertex of `node` at instance 0 .. lies.
std::vector<std::size_t> instances_of_vertex(const Rule& rule, const Match& match, std::size_t first,
                                             int node) {
  std::set<std::pair<std::size_t, int>> met{{first, node}};
  std::vector<std::pair<std::size_t, int>> stack{{first, node}};
  std::set<std::size_t> instances{first};
  while (!stack.empty()) {
    const auto [k, n] = stack.back();
    stack.pop_back();
    for (int i : {1, 2, 3}) {
      const RuleLink& link = rule.right.link(n, i);
      if (link.kind == RuleLink::Kind::Absent) continue;
      const bool implicit = link.kind == RuleLink::Kind::Implicit;
      const std::pair<std::size_t, int> next{implicit ? match.neighbour(k, link.to) : k,
                                             implicit ? n : link.to};
      if (!met.insert(next).second) continue;
      instances.insert(next.first);
      stack.push_back(next);
    }
  }
  return {instances.begin(), instances.end()};
}

// The values of each vertex that the rule sets, evaluated at each of its instances by itself. Returns how many
// were compared.
int compare_values(const Rule& rule, const Edit& edit, const Match& match) {
  const RuleContext context;
  const RuleValues values(rule, edit, match, context);
  int compared = 0;
  for (const Rule::Set& set : rule.sets)
    for (std::size_t first = 0; first < std::min<std::size_t>(match.instances, 4); ++first) {
      std::vector<std::size_t> instances = instances_of_vertex(rule, match, first, set.node);
      if (instances.size() > 12) instances.resize(12);
      try {
        const Point one = values.point(set, first);
        for (std::size_t k : instances) {
          const Point other = values.point(set, k);
          EXPECT_TRUE(near(one.position, other.position) && near(one.rest, other.rest) &&
                      near(one.velocity, other.velocity))
              << rule.print();
          compared += k != first;
        }
      } catch (const ExpressionError&) { // a direction that is not there: at one instance or at all
      }
    }
  return compared;
}

// Maps that rules are applied to until they have grown too large or vanished.
class Pool {
public:
  explicit Pool(std::mt19937& random) : random_(random) {
    for (const assets::Asset& asset : assets::all()) makers_.push_back(asset.make);
    makers_.push_back([this] { return assets::random_sewing(static_cast<unsigned>(random_()), 10, 50); });
    makers_.push_back([] { return assets::row_of_cubes(3); });
    for (std::size_t n = 0; n < makers_.size(); ++n) maps_.push_back(make(n));
  }
  std::size_t size() const { return maps_.size(); }
  EmbeddedMap& operator[](std::size_t n) {
    const std::size_t darts = maps_[n]->map().dart_count();
    if (darts > 250 || (darts == 0 && random_() % 4 == 0) || random_() % 20 == 0) maps_[n] = make(n);
    return *maps_[n];
  }

private:
  assets::Body make(std::size_t n) {
    assets::Body body = makers_[n]();
    for (Orbit orbit : {Edge, Face, Volume, FaceOfVolume, VertexOfFace, EdgeEndOfVolume})
      if (random_() % 3 == 0) body->use(orbit);
    for (Slot v = 0; v < body->position().values().size(); ++v) { // apart from the rest, and moving
      body->position()[v] = Record(body->position()[v].vec() * 1.5 + Vec3(0, 0, 0.01 * v));
      body->velocity()[v] = Record(0.1 * v, 1, 0);
    }
    return body;
  }

  std::mt19937& random_;
  std::vector<std::function<assets::Body()>> makers_;
  std::vector<assets::Body> maps_;
};

struct Tally {
  std::size_t applied = 0, rules = 0, created = 0, removed = 0, folded = 0, compared = 0, in_solids = 0;
};

void apply_to_some_maps(const Rule& rule, Pool& pool, std::mt19937& random, Tally& tally) {
  RuleRunner runner(rule);
  bool used = false;
  for (int attempt = 0; attempt < 30; ++attempt) {
    EmbeddedMap& body = pool[random() % pool.size()];
    if (body.map().capacity() == 0 && !rule.only_creates()) continue;
    const auto pick = [&] { return Dart{static_cast<std::uint32_t>(random() % body.map().capacity())}; };
    Hooks hooks;
    switch (rule.plan.hooks.size()) {
    case 0:
      break;
    case 1:
      hooks = pick();
      break;
    case 2:
      hooks = {pick(), pick()};
      break;
    case 3:
      hooks = {pick(), pick(), pick()};
      break;
    default:
      hooks = {pick(), pick(), pick(), pick()};
    }
    bool applied = false;
    body.edit([&](Edit& edit) {
      if (!runner.matches(edit, hooks)) return;
      tally.compared += static_cast<std::size_t>(compare_values(rule, edit, runner.match()));
      applied = runner.rewrite(edit);
    });
    const auto fault = validate(body);
    ASSERT_FALSE(fault) << fault.value_or("") << "\n" << rule.print();
    if (!applied) continue;
    used = true;
    ++tally.applied;
    tally.created += rule.creates();
    tally.removed += rule.removes();
    tally.folded += rule.settings.may_fold;
    tally.in_solids += body.dimension() == 3;
  }
  tally.rules += used;
}

TEST(RandomRules, that_are_legal_break_no_axiom_and_give_every_vertex_one_value) {
  const std::size_t enough = std::getenv("REND_WHOLE") ? 1000000 : 20000;
  std::mt19937 random(7);
  random_rules::Generator generator(11);
  Pool pool(random);
  Tally tally;
  while (tally.applied < enough && !HasFailure())
    ASSERT_NO_FATAL_FAILURE(apply_to_some_maps(generator.next(), pool, random, tally));
  EXPECT_GT(tally.rules, enough / 40);
  for (std::size_t each : {tally.created, tally.removed, tally.folded, tally.compared, tally.in_solids})
    EXPECT_GT(each, enough / 100);
  RecordProperty("rules", static_cast<int>(tally.rules));
  RecordProperty("refused", static_cast<int>(generator.refused));
  std::printf(
      "%zu applications of %zu rules (%zu refused): %zu created, %zu removed, %zu folded, %zu in solids; "
      "%zu values compared\n",
      tally.applied, tally.rules, generator.refused, tally.created, tally.removed, tally.folded,
      tally.in_solids, tally.compared);
}

// The same rules are printed and read back equal.
TEST(RandomRules, are_printed_and_read_back_equal) {
  random_rules::Generator generator(3);
  for (int n = 0; n < 500; ++n) {
    const Rule rule = generator.next();
    EXPECT_EQ(Rule(rule_text::read(rule.print())).print(), rule.print());
  }
}

std::vector<std::uint8_t> stored_bytes(EmbeddedMap& body) {
  Archive archive;
  body.store(archive);
  return archive.bytes();
}

struct ScriptTally {
  std::size_t scripts = 0, applied = 0, refused = 0, taken_back = 0, created = 0, in_solids = 0;
};

void apply_to_some_maps(const Script& script, Pool& pool, std::mt19937& random, ScriptTally& tally) {
  ScriptRunner runner(script, {.most_darts = 3000});
  for (int attempt = 0; attempt < 8; ++attempt) {
    EmbeddedMap& body = pool[random() % pool.size()];
    if (body.map().capacity() == 0 && script.has_hook()) continue;
    const Hooks hooks =
        script.has_hook() ? Hooks(Dart{static_cast<std::uint32_t>(random() % body.map().capacity())}) : Hooks();
    const std::vector<std::uint8_t> before = stored_bytes(body);
    const std::size_t darts = body.map().dart_count();
    bool applied = false;
    body.edit([&](Edit& edit) {
      applied = runner.apply(edit, hooks);
      EXPECT_TRUE(applied || edit.journal()->empty());
    });
    const auto fault = validate(body);
    ASSERT_FALSE(fault) << fault.value_or("") << "\n" << script.print();
    ASSERT_EQ(applied, runner.reason().empty()) << script.print();
    ASSERT_TRUE(applied || stored_bytes(body) == before) << script.print();
    tally.applied += applied;
    tally.refused += !applied;
    tally.taken_back += runner.reason().starts_with("step ") && !runner.reason().starts_with("step 1,");
    tally.created += applied && body.map().dart_count() > darts;
    tally.in_solids += applied && body.dimension() == 3;
  }
  ++tally.scripts;
}

TEST(RandomScripts, that_are_legal_break_no_axiom_and_refusals_change_no_byte) {
  const std::size_t enough = std::getenv("REND_WHOLE") ? 200000 : 4000;
  std::mt19937 random(5);
  random_scripts::Generator generator(23);
  Pool pool(random);
  ScriptTally tally;
  while (tally.applied < enough && !HasFailure())
    ASSERT_NO_FATAL_FAILURE(apply_to_some_maps(*generator.next(), pool, random, tally));
  for (std::size_t each : {tally.refused, tally.taken_back, tally.created, tally.in_solids})
    EXPECT_GT(each, enough / 100);
  std::printf(
      "%zu applications of %zu scripts (%zu refused at the check): %zu created, %zu in solids; %zu were "
      "refused, %zu of them after a first step\n",
      tally.applied, tally.scripts, generator.refused, tally.created, tally.in_solids, tally.refused,
      tally.taken_back);
}

} // namespace
} // namespace rend::random_rules_test
