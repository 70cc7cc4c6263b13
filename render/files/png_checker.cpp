// PngChecker: whether a file is a complete picture that need not be made again.
#include "render/files/png.h"

#ifdef REND_PNG
#include "render/files/png_chunks.h"

#include <fcntl.h>
#include <libdeflate.h>
#include <new>
#include <sys/stat.h>
#include <unistd.h>

namespace rend {
namespace {

// Owns a file descriptor.
struct Opened {
  int file;
  // O_NONBLOCK: opening a FIFO without a writer would block.
  explicit Opened(const std::filesystem::path& path)
      : file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {}
  ~Opened() {
    if (file >= 0) ::close(file);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
};

// The content of a regular file of at most so many bytes; empty for anything else.
void read_file(const std::filesystem::path& path, std::size_t most, std::vector<std::uint8_t>& bytes) {
  bytes.clear();
  const Opened opened(path);
  struct stat facts {};
  if (opened.file < 0 || ::fstat(opened.file, &facts) != 0 || !S_ISREG(facts.st_mode)) return;
  if (static_cast<std::uintmax_t>(facts.st_size) > most) return;
  bytes.resize(static_cast<std::size_t>(facts.st_size));
  std::size_t count = 0;
  for (ssize_t got = 1; got > 0 && count<bytes.size(); count += got> 0 ? static_cast<std::size_t>(got) : 0)
    got = ::read(opened.file, bytes.data() + count, bytes.size() - count);
  bytes.resize(count);
}

// Ancillary chunks may be skipped by a reader (PNG specification, 5.4), except tRNS, which would change the
// picture.
bool may_be_skipped(std::string_view name) {
  constexpr char small = 0x20; // bit 5 of the first letter: ancillary
  return (name[0] & small) != 0 && name != "tRNS";
}

bool crc_is_right(const PngChunk& chunk) {
  const std::uint32_t of_name = libdeflate_crc32(0, chunk.name.data(), chunk.name.size());
  return libdeflate_crc32(of_name, chunk.data.data(), chunk.data.size()) == chunk.crc;
}

std::string_view as_text(PngBytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace

struct PngChecker::Work {
  struct Free {
    void operator()(libdeflate_decompressor* decompressor) const { libdeflate_free_decompressor(decompressor); }
  };
  std::unique_ptr<libdeflate_decompressor, Free> decompressor{libdeflate_alloc_decompressor()};
  std::vector<std::uint8_t> file, data, rows;
};

PngChecker::PngChecker(const PngShape& shape) : shape_(shape), work_(std::make_unique<Work>()) {
  if (!work_->decompressor) throw std::bad_alloc();
}
PngChecker::~PngChecker() = default;

std::size_t PngChecker::bytes(const PngShape& shape) {
  return static_cast<std::size_t>(shape.height) *
         (1 + static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.channels));
}

bool PngChecker::is_whole(const std::filesystem::path& path, const PngText& text) {
  // Deflate expands incompressible rows by less than a percent; other programs may have added chunks.
  constexpr std::size_t added = 16 << 20;
  Work& work = *work_;
  read_file(path, 2 * bytes(shape_) + added, work.file);
  const PngHeader wanted{static_cast<std::uint32_t>(shape_.width),
                         static_cast<std::uint32_t>(shape_.height),
                         8,
                         shape_.channels == 4 ? 6 : 2,
                         0,
                         0,
                         0};
  if (png_header(work.file) != wanted) return false;
  return has_whole_chunks(text) && has_whole_rows();
}

// Collects the zlib stream in work_->data.
bool PngChecker::has_whole_chunks(const PngText& text) {
  Work& work = *work_;
  work.data.clear();
  const std::string wanted = text.keyword + std::string(1, '\0');
  std::string_view found, before;
  PngBytes rest = PngBytes(work.file).subspan(png_signature_bytes);
  while (const auto chunk = take_png_chunk(rest)) {
    if (!crc_is_right(*chunk)) return false;
    if (chunk->name == "IEND") return rest.empty() && found == text.text;
    if (chunk->name == "IDAT") {
      if (before != "IDAT" && !work.data.empty()) return false; // IDAT chunks must be consecutive
      work.data.insert(work.data.end(), chunk->data.begin(), chunk->data.end());
    } else if (chunk->name == "tEXt" && as_text(chunk->data).starts_with(wanted)) {
      found = as_text(chunk->data).substr(wanted.size());
    } else if (!before.empty() && !may_be_skipped(chunk->name)) { // the first must be IHDR
      return false;
    }
    before = chunk->name;
  }
  return false;
}

// The stream inflates to exactly the expected rows, each with one of the five filter types.
bool PngChecker::has_whole_rows() {
  Work& work = *work_;
  work.rows.resize(bytes(shape_));
  std::size_t taken = 0;
  const libdeflate_result result =
      libdeflate_zlib_decompress_ex(work.decompressor.get(), work.data.data(), work.data.size(),
                                    work.rows.data(), work.rows.size(), &taken, nullptr);
  if (result != LIBDEFLATE_SUCCESS || taken != work.data.size()) return false;
  const std::size_t row = work.rows.size() / static_cast<std::size_t>(shape_.height);
  for (std::size_t at = 0; at < work.rows.size(); at += row)
    if (work.rows[at] > 4) return false;
  return true;
}

} // namespace rend

#else

namespace rend {

struct PngChecker::Work {};
PngChecker::PngChecker(const PngShape& shape) : shape_(shape) {}
PngChecker::~PngChecker() = default;
std::size_t PngChecker::bytes(const PngShape&) {
  return 1;
}
bool PngChecker::is_whole(const std::filesystem::path&, const PngText&) {
  return false;
}

} // namespace rend

#endif
