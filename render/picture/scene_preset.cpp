#include "render/picture/scene_preset.h"

#include "render/picture/mask_file.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/build/read_settings.h"
#include "sim/build/rule_book.h"
#include "sim/build/scene_types.h"
#include "sim/mechanics/mass.h"

#include <algorithm>

namespace rend {
namespace {

const ElementType& camera_type() {
  static const ElementType key{"key",
                               "the position of the camera at a time; between keys it moves smoothly",
                               attributes_of<CameraKey>(),
                               {}};
  static const ElementType type{
      "camera", "position and direction of the camera", attributes_of<CameraSettings>(), {{&key, 0, -1}}};
  return type;
}

const ElementType& image_type() {
  static const ElementType key{
      "key",
      "how fast the clip plays at a time; between keys the speed changes evenly, as that "
      "of a car that brakes",
      attributes_of<SpeedKey>(),
      {}};
  static const ElementType type{
      "image", "size, rate and quality of the pictures", attributes_of<ImageSettings>(), {{&key, 0, -1}}};
  return type;
}

const ElementType& hud_type() {
  static const ElementType line{"text", "a line of text anywhere in the picture", attributes_of<HudText>(), {}};
  static const ElementType type{
      "hud", "text over the pictures", attributes_of<HudSettings>(), {{&line, 0, -1}}};
  return type;
}

const ElementType& look_type() {
  static const ElementType type{"look", "how the body is drawn", attributes_of<LookSettings>(), {}};
  return type;
}

// What the simulation reads, with what is only drawn.
const ElementType& drawn_body_type() {
  static const ElementType type = [] {
    ElementType body = body_type();
    body.children.push_back({&look_type(), 0, 1});
    return body;
  }();
  return type;
}

template <class Look> ElementType drawn(const ElementType& obstacle) {
  ElementType type = obstacle;
  for (AttributeType& attribute : attributes_of<Look>()) type.attributes.push_back(std::move(attribute));
  return type;
}

const ElementType& drawn_world_type() {
  static ElementType sphere, box, mesh; // for the world's children to point to
  static const ElementType type = [] {
    ElementType world = world_type();
    for (ChildType& child : world.children) {
      if (child.type->name == "sphere") child.type = &(sphere = drawn<SphereLook>(*child.type));
      if (child.type->name == "box") child.type = &(box = drawn<BoxLook>(*child.type));
      if (child.type->name == "obstacle") child.type = &(mesh = drawn<MeshLook>(*child.type));
    }
    return world;
  }();
  return type;
}

// Refuses names that contain a path, give a hidden file, or contain terminal control characters.
void check_name(const PresetNode& scene) {
  const std::string& name = scene.text("name");
  const char* hint = "pictures and videos get this name: use letters, digits and -";
  if (name.find_first_not_of(" \t\r\n") == std::string::npos)
    scene.fail("name", "the name of the scene is empty", hint);
  if (name.front() == '.')
    scene.fail("name", "the name of the scene begins with a dot: " + in_quotes(name), hint);
  if (name.front() == '-')
    scene.fail("name", "the name of the scene begins with a dash: " + in_quotes(name),
               "other programs would take such file names for options: put another character first");
  if (name.find_first_of("/\\") != std::string::npos || printable(name) != name)
    scene.fail("name", "the name of the scene has a character that file names cannot have: " + in_quotes(name),
               hint);
  if (name.size() > 200) scene.fail("name", "the name of the scene is too long: " + in_quotes(name), hint);
}

CameraSettings camera_settings(const PresetNode& node) {
  auto camera = read_settings<CameraSettings>(node);
  for (const PresetNode* key : node.all("key")) camera.keys.push_back(read_settings<CameraKey>(*key));
  return camera;
}

ImageSettings image_settings(const PresetNode& node) {
  auto image = read_settings<ImageSettings>(node);
  for (const PresetNode* key : node.all("key")) image.speed_keys.push_back(read_settings<SpeedKey>(*key));
  return image;
}

HudSettings hud_settings(const PresetNode& node) {
  auto hud = read_settings<HudSettings>(node);
  for (const PresetNode* text : node.all("text")) {
    colour_of(*text, "colour");
    hud.texts.push_back(read_settings<HudText>(*text));
  }
  return hud;
}

TextureFrame texture_frame(const PresetNode& body) {
  TextureFrame frame;
  if (const PresetNode* place = body.child("place")) frame.place = read_settings<Placement>(*place);
  if (const PresetNode* sheet = body.child("sheet")) frame.sheet = read_settings<SheetShape>(*sheet);
  return frame;
}

void check_look(const PresetNode& look) {
  colour_of(look, "colour");
  colour_of(look, "inside");
  if (look.given("back")) colour_of(look, "back");
  if (look.given("torn") && look.text("torn") != "none") colour_of(look, "torn");
  const auto names = finish_names();
  for (const char* attribute : {"finish", "finish-inside"}) {
    if (!look.given(attribute)) continue;
    const std::string& finish = look.text(attribute);
    if (std::find(names.begin(), names.end(), finish) == names.end())
      look.fail(attribute, "there is no finish " + in_quotes(finish), suggestion(finish, names, "there are"));
  }
}

// Colours by stress need elements, colours by force need springs, and so on.
void check_colours(const PresetNode& body, const PresetNode& look) {
  const std::string& by = look.text("by");
  const bool springs = body.child("springs"), elements = body.child("elasticity");
  const std::string name = in_quotes(body.text("name"));
  if (by == "stress" && !elements)
    look.fail("by",
              "the body " + name + " has no stress to show: " +
                  (springs ? "it is made of springs, which have no stress" : "nothing of it is elastic"),
              springs ? "springs have by=\"strain\" and by=\"force\"; elements come with <elasticity>"
                      : "give it <elasticity>");
  if ((by == "strain" || by == "force") && !springs && !elements)
    look.fail("by", "the body " + name + " has no " + by + " to show: it has neither springs nor <elasticity>",
              "give it <springs> or <elasticity>, or show by=\"fragment\" or \"plain\"");
}

// Also validates what only pictures use, so that all commands agree on whether a preset is valid.
std::unique_ptr<PresetNode> checked(std::unique_ptr<PresetNode> scene) {
  check_name(*scene);
  duration_of(*scene->child("time")); // said by all commands alike
  if (const PresetNode* image = scene->child("image")) {
    if (image->text("background") != "none") colour_of(*image, "background");
    check_image(image_settings(*image));
  }
  if (const PresetNode* hud = scene->child("hud"))
    for (const HudText& text : hud_settings(*hud).texts) check_text(text);
  for (const PresetNode* body : scene->all("body"))
    if (const PresetNode* look = body->child("look")) {
      check_look(*look);
      check_colours(*body, *look);
    }
  if (const PresetNode* world = scene->child("world"))
    for (const char* name : {"sphere", "box", "obstacle"})
      for (const PresetNode* obstacle : world->all(name)) colour_of(*obstacle, "colour");
  if (const PresetNode* camera = scene->child("camera")) check_framing(camera_settings(*camera));
  return scene;
}

} // namespace

const ElementType& scene_type() {
  static const ElementType type{
      "scene",
      "a scene: bodies, what surrounds them, and how it is shown",
      {text("name", "name of the scene; pictures, videos and output folders are named after it").is_required(),
       text("thesis", "the figure or table of the thesis that it reproduces"),
       word("version", {"1"}, "version of this format").otherwise("1")},
      {{&rules_type(), 0, -1},
       {&rule_type(), 0, -1},
       {&script_type(), 0, -1},
       {&drawn_body_type(), 1, -1},
       {&drawn_world_type(), 0, 1},
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

bool has_texture(const PresetNode& body) {
  const PresetNode* look = body.child("look");
  return look && (look->given("texture") || look->given("texture-back") || look->given("roughness"));
}

ScenePictures scene_pictures() {
  return {has_texture, read_mask};
}

PictureSettings picture_settings(const PresetNode& scene) {
  PictureSettings settings;
  if (const PresetNode* camera = scene.child("camera")) settings.camera = camera_settings(*camera);
  if (const PresetNode* image = scene.child("image")) settings.image = image_settings(*image);
  if (const PresetNode* hud = scene.child("hud")) settings.hud = hud_settings(*hud);
  for (const PresetNode* body : scene.all("body")) {
    const PresetNode* look = body->child("look");
    settings.looks.push_back(look ? read_settings<LookSettings>(*look) : LookSettings{});
    settings.looks.back().frame = texture_frame(*body);
    if (const PresetNode* mass = body->child("mass"))
      settings.looks.back().mass_thickness = read_settings<MassSettings>(*mass).thickness;
    settings.looks.back().folder = std::filesystem::path(scene.place().file).parent_path();
  }
  if (const PresetNode* world = scene.child("world")) {
    for (const PresetNode* node : world->all("sphere"))
      settings.spheres.push_back(read_settings<SphereLook>(*node));
    for (const PresetNode* node : world->all("box")) settings.boxes.push_back(read_settings<BoxLook>(*node));
    for (const PresetNode* node : world->all("obstacle"))
      settings.meshes.push_back(read_settings<MeshLook>(*node));
  }
  return settings;
}

} // namespace rend
