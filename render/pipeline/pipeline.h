// Frames in, files out, with the stages overlapped:
//
//   push ─▶ [3 frames] ─▶ draw ─┬▶ [3 pictures] ─▶ PNG writers   folder/00000.png ...
//          the simulation       └▶ [3 pictures] ─▶ video         folder/name.mp4
//
// One thread owns the Device and draws; others encode. The queues are short, so push() waits when drawing falls
// behind. The first error of any thread stops them all and is thrown by the next push() or by finish(). Where
// the system starts only one writer of PNG files there is one.
#pragma once

#include "render/draw/frame.h"
#include "render/files/png.h"

#include <filesystem>
#include <memory>
#include <string>

namespace rend {

struct PipelineOptions {
  std::filesystem::path folder; // made if it is not there
  std::string name;             // of the video: folder/name.extension
  int width = 1280, height = 720;
  int samples = 4; // 1 or 4
  double fps = 30; // of the video
  bool png = true;
  bool video = false;
  std::string extension = ".mp4"; // of the video; see video_format.h
  int png_writers = 2;            // 1 or 2 threads: one writes while the other waits for the disk
  std::string mark;               // in each PNG, under "rend:scene", before its number; empty: none
};

// How frame `number` is called, and what it is marked with (PipelineOptions::mark).
std::string png_name(long number);
PngText png_mark(const std::string& mark, long number);

// Seconds that each stage was at work (not waiting), over all pictures so far.
struct PipelineSeconds {
  double draw = 0, png = 0, video = 0; // png: the sum of its writers
  double draw_waits = 0;               // that drawing waited for room before the writers
};

// Whether a Pipeline could start on this machine, before hours of simulation lead up to its first frame: the
// encoder is there, and OpenGL can hold a picture that is large. Throws what Pipeline would; writes nothing. As
// make_device() it is not to be called while other threads read the environment.
void check_pipeline(const PipelineOptions& options);

class Pipeline {
public:
  // Starts OpenGL, makes the folder and opens the video: throws UserError (CannotCreate, Usage; OutOfBudget for
  // want of memory or threads) before any frame.
  explicit Pipeline(const PipelineOptions& options);
  // Without finish() (an exception is on its way): frames already written stay, an unfinished video is removed.
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  // Frames come with growing numbers; frame 7 is written to 00007.png. Throws what a stage has thrown.
  void push(Frame&& frame);
  // Waits until all that was pushed is drawn, and written as PNG. Throws what a stage has thrown.
  void drain();
  // Waits until all is written and the video has its name. Throws what a stage has thrown.
  void finish();

  PipelineSeconds seconds() const;
  bool has_fewer_threads() const; // than it was to have: the system starts no more

private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

} // namespace rend
