// An off-screen OpenGL 3.3 core context.
//
// OSMesa will be removed from Mesa; then another Device (EGL without a surface) can replace it, and only
// device.cpp changes. A Device owns one context. A context is current in one thread at a time: a thread calls
// make_current() before it draws, and release() before another thread takes over.
#pragma once

#include <memory>
#include <string>

namespace rend {

class Device {
public:
  virtual ~Device() = default;
  virtual void make_current() = 0;                 // in the calling thread
  virtual void release() = 0;                      // the calling thread no longer draws
  virtual const std::string& renderer() const = 0; // "llvmpipe (LLVM 15.0.6, 256 bits), 4.5 ..."
  // the system refused to start as many threads as llvmpipe wanted
  virtual bool threads_were_refused() const = 0;
};

// Creates an off-screen context, current in the calling thread. Throws UserError: CannotCreate where the
// machine cannot, OutOfBudget for lack of memory or threads. Sets LP_NATIVE_VECTOR_WIDTH,
// MESA_SHADER_CACHE_DISABLE and, to reduce the number of threads, LP_NUM_THREADS in the environment: call it
// while no other thread reads the environment.
std::unique_ptr<Device> make_device();

} // namespace rend
