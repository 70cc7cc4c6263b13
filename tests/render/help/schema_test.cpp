#include "render/help/schema.h"

#include "tests/sim/preset/reading.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>

namespace rend::schema_test {
namespace {

namespace fs = std::filesystem;
using namespace small_table;

// Runs xmllint (libxml2), which is independent of our reader.
class SchemaTest : public testing::Test {
protected:
  void SetUp() override {
    if (std::system("xmllint --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "xmllint is not installed";
    folder_ = fs::temp_directory_path() / ("rend-schema-" + std::to_string(std::random_device()()));
    fs::create_directory(folder_);
    std::ofstream(folder_ / "scene.xsd") << schema(scene);
  }
  void TearDown() override {
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  // xmllint's exit code: 0 valid, 3 not valid, 5 the schema itself is wrong.
  int xmllint(const std::string& text) const {
    std::ofstream(folder_ / "p.xml") << text;
    const std::string folder = folder_.string();
    const int status = std::system(
        ("xmllint --noout --schema " + folder + "/scene.xsd " + folder + "/p.xml >" + folder + "/log 2>&1")
            .c_str());
    return WEXITSTATUS(status);
  }

  std::string log() const {
    std::ifstream file(folder_ / "log");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  fs::path folder_;
};

TEST_F(SchemaTest, AcceptsAPreset) {
  EXPECT_EQ(xmllint(preset), 0) << log();
}

TEST_F(SchemaTest, AgreesWithTheReader) {
  struct Case {
    const char *from, *to;
  };
  const Case cases[] = {
      {"k=\"60\"", "k=\"+6.e1\""},
      {"k=\"60\"", "k=\" .5 \""},
      {"k=\"60\"", "k=\"0\""},
      {"k=\"60\"", "k=\"-1\""},
      {"k=\"60\"", "k=\"INF\""},
      {"k=\"60\"", "k=\"NaN\""},
      {"k=\"60\"", "k=\"1e999\""},
      {"k=\"60\"", "k=\"12abc\""},
      {"k=\"60\"", ""},
      {"k=\"60\"", "k=\"60\" g=\"1\""},
      {"cells=\"4 4\"", "cells=\"4\""},
      {"cells=\"4 4\"", "cells=\"4 0\""},
      {"cells=\"4 4\"", "cells=\" 4\t+4 \""},
      {"cells=\"4 4\"", "cells=\"4 2147483648\""},
      {"cells=\"4 4\"", "cells=\"4 4.0\""},
      {"size=\"1 2\"", "size=\"1 2 3\""},
      {"size=\"1 2\"", "size=\"1 0\""},
      {"step=\"1e-3\"", "step=\"auto\""},
      {"step=\"1e-3\"", "step=\"never\""},
      {"step=\"1e-3\"", "step=\"0\""},
      {"\"rk4\"", "\"rk5\""},
      {"\"rk4\"", "\" rk4 \""},
      {"cumulated=\"yes\"", "cumulated=\"true\""},
      {"<map>", "<hud show='title time'/><map>"},
      {"<map>", "<hud show='title tim'/><map>"},
      {"<map>", "<hud show=''/><map>"},
      {"<look/></map>", "</map>"},
      {"<look/></map>", "<look/><look/></map>"},
      {"<key title=\"Legend\"/><look/>", "<look/><key title=\"Legend\"/>"},
      {"<key title=\"Legend\"/>", "<key at=\"1\"/>"},
      {"<map>", "<map>text"},
      {"<map>", "<mop/><map>"},
      {"<stretch k=\"60\"/>", "<stretch k=\"60\"/><stretch k=\"60\"/>"},
  };
  for (const Case& one : cases) {
    const std::string text = changed(one.from, one.to);
    bool reads = true;
    try {
      read_preset_text(text, "p.xml", scene);
    } catch (const UserError&) {
      reads = false;
    }
    EXPECT_EQ(xmllint(text), reads ? 0 : 3) << one.to << "\n" << log();
  }
}

TEST_F(SchemaTest, LeavesSomeCountsToTheReader) { // as schema.h says
  const std::string twice = changed("<map>", "<time/><map>");
  EXPECT_EQ(xmllint(twice), 0) << log();
  EXPECT_THROW(read_preset_text(twice, "p.xml", scene), UserError);
}

} // namespace
} // namespace rend::schema_test
