#include "render/draw/device.h"

#include "render/files/memory_left.h"
#include "sim/base/check.h"
#include "sim/base/error.h"
#include "sim/base/worker_threads.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace rend {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& hint) {
  throw UserError(Exit::CannotCreate, {}, "pictures cannot be drawn: " + what, hint);
}

// llvmpipe crashes with 512-bit vectors; 128 and 256 bits give the same pictures, so a user's choice of 128 is
// kept. Mesa's disk cache of compiled shaders does not record the vector width: cached code for another width
// writes beyond its buffers. So the cache is disabled; compiling takes a third of a second.
void pin_vector_width() {
  const char* width = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (width == nullptr || std::strcmp(width, "128") != 0) setenv("LP_NATIVE_VECTOR_WIDTH", "256", 1);
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

void must_have_memory() {
  if (!is_memory_left()) refuse_without_memory();
}

// llvmpipe starts two sets of this many threads, once per process, and waits for ever for one of the first set
// that could not be started. So the number is bounded by what can be started, besides threads that are started
// later. Returns whether this is fewer than llvmpipe would use.
bool bound_threads() {
  constexpr int of_others = 8; // threads of the pipeline and its encoder
  static const bool fewer = [] {
    const char* given = std::getenv("LP_NUM_THREADS");
    const int here = static_cast<int>(std::thread::hardware_concurrency());
    const int wanted = std::clamp(given != nullptr ? std::atoi(given) : here, 0, 16); // llvmpipe's maximum
    const int most = std::max(0, startable_threads(2 * wanted + of_others) - of_others) / 2;
    if (most >= wanted) return false;
    setenv("LP_NUM_THREADS", std::to_string(most).c_str(), 1);
    return true;
  }();
  return fewer;
}

class OsMesaDevice final : public Device {
public:
  OsMesaDevice() {
    pin_vector_width();
    must_have_memory();
    fewer_threads_ = bound_threads();
    const long refused = refused_thread_starts();
    const std::array<int, 15> attributes{OSMESA_FORMAT,
                                         OSMESA_RGBA,
                                         OSMESA_PROFILE,
                                         OSMESA_CORE_PROFILE,
                                         OSMESA_CONTEXT_MAJOR_VERSION,
                                         3,
                                         OSMESA_CONTEXT_MINOR_VERSION,
                                         3,
                                         OSMESA_DEPTH_BITS,
                                         0,
                                         OSMESA_STENCIL_BITS,
                                         0,
                                         0};
    context_.reset(OSMesaCreateContextAttribs(attributes.data(), nullptr));
    if (refused_thread_starts() > refused) {
      context_.release(); // must not wait for its threads: the program is ending
      refuse_without_thread("drawing");
    }
    if (!context_) must_have_memory();
    if (!context_)
      refuse("off-screen OpenGL 3.3 (OSMesa) did not start.",
             "rend needs Mesa's software renderer with OpenGL 3.3 core: the Debian package libosmesa6.");
    make_current();
    // A GL dispatch library loaded ahead of OSMesa swallows every call: frames would be black, without an
    // error.
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const auto* version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    if (renderer == nullptr || version == nullptr)
      refuse("OpenGL started but does not answer.",
             "Another OpenGL library (libGL, libOpenGL) is loaded ahead of libOSMesa; unset LD_PRELOAD.");
    must_have_memory();
    renderer_ = std::string(renderer) + ", " + version;
  }

  void make_current() override {
    if (!OSMesaMakeCurrent(context_.get(), buffer_.data(), GL_UNSIGNED_BYTE, 1, 1))
      refuse("off-screen OpenGL (OSMesa) cannot be used in this thread.",
             "This may be a lack of memory; a smaller picture may help.");
  }

  void release() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  const std::string& renderer() const override { return renderer_; }
  bool threads_were_refused() const override { return fewer_threads_; }

private:
  struct Destroy {
    void operator()(OSMesaContext context) const { OSMesaDestroyContext(context); }
  };
  std::array<std::uint8_t, 4>
      buffer_{}; // one RGBA pixel: OSMesa needs a buffer, although all drawing goes to framebuffer objects
  std::unique_ptr<osmesa_context, Destroy> context_;
  std::string renderer_;
  bool fewer_threads_ = false;
};

} // namespace

std::unique_ptr<Device> make_device() {
  return std::make_unique<OsMesaDevice>();
}

} // namespace rend
