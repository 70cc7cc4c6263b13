#include "render/pages/named_values.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rend::named_values_test {
namespace {

const NamedValues row{{"name", "a, \"b\""}, {"count", 3},    {"step", 1e-5},
                      {"whole", 2.0},       {"holds", true}, {"missing", std::optional<double>()},
                      {"word", "plain"}};

TEST(NamedValues, are_an_object_of_json_in_their_order) {
  EXPECT_EQ(
      json_of(row).dump(),
      R"({"name":"a, \"b\"","count":3,"step":1e-05,"whole":2.0,"holds":true,"missing":null,"word":"plain"})");
}

TEST(NamedValues, are_a_line_of_csv_below_their_names) {
  EXPECT_EQ(csv_of({row, row}, CsvStyle::Plain), "name,count,step,whole,holds,missing,word\r\n"
                                                 "\"a, \"\"b\"\"\",3,1e-05,2.0,1,,plain\r\n"
                                                 "\"a, \"\"b\"\"\",3,1e-05,2.0,1,,plain\r\n");
  EXPECT_EQ(csv_of({row}, CsvStyle::Quoted), "name,count,step,whole,holds,missing,word\r\n"
                                             "\"a, \"\"b\"\"\",3,1e-05,2.0,true,,\"plain\"\r\n");
  EXPECT_EQ(csv_of({}, CsvStyle::Plain), "");
}

} // namespace
} // namespace rend::named_values_test
