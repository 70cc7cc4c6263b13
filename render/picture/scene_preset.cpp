#include "render/picture/scene_preset.h"

#include "render/draw/finish.h"
#include "render/picture/colour.h"
#include "render/picture/hud_writer.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/build/scene_types.h"

#include <algorithm>

namespace rend {
namespace {

const ElementType& key_type() {
  static const ElementType type{"key",
                                "where the camera is at a time; between keys it moves smoothly",
                                {number("at", "s", "when").at_least(0).is_required(),
                                 numbers("eye", 3, "m", "where the camera stands").is_required(),
                                 numbers("target", 3, "m", "what it looks at; default: the camera's"),
                                 number("fov", "degrees", "default: the camera's").at_least(1).at_most(170)},
                                {}};
  return type;
}

const ElementType& camera_type() {
  static const ElementType type{
      "camera",
      "where the picture is taken from",
      {numbers("eye", 3, "m", "where the camera stands"),
       numbers("target", 3, "m", "what it looks at; default: the middle of the bodies at the start"),
       numbers("up", 3, "", "what is up in the picture").otherwise("0 0 1"),
       number("fov", "degrees", "the angle from bottom to top of the picture")
           .at_least(1)
           .at_most(170)
           .otherwise("35"),
       number("turn", "degrees", "how far it goes around the target over the clip").otherwise("0"),
       word("frame", {"auto", "given", "follow"},
            "auto: as near as the bodies allow, seen from the direction of the eye; default where there is no "
            "eye; follow: after the bodies, never losing one out of sight")},
      {{&key_type(), 0, -1}}};
  return type;
}

const ElementType& image_type() {
  static const ElementType type{
      "image",
      "the pictures",
      {integers("size", 2, "width and height in pixels").at_least(16).at_most(8192).otherwise("1280 720"),
       number("fps", "1/s", "pictures a second of simulated time").above(0).at_most(1e6).otherwise("30"),
       word("samples", {"1", "4", "16"},
            "samples a pixel: 4 smooths edges; 16 fine lines and gloss too, and takes "
            "four times as long")
           .otherwise("4"),
       text("background", "#rrggbb, or none: transparent, without floor").otherwise("#edeff3"),
       flag("occlusion", "what stands near a place keeps light from it: darker folds, cracks and gaps; a fifth "
                         "of the time of a picture")
           .otherwise("no")},
      {}};
  return type;
}

// A name that is a path, hides its file, or acts on the terminal that lists it, would surprise.
void check_name(const PresetNode& scene) {
  const std::string& name = scene.text("name");
  const char* hint = "pictures and videos are called by it: letters, digits and - do";
  if (name.find_first_not_of(" \t\r\n") == std::string::npos)
    scene.fail("name", "the name of the scene is empty", hint);
  if (name.front() == '.')
    scene.fail("name", "the name of the scene begins with a dot: " + in_quotes(name), hint);
  if (name.front() == '-')
    scene.fail("name", "the name of the scene begins with a dash: " + in_quotes(name),
               "other programs would take its files for options");
  if (name.find_first_of("/\\") != std::string::npos || printable(name) != name)
    scene.fail("name", "the name of the scene holds what no file name may: " + in_quotes(name), hint);
  if (name.size() > 200) scene.fail("name", "the name of the scene is too long: " + in_quotes(name), hint);
}

void check_camera(const PresetNode& camera) {
  if (camera.vector("up").norm() == 0)
    camera.fail("up", "the camera's up has no direction", "up=\"0 0 1\" is usual");
  const bool eye = camera.given("eye"), target = camera.given("target");
  if (!camera.all("key").empty() && camera.has("frame") && camera.text("frame") != "given")
    camera.fail("frame", "a camera with keys goes where they say", "leave frame out, or the keys");
  if (!eye && camera.has("frame") && camera.text("frame") == "given")
    camera.fail("frame", "a given frame needs an eye", "eye=\"0 -3 1\", or frame=\"auto\"");
  if (eye && target && camera.vector("eye") == camera.vector("target"))
    camera.fail("eye", "the camera's eye stands at its target", "move it away from there");
}

void check_look(const PresetNode& look) {
  colour_of(look, "colour");
  colour_of(look, "inside");
  if (look.given("back")) colour_of(look, "back");
  const std::string& finish = look.text("finish");
  const auto names = finish_names();
  if (std::find(names.begin(), names.end(), finish) == names.end())
    look.fail("finish", "there is no finish " + in_quotes(finish), suggestion(finish, names, "there are"));
}

// Colours show what elements or springs know.
void check_colours(const PresetNode& body, const PresetNode& look) {
  const std::string& by = look.text("by");
  const bool springs = body.child("springs"), elements = body.child("elasticity");
  const std::string name = in_quotes(body.text("name"));
  if (by == "stress" && !elements)
    look.fail("by",
              "the body " + name + " has no stress to be shown: " +
                  (springs ? "it is made of springs, and has no elements that know theirs"
                           : "nothing of it is elastic"),
              springs ? "springs have by=\"strain\" and by=\"force\"; elements come with <elasticity>"
                      : "give it <elasticity>");
  if ((by == "strain" || by == "force") && !springs && !elements)
    look.fail("by", "the body " + name + " has no " + by + " to be shown: nothing of it is elastic",
              "give it <springs> or <elasticity>, or show by=\"fragment\" or \"plain\"");
}

// What only pictures need is looked at as well, so that a preset is good or bad for all commands alike.
std::unique_ptr<PresetNode> checked(std::unique_ptr<PresetNode> scene) {
  check_name(*scene);
  duration_of(*scene->child("time")); // said by all commands alike
  image_settings(*scene);             // its colour
  for (const PresetNode* body : scene->all("body"))
    if (const PresetNode* look = body->child("look")) {
      check_look(*look);
      check_colours(*body, *look);
    }
  if (const PresetNode* world = scene->child("world"))
    for (const char* name : {"sphere", "box"})
      for (const PresetNode* obstacle : world->all(name)) colour_of(*obstacle, "colour");
  if (const PresetNode* camera = scene->child("camera")) check_camera(*camera);
  return scene;
}

} // namespace

const ElementType& scene_type() {
  static const ElementType type{"scene",
                                "a scene: bodies, what surrounds them, and how it is shown",
                                {text("name", "of its pictures").is_required(),
                                 text("thesis", "the figure or table of the thesis that it reproduces"),
                                 word("version", {"1"}, "of this format").otherwise("1")},
                                {{&body_type(), 1, -1},
                                 {&world_type(), 0, 1},
                                 {&time_type(), 1, 1},
                                 {&camera_type(), 0, 1},
                                 {&image_type(), 0, 1},
                                 {&hud_type(), 0, 1}}};
  return type;
}

std::unique_ptr<PresetNode> load_scene(const std::filesystem::path& path, std::span<const Override> overrides) {
  return checked(read_preset(path, scene_type(), overrides));
}

std::unique_ptr<PresetNode> load_scene_text(std::string_view text, const std::string& file,
                                            std::span<const Override> overrides) {
  return checked(read_preset_text(text, file, scene_type(), overrides));
}

ImageSettings image_settings(const PresetNode& scene) {
  PresetNode silent(image_type(), scene.place());
  silent.fill_defaults();
  const PresetNode* given = scene.child("image");
  const PresetNode& image = given ? *given : silent;
  ImageSettings settings;
  settings.width = static_cast<int>(image.integers("size")[0]);
  settings.height = static_cast<int>(image.integers("size")[1]);
  settings.fps = image.number("fps");
  settings.samples = std::stoi(image.text("samples"));
  settings.transparent = image.text("background") == "none";
  settings.occlusion = image.flag("occlusion");
  if (!settings.transparent) settings.background = colour_of(image, "background");
  return settings;
}

} // namespace rend
