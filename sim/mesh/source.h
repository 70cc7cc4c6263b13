// A mesh file in memory, and errors with their place in it: line and column of a text, the byte of a binary
// file.
#pragma once

#include "sim/base/error.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace rend {

class MeshSource {
public:
  // UserError: NoInput if there is no such file, BadInput if it is not a regular file or has unwritten parts,
  // ReadWrite if reading fails.
  // `noun`: what it is called where there is none.
  static MeshSource open(const std::filesystem::path& path, const std::string& noun = "mesh file");
  MeshSource(std::string name, std::string bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}

  const std::string& name() const { return name_; }
  std::string_view bytes() const { return bytes_; }

  bool binary = false; // errors then name the byte

  // UserError, BadInput.
  [[noreturn]] void fail(std::size_t offset, const std::string& what, const std::string& hint = {}) const;
  [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const; // of the file as a whole

private:
  std::string name_, bytes_;
};

} // namespace rend
