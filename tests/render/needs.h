// Skips tests that need an optional part that this build lacks.
#pragma once

#include "render/files/jpeg.h"
#include "render/files/png.h"
#include "render/files/video.h"

#include <gtest/gtest.h>

// These return from the test.
#define NEEDS_PNG                                                                                              \
  if (!rend::png_available()) GTEST_SKIP() << "built without PNG"
#define NEEDS_JPEG                                                                                             \
  if (!rend::jpeg_available()) GTEST_SKIP() << "built without JPEG"
#define NEEDS_VIDEO                                                                                            \
  if (!rend::video_available()) GTEST_SKIP() << "built without video"
