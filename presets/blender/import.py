"""Brings a sequence of meshes that rend exported into Blender (3.4 or later).

    rend run presets/showcase/puncture.xml --export ply -o out/puncture
    blender --background --python presets/blender/import.py -- out/puncture/puncture.scene.json \
        --save out/puncture.blend --render out/puncture.png --frame 18

In Blender's own window: open this file in the text editor, set SCENE_FILE below, and run it.

Each frame of a body is a mesh of its own, since a body that tears changes its points and faces; it is shown in
its frame alone, by keys, so that the saved file needs no script. Points carry `velocity` and `stress`, faces
`fragment`, `element` and `bare` (laid bare by fracture) as attributes. Spheres and boxes become objects with
keys, and so do the camera and a sun in the place of the key light.
"""
import argparse
import json
import pathlib
import sys

import bpy
import numpy
from mathutils import Matrix, Vector

SCENE_FILE = ""  # such as "/home/me/out/puncture/puncture.scene.json"

NUMBERS = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4",
           "float": "<f4", "double": "<f8"}


class Ply:
    """A mesh file of rend: `points` and `faces` are arrays by name, `corners` has the points of each face."""

    def __init__(self, path):
        with open(path, "rb") as file:
            counts, columns = self.header(file)
            rows = numpy.fromfile(file, numpy.dtype(columns["vertex"]), counts["vertex"])
            self.points = {name: rows[name] for name in rows.dtype.names}
            self.read_faces(file.read(), counts["face"], columns["face"])

    @staticmethod
    def header(file):
        counts, columns, element = {}, {}, None
        if file.readline() != b"ply\n":
            raise SystemExit(f"{file.name}: not a .ply file")
        for line in iter(file.readline, b"end_header\n"):
            word, *rest = line.decode().split()
            if word == "element":
                element = rest[0]
                counts[element], columns[element] = int(rest[1]), []
            elif word == "property":
                columns[element].append((rest[-1], NUMBERS[rest[-2]], *rest[1:2][:rest[0] == "list"]))
        return counts, columns

    def read_faces(self, data, count, columns):
        length = numpy.dtype(NUMBERS[columns[0][2]])
        after = numpy.dtype(columns[1:])
        self.corners, at = [], 0
        values = numpy.zeros(count, after)
        for face in range(count):
            sides = int(numpy.frombuffer(data, length, 1, at)[0])
            at += length.itemsize
            self.corners.append(numpy.frombuffer(data, "<i4", sides, at))
            at += 4 * sides
            values[face] = numpy.frombuffer(data, after, 1, at)[0]
            at += after.itemsize
        self.faces = {name: values[name] for name in after.names}


def linear(colour):
    """Of "#rrggbb", which is sRGB."""
    channels = [int(colour[n:n + 2], 16) / 255 for n in (1, 3, 5)]
    return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels] + [1.0]


