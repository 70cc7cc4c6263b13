// A concurrent pipeline from frames to files:
//
//   push ─▶ [3 frames] ─▶ draw ─┬▶ [3 pictures] ─▶ PNG writers   folder/00000.png ...
//          the simulation       └▶ [3 pictures] ─▶ video         folder/name.mp4
//
// One thread owns the Device and draws; others encode. The queues are short, so push() blocks when drawing
// falls behind. The first error of any thread stops all of them and is rethrown by the next push() or by
// finish(). If the second PNG writer thread cannot be started, there is only one.
#pragma once

#include "render/draw/frame.h"
#include "render/files/png.h"

#include <filesystem>
#include <memory>
#include <string>

namespace rend {

struct PipelineOptions {
  std::filesystem::path folder; // created if it does not exist
  std::string name;             // of the video: folder/name.extension
  int width = 1280, height = 720;
  int samples = 4; // 1 or 4
  double fps = 30; // of the video
  bool png = true;
  bool video = false;
  bool transparent = false;       // frames are; the video, whose format must have it, too
  std::string extension = ".mp4"; // of the video; see video_format.h
  int png_writers = 2;            // 1 or 2 threads: one writes while the other waits for the disk
  std::string mark; // written into each PNG as text chunk "rend:scene", before its number; empty: none
};

// The file name of frame `number`, and the text that marks it (PipelineOptions::mark).
std::string png_name(long number);
PngText png_mark(const std::string& mark, long number);

// Seconds that each stage was busy (not waiting), summed over all pictures so far.
struct PipelineSeconds {
  double draw = 0, png = 0, video = 0; // png: summed over its writers
  double draw_waits = 0;               // time that drawing was blocked by full queues
};

// Tests whether a Pipeline can start on this machine, before hours of simulation: the encoder exists, and
// OpenGL can allocate large pictures. Throws what Pipeline would; writes no file. As make_device(), it must not
// be called while other threads read the environment.
void check_pipeline(const PipelineOptions& options);

class Pipeline {
public:
  // Starts OpenGL, creates the folder and opens the video. Throws UserError (CannotCreate, Usage; OutOfBudget
  // for lack of memory or threads) before the first frame.
  explicit Pipeline(const PipelineOptions& options);
  // Without finish() (after an exception): frames already written stay, an unfinished video is removed.
  ~Pipeline();
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  // Numbers must increase; frame 7 is written to 00007.png. Rethrows errors of the stages.
  void push(Frame&& frame);
  // Waits until every pushed frame is drawn, and written as PNG. Rethrows errors of the stages.
  void drain();
  // Waits until everything is written. A whole video is renamed; one that is cut short plays, and stays
  // partial_video() of its name. Rethrows errors of the stages.
  enum class End { Whole, CutShort };
  void finish(End end = End::Whole);

  PipelineSeconds seconds() const;
  bool threads_were_refused() const; // the system refused to start as many threads as were wanted

private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

} // namespace rend
