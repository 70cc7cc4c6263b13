// For tests that run the built program as a user does, in a folder of its own, and capture its output.
#pragma once

#include "tests/test_paths.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace rend::program {

namespace fs = std::filesystem;

inline std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Outcome {
  int code = 0; // exit code; 128 plus the signal's number, if a signal ended it
  std::string out, err;
  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

// A temporary folder, removed at the end of the test, in which commands are run.
class TestFolder {
public:
  TestFolder() : path_(fs::temp_directory_path() / ("rend-program-" + std::to_string(std::random_device()()))) {
    fs::create_directories(path_ / "here");
  }
  ~TestFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  // Runs `rend ARGUMENTS` through the shell.
  Outcome rend(const std::string& arguments) const {
    return shell(std::string(test::rend_program) + " " + arguments);
  }

  Outcome shell(const std::string& command) const {
    const std::string out = (path_ / "out").string(), err = (path_ / "err").string();
    const std::string line =
        "cd '" + path().string() + "' && { " + command + "; } >'" + out + "' 2>'" + err + "'";
    const int status = std::system(line.c_str());
    Outcome outcome;
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.out = content(out);
    outcome.err = content(err);
    return outcome;
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path() / name, std::ios::binary) << text;
  }

  // All files and folders below, sorted, as relative paths.
  std::vector<std::string> files() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(path()))
      all.push_back(fs::relative(entry.path(), path()).string());
    std::sort(all.begin(), all.end());
    return all;
  }
  fs::path path() const { return path_ / "here"; }

private:
  fs::path path_;
};

// A small cloth that is pulled apart and tears within its 0.3 s. Pictures are small, so that tests are quick.
inline const char* pulled = R"(<scene name="pulled">
  <body name="cloth">
    <sheet cells="6 6" size="1 1"/>
    <place rotate="90 0 0"/>
    <mass total="0.1"/>
    <springs><stretch k="60"/><shear kind="isotropic" k="43"/><bend kind="provot" k="10"/></springs>
    <viscosity value="0.1" per="body"/>
    <fix side="-x"/>
    <drive side="+x" velocity="4 0 0"/>
    <tear criterion="global-border" threshold="2"/>
  </body>
  <time step="1e-3" integrator="rk4" duration="0.3"/>
  <image size="64 48" fps="20" samples="1"/>
</scene>
)";

} // namespace rend::program