def material(name, colour, back=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    made.diffuse_color = linear(colour)
    nodes, links = made.node_tree.nodes, made.node_tree.links
    surface = nodes["Principled BSDF"]
    surface.inputs["Roughness"].default_value = 0.6
    surface.inputs["Base Color"].default_value = linear(colour)
    if back and back != colour:
        mix, side = nodes.new("ShaderNodeMixRGB"), nodes.new("ShaderNodeNewGeometry")
        mix.inputs["Color1"].default_value, mix.inputs["Color2"].default_value = linear(colour), linear(back)
        links.new(side.outputs["Backfacing"], mix.inputs["Fac"])
        links.new(mix.outputs["Color"], surface.inputs["Base Color"])
    return made


def mesh_of(ply, number, name, materials):
    """Of one body. Points and faces of each stand together in the file, in the order of bodies."""
    points = numpy.flatnonzero(ply.points["body"] == number)
    faces = numpy.flatnonzero(ply.faces["body"] == number)
    first = points[0] if len(points) else 0
    mesh = bpy.data.meshes.new(name)
    place = numpy.stack([ply.points[axis][points] for axis in "xyz"], axis=1)
    mesh.from_pydata(place.tolist(), [], [(ply.corners[f] - first).tolist() for f in faces])
    for each in materials:
        mesh.materials.append(each)
    if "bare" in ply.faces and len(materials) > 1:
        mesh.polygons.foreach_set("material_index", ply.faces["bare"][faces].astype("i4"))
    velocity = numpy.stack([ply.points[axis][points] for axis in ("vx", "vy", "vz")], axis=1)
    mesh.attributes.new("velocity", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", velocity.ravel())
    if "stress" in ply.points:
        mesh.attributes.new("stress", "FLOAT", "POINT").data.foreach_set("value", ply.points["stress"][points])
    for key in ("fragment", "element", "bare"):
        if key in ply.faces:
            values = ply.faces[key][faces].astype("i4")
            mesh.attributes.new(key, "INT", "FACE").data.foreach_set("value", values)
    mesh.update()
    return mesh


def show_between(thing, first, after):
    """Only from frame `first` to the one before `after` (None: to the end)."""
    for frame, hidden in ((first - 1, True), (first, False)) + (((after, True),) if after is not None else ()):
        thing.hide_render = thing.hide_viewport = hidden
        thing.keyframe_insert("hide_render", frame=frame)
        thing.keyframe_insert("hide_viewport", frame=frame)


def add_bodies(scene, folder):
    collections, materials = [], []
    for body in scene["bodies"]:
        collections.append(bpy.data.collections.new(body["name"]))
        bpy.context.scene.collection.children.link(collections[-1])
        materials.append([material(body["name"], body["colour"], body.get("back"))])
        if body["solid"]:
            materials[-1].append(material(body["name"] + " inside", body["inside"]))
    frames = scene["frames"]
    for n, frame in enumerate(frames):
        ply = Ply(folder / frame["file"])
        after = frames[n + 1]["frame"] if n + 1 < len(frames) else None
        for number, body in enumerate(scene["bodies"]):
            name = f"{body['name']} {frame['frame']:05d}"
            thing = bpy.data.objects.new(name, mesh_of(ply, number, name, materials[number]))
            collections[number].objects.link(thing)
            show_between(thing, frame["frame"], after)


def add_obstacles(scene):
    for number, obstacle in enumerate(scene["obstacles"]):
        if obstacle["kind"] == "sphere":
            bpy.ops.mesh.primitive_uv_sphere_add(radius=obstacle["radius"], segments=64, ring_count=32)
            bpy.ops.object.shade_smooth()
        elif obstacle["kind"] == "mesh":
            mesh = bpy.data.meshes.new(obstacle["name"])
            mesh.from_pydata(obstacle["points"], [], obstacle["triangles"])
            whole = bpy.data.objects.new(obstacle["name"], mesh)
            bpy.context.collection.objects.link(whole)
            bpy.context.view_layer.objects.active = whole
        else:
            bpy.ops.mesh.primitive_cube_add(size=1)
            bpy.context.object.scale = obstacle["size"]
        thing = bpy.context.object
        thing.name = obstacle["name"]
        thing.data.materials.append(material(obstacle["name"], obstacle["colour"]))
        thing.rotation_mode = "QUATERNION"
        for frame in scene["frames"]:
            pose = frame["obstacles"][number]
            turn = Matrix([pose["turn"][row:row + 3] for row in (0, 3, 6)])
            thing.location, thing.rotation_quaternion = pose["middle"], turn.to_quaternion()
            thing.keyframe_insert("location", frame=frame["frame"])
            thing.keyframe_insert("rotation_quaternion", frame=frame["frame"])


def add_floor(scene):
    bpy.ops.mesh.primitive_plane_add(size=1000, location=(0, 0, scene["floor"]))
    bpy.context.object.name = "floor"
    bpy.context.object.data.materials.append(material("floor", scene["background"] or "#edeff3"))


def looking(eye, target, up):
    """The rotation of a camera or sun, which look along their -z with y up."""
    back = (Vector(eye) - Vector(target)).normalized()
    right = Vector(up).cross(back)
    if right.length < 1e-9:
        right = back.orthogonal()
    right.normalize()
    return Matrix((right, back.cross(right), back)).transposed().to_quaternion()


def add_camera(scene):
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    camera.rotation_mode = "QUATERNION"
    camera.data.sensor_fit = "VERTICAL"
    for frame in scene["frames"]:
        at = frame["camera"]
        camera.location = at["eye"]
        camera.rotation_quaternion = looking(at["eye"], at["target"], at["up"])
        camera.data.angle_y = numpy.radians(at["fov"])
        distance = (Vector(at["eye"]) - Vector(at["target"])).length
        camera.data.clip_start, camera.data.clip_end = distance / 1000, distance * 1000
        camera.keyframe_insert("location", frame=frame["frame"])
        camera.keyframe_insert("rotation_quaternion", frame=frame["frame"])
        camera.data.keyframe_insert("lens", frame=frame["frame"])


def add_light(scene):
    sun = bpy.data.objects.new("key light", bpy.data.lights.new("key light", "SUN"))
    bpy.context.scene.collection.objects.link(sun)
    sun.data.energy, sun.data.angle = 2.2, numpy.radians(8)
    sun.rotation_mode = "QUATERNION"
    for frame in scene["frames"]:
        sun.rotation_quaternion = looking(frame["light"], (0, 0, 0), (0, 0, 1))
        sun.keyframe_insert("rotation_quaternion", frame=frame["frame"])
    world = bpy.context.scene.world or bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = linear(scene["background"] or "#edeff3")
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.5


def interpolate_linearly():
    for action in bpy.data.actions:
        for curve in action.fcurves:
            for key in curve.keyframe_points:
                key.interpolation = "CONSTANT" if curve.data_path.startswith("hide") else "LINEAR"


def build(path):
    path = pathlib.Path(path)
    scene = json.loads(path.read_text(encoding="utf-8"))
    if scene["format"] != "ply":
        raise SystemExit(f"{path}: its meshes are .{scene['format']}; export them with rend run --export ply")
    bpy.ops.wm.read_homefile(use_empty=True)
    settings = bpy.context.scene
    settings.frame_start, settings.frame_end = scene["frames"][0]["frame"], scene["frames"][-1]["frame"]
    settings.render.fps = max(1, int(scene["fps"]))
    settings.render.fps_base = settings.render.fps / scene["fps"]
    settings.render.resolution_x, settings.render.resolution_y = scene["size"]
    settings.render.film_transparent = scene["background"] is None
    settings.view_settings.view_transform = "Standard"
    add_bodies(scene, path.parent)
    add_obstacles(scene)
    if scene["floor"] is not None and scene["background"] is not None:
        add_floor(scene)
    add_camera(scene)
    add_light(scene)
    interpolate_linearly()
    settings.frame_set(settings.frame_start)


def render(path, frame, width, samples):
    settings = bpy.context.scene
    settings.frame_set(frame if frame is not None else settings.frame_start)
    settings.render.engine = "CYCLES"  # needs neither a display nor a graphics card
    settings.cycles.samples = samples
    settings.cycles.use_denoising = False
    if width:
        settings.render.resolution_percentage = round(100 * width / settings.render.resolution_x)
    settings.render.image_settings.file_format = "PNG"
    settings.render.image_settings.color_mode = "RGBA" if settings.render.film_transparent else "RGB"
    settings.render.filepath = str(pathlib.Path(path).absolute())
    bpy.ops.render.render(write_still=True)


def main():
    own = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="import.py", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("scene", nargs="?" if SCENE_FILE else None, default=SCENE_FILE,
                        help="the file SCENE.scene.json that lies beside the meshes")
    parser.add_argument("--save", metavar="FILE.blend", help="save the Blender file")
    parser.add_argument("--render", metavar="FILE.png", help="render one frame with Cycles")
    parser.add_argument("--frame", type=int, help="which; default: the first")
    parser.add_argument("--width", type=int, help="of the picture; default: as in the preset")
    parser.add_argument("--samples", type=int, default=64, help="a pixel")
    options = parser.parse_args(own)
    build(options.scene)
    if options.save:
        bpy.ops.wm.save_as_mainfile(filepath=str(pathlib.Path(options.save).absolute()), compress=True)
    if options.render:
        render(options.render, options.frame, options.width, options.samples)


if __name__ == "__main__":
    main()
