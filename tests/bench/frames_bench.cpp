// Throughput of the pipeline, from a Frame to PNG files and an .mp4 at once, and the time of each stage.
//
// A waving cloth of 5,000 or 200,000 triangles, so that no two frames are equal, framed as rend frames bodies:
// 1280 x 720, four samples, shadow map, floor, HUD. Frames are made beforehand: only what follows the
// simulation is measured. Stages are measured by processor time of all threads, which other programs on the
// machine disturb little.
#include "render/draw/camera.h"
#include "render/draw/device.h"
#include "render/draw/hud.h"
#include "render/draw/renderer.h"
#include "render/files/png.h"
#include "render/files/video.h"
#include "render/pipeline/pipeline.h"
#include "tests/render/pictures.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <map>

namespace rend {
namespace {

constexpr int width = 1280, height = 720;
constexpr int phases = 16; // frames of one period

void in_processor_time(benchmark::internal::Benchmark* bench) {
  bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}
void small(benchmark::internal::Benchmark* bench) { // cloth
  bench->Arg(5'000)->Apply(in_processor_time);
}
void small_and_large(benchmark::internal::Benchmark* bench) {
  bench->Arg(5'000)->Arg(200'000)->Apply(in_processor_time);
}

HudContent figures(int number) {
  HudContent hud;
  hud.title = "waving cloth";
  hud.figures = {fmt::format("{:.3f} s", number / 30.0), "12 tears"};
  HudPlot plot;
  plot.title = "energy";
  plot.frames = 120;
  plot.high = 1;
  plot.curves = {{"kinetic", {0, 114, 178}, {}}, {"elastic", {213, 94, 0}, {}}};
  for (int n = 0; n <= number % 120; ++n)
    for (HudCurve& curve : plot.curves)
      curve.values.push_back(0.5f + 0.4f * std::sin(0.1f * static_cast<float>(n)));
  hud.plots.push_back(plot);
  HudLegend legend{"largest strain", "0", "0.2", {}};
  for (int n = 0; n < 64; ++n) legend.colours.push_back({static_cast<std::uint8_t>(4 * n), 80, 120});
  hud.legends.push_back(legend);
  return hud;
}

// A unit square of `across` x `along` cells with two triangles each.
FrameBody cloth(int across, int along, double phase) {
  const auto vertex = [&](int i, int j, Corner& corner) {
    const double x = 2.0 * i / across - 1, y = 2.0 * j / along - 1;
    const double z = 0.12 * std::sin(4 * x + phase) + 0.08 * std::cos(5 * y - x + phase);
    const double dx = 0.48 * std::cos(4 * x + phase) + 0.08 * std::sin(5 * y - x + phase);
    const double dy = -0.4 * std::sin(5 * y - x + phase);
    corner.position = as_floats({x, y, 0.7 + z - 0.25 * y});
    corner.normal = as_floats(Eigen::Vector3d(-dx, -dy + 0.25, 1).normalized());
    corner.colour = {40, static_cast<std::uint8_t>(110 + 60 * x), 140, 255};
  };
  FrameBody body;
  constexpr auto cell = static_cast<std::uint8_t>(Line::Cell);
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < along; ++j)
      for (const bool upper : {false, true}) {
        Corner corners[3] = {};
        vertex(i + (upper ? 1 : 0), j + (upper ? 1 : 0), corners[0]);
        vertex(i + (upper ? 0 : 1), j + (upper ? 1 : 0), corners[1]);
        vertex(i + (upper ? 0 : 1), j + (upper ? 0 : 1), corners[2]);
        if (upper) vertex(i, j, corners[2]);
        for (Corner& corner : corners) corner.line = {0, cell, cell, 0};
        body.corners.insert(body.corners.end(), std::begin(corners), std::end(corners));
      }
  return body;
}

const std::vector<Frame>& frames(int triangles) {
  static std::map<int, std::vector<Frame>> all;
  std::vector<Frame>& out = all[triangles];
  if (!out.empty()) return out;
  const int across = triangles == 200'000 ? 250 : 50, along = triangles / 2 / across;
  for (int number = 0; number < phases; ++number) {
    Frame frame;
    const Eigen::AlignedBox3d room(Eigen::Vector3d(-1, -1, 0.25), Eigen::Vector3d(1, 1, 1.15));
    frame.camera = fit_camera(room, 35, static_cast<double>(width) / height, {0.6, -2.4, 2.5});
    frame.floor = FrameFloor{0};
    frame.bodies.push_back(cloth(across, along, 2 * M_PI * number / phases));
    frame.hud = figures(number);
    out.push_back(std::move(frame));
  }
  return out;
}

Frame numbered(const std::vector<Frame>& clip, int number, bool occlusion) {
  Frame frame = clip[static_cast<std::size_t>(number % phases)];
  frame.number = number;
  frame.occlusion = occlusion;
  return frame;
}

void count(benchmark::State& state, long frames) {
  state.counters["frames_per_second"] =
      benchmark::Counter(static_cast<double>(frames * state.iterations()), benchmark::Counter::kIsRate);
}

// Shares of the wall-clock time that each stage was busy; draw_waits: that drawing was blocked by the stages
// behind it.
void tell_stages(benchmark::State& state, const PipelineSeconds& now, const PipelineSeconds& before,
                 double seconds) {
  state.counters["draw"] = (now.draw - before.draw) / seconds;
  state.counters["png"] = (now.png - before.png) / seconds;
  state.counters["video"] = (now.video - before.video) / seconds;
  state.counters["draw_waits"] = (now.draw_waits - before.draw_waits) / seconds;
}

// The whole pipeline at full speed, after a first frame, for which OpenGL compiles shaders (half a second of
// one thread; tests/bench/first-frame).
void overlapped(benchmark::State& state, int triangles, bool occlusion) {
  const auto& clip = frames(triangles);
  const int frames_each = triangles > 10'000 ? 24 : 120;
  for (auto _ : state) {
    state.PauseTiming();
    const test::Folder folder;
    PipelineOptions options;
    options.folder = folder.path();
    options.name = "clip";
    options.video = true;
    Pipeline files(options);
    files.push(numbered(clip, 0, occlusion));
    files.drain();
    const PipelineSeconds before = files.seconds();
    state.ResumeTiming();
    const auto start = std::chrono::steady_clock::now();
    for (int number = 1; number <= frames_each; ++number) files.push(numbered(clip, number, occlusion));
    files.finish();
    tell_stages(state, files.seconds(), before,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  count(state, frames_each);
}

// The same stages one after another, in one thread except for those that OpenGL and the encoder start
// themselves.
void in_a_row(benchmark::State& state, int triangles) {
  const auto& clip = frames(triangles);
  constexpr int frames_each = 120;
  for (auto _ : state) {
    state.PauseTiming();
    const test::Folder folder;
    const std::unique_ptr<Device> device = make_device();
    Renderer renderer(width, height, 4);
    Hud hud(width, height);
    VideoWriter video;
    video.open(folder / "clip.mp4", width, height, 30);
    const auto make = [&](int number) {
      const Frame frame = numbered(clip, number, false);
      renderer.draw(frame);
      hud.draw(frame.hud);
      const Image image = renderer.read();
      write_png(folder / png_name(number), image);
      video.add(image);
    };
    make(0);
    state.ResumeTiming();
    for (int number = 1; number <= frames_each; ++number) make(number);
    video.close();
  }
  count(state, frames_each);
}

void whole_way(benchmark::internal::Benchmark* bench) {
  bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}
BENCHMARK_CAPTURE(overlapped, frames, 5'000, false)->Name("figure/frame_5000")->Apply(whole_way);
BENCHMARK_CAPTURE(in_a_row, frames, 5'000)->Name("figure/frame_5000_serial")->Apply(whole_way);
BENCHMARK_CAPTURE(overlapped, occluded, 5'000, true)->Name("figure/frame_5000_occlusion")->Apply(whole_way);
BENCHMARK_CAPTURE(overlapped, many, 200'000, false)->Name("figure/frame_200000")->Apply(whole_way);

// Draws these frames over and over.
void measure(benchmark::State& state, Renderer& renderer, const std::vector<Frame>& clip) {
  renderer.draw(clip.front()); // compiles the shaders
  renderer.read();
  std::size_t number = 0;
  for (auto _ : state) {
    renderer.draw(clip[number++ % phases]);
    benchmark::DoNotOptimize(renderer.read());
  }
}

// Much detail, as a photograph has it, 1024 pixels a side.
Image detailed(unsigned seed) {
  Image image(1024, 1024);
  unsigned state = seed;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        state = state * 1664525U + 1013904223U;
        image.row(y)[3 * x + c] =
            static_cast<std::uint8_t>(128 + 80 * std::sin(0.02 * x + c) * std::cos(0.03 * y) + (state >> 28));
      }
  return image;
}

// Drawing only: the cloth with so many pictures on it: on its front, on its back as well, and of its roughness.
void draw_with_maps(benchmark::State& state) {
  const std::unique_ptr<Device> device = make_device();
  Renderer renderer(width, height, 4);
  const auto maps = state.range(0);
  FrameTexture texture;
  if (maps > 0) texture.front = make_texture(detailed(1));
  if (maps > 1) texture.back = make_texture(detailed(2));
  if (maps > 2) texture.roughness = make_number_texture(detailed(3));
  std::vector<Frame> clip = frames(5'000);
  for (Frame& frame : clip) {
    FrameBody& body = frame.bodies.front();
    body.texture = texture;
    for (const Corner& corner : body.corners)
      if (texture.any())
        body.texture_points.push_back({corner.position[0] / 2 + 0.5f, corner.position[1] / 2 + 0.5f});
  }
  measure(state, renderer, clip);
}
BENCHMARK(draw_with_maps)->DenseRange(0, 3)->Apply(in_processor_time);

// Drawing only, with the named feature removed, or occlusion added.
void draw(benchmark::State& state, const std::string& without) {
  const std::unique_ptr<Device> device = make_device();
  Renderer renderer(width, height, without == "samples" ? 1 : 4);
  std::vector<Frame> clip = frames(static_cast<int>(state.range(0)));
  for (Frame& frame : clip) {
    if (without == "floor") frame.floor.reset();
    if (without == "bodies") frame.bodies.clear();
    frame.occlusion = without == "nothing";
  }
  measure(state, renderer, clip);
}
BENCHMARK_CAPTURE(draw, all, "")->Apply(small_and_large);
BENCHMARK_CAPTURE(draw, with_occlusion, "nothing")->Apply(small);
BENCHMARK_CAPTURE(draw, without_floor, "floor")->Apply(small_and_large);
BENCHMARK_CAPTURE(draw, without_samples, "samples")->Apply(small_and_large);
BENCHMARK_CAPTURE(draw, without_bodies, "bodies")->Apply(small);

void hud(benchmark::State& state) {
  const std::unique_ptr<Device> device = make_device();
  Renderer renderer(width, height, 4);
  renderer.draw(frames(5'000).front());
  Hud hud(width, height);
  int number = 0;
  for (auto _ : state) {
    hud.draw(figures(number++));
    benchmark::DoNotOptimize(renderer.read());
  }
}
BENCHMARK(hud)->Apply(in_processor_time);

std::vector<Image> pictures() {
  const std::unique_ptr<Device> device = make_device();
  Renderer renderer(width, height, 4);
  Hud hud(width, height);
  std::vector<Image> out;
  for (const Frame& frame : frames(5'000)) {
    renderer.draw(frame);
    hud.draw(frame.hud);
    out.push_back(renderer.read());
  }
  return out;
}

void png(benchmark::State& state) {
  const std::vector<Image> clip = pictures();
  std::size_t number = 0, bytes = 0;
  for (auto _ : state) bytes += encode_png(clip[number++ % phases]).size();
  state.counters["bytes"] = static_cast<double>(bytes) / static_cast<double>(number);
}
BENCHMARK(png)->Apply(in_processor_time);

void video(benchmark::State& state) {
  const std::vector<Image> clip = pictures();
  const test::Folder folder;
  VideoWriter writer;
  writer.open(folder / "clip.mp4", width, height, 30);
  std::size_t number = 0;
  for (auto _ : state) writer.add(clip[number++ % phases]);
  writer.close();
}
BENCHMARK(video)->Apply(in_processor_time);

} // namespace
} // namespace rend
