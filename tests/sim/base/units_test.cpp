#include "sim/base/units.h"

#include <gtest/gtest.h>

namespace rend::units_test {
namespace {

TEST(Units, have_the_prefix_that_leaves_one_to_three_digits) {
  EXPECT_EQ(in_units(12300, "Pa"), "12.3 kPa");
  EXPECT_EQ(in_units(0.5, "N"), "500 mN");
  EXPECT_EQ(in_units(1, "J"), "1 J");
  EXPECT_EQ(in_units(2.88e-5, "s"), "28.8 µs");
  EXPECT_EQ(in_units(-2e6, "Pa"), "−2 MPa");
  EXPECT_EQ(in_units(0, "J"), "0 J");
}

TEST(Units, a_number_that_rounds_up_takes_the_next_prefix) {
  EXPECT_EQ(in_units(999.9, "Pa"), "1 kPa");
  EXPECT_EQ(in_units(0.9996, "m"), "1 m");
}

TEST(Units, beyond_the_prefixes_and_without_a_unit_there_are_powers_of_ten) {
  EXPECT_EQ(in_units(3e-15, "J"), "3e-15 J");
  EXPECT_EQ(in_units(0.25, ""), "0.25");
}

} // namespace
} // namespace rend::units_test
