// A place where OpenGL 3.3 core runs, off-screen.
//
// OSMesa is leaving Mesa; the day it is gone another Device (EGL without a surface) takes its place, and only
// device.cpp changes. A Device owns one context. A context is current in one thread at a time: whoever draws
// calls make_current() first, and release() before another thread takes over.
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
  virtual bool has_fewer_threads() const = 0;      // than it was to draw with: the system starts no more
};

// Starts off-screen OpenGL; the context is current in the calling thread. Throws UserError: CannotCreate where
// the machine cannot, OutOfBudget for want of memory or threads. Sets LP_NATIVE_VECTOR_WIDTH,
// MESA_SHADER_CACHE_DISABLE and, where it may have fewer threads, LP_NUM_THREADS in the environment: call it
// while no other thread reads that.
std::unique_ptr<Device> make_device();

} // namespace rend
