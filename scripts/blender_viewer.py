"""Runs in Blender (scripts/blender_viewer) and writes pictures of a glTF file or of a lat-long sky.

  JOB.json, like a job of scripts/three_viewer; files in it are relative to its folder, directions and positions in the axes
  of glTF:
  {"model": "model.glb",
   "sky": "lat_long.exr",
   "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "up": [0, 1, 0], "fov_deg": 40},   vertical field of view
   "size": [512, 512],
   "outputs": [{"what": "normals", "file": "n.f32"},     world-space shading normals at the centres of pixels
               {"what": "sky", "file": "s.f32"}]}        the sky alone; "camera" here replaces that of the job

.f32: R, G, B, A as 32-bit floats, low byte first, rows from the top down; A is 1 on the model, and in pictures of the sky.
"""
import array
import json
import math
import os
import sys

import bpy
from mathutils import Matrix, Vector


def import_model(file):
    """Blender's importer needs numpy, and that of Blender 3.4 a name which numpy has not had since 1.24."""
    try:
        import numpy
    except ImportError:
        sys.exit(3)
    if "bool" not in vars(numpy):
        numpy.bool = bool
    bpy.ops.import_scene.gltf(filepath=file)


def to_blender(v):
    """From the axes of glTF; Blender's importer does the same."""
    return Vector((v[0], -v[2], v[1]))


def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples = "CPU", 1
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    # The sample is at the centre of the pixel.
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 0.01
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGBA"
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    return scene


def add_camera(scene, entry, size):
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle = math.radians(entry.get("fov_deg", 40))
    data.clip_start, data.clip_end = 1e-4, 1e4
    position = to_blender(entry["position"])
    backward = (position - to_blender(entry["target"])).normalized()
    right = to_blender(entry.get("up", [0, 1, 0])).cross(backward).normalized()
    turn = Matrix((right, backward.cross(right), backward)).transposed()
    camera = bpy.data.objects.new("camera", data)
    camera.matrix_world = Matrix.Translation(position) @ turn.to_4x4()
    scene.collection.objects.link(camera)
    scene.camera = camera


def show_normals(material):
    """The normal with which the material is shaded, as (n + 1) / 2, instead of its light."""
    tree = material.node_tree
    shader = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
    links = shader.inputs["Normal"].links
    normal = links[0].from_socket if links else tree.nodes.new("ShaderNodeNewGeometry").outputs["Normal"]
    scaled = tree.nodes.new("ShaderNodeVectorMath")
    scaled.operation = "MULTIPLY_ADD"
    scaled.inputs[1].default_value = scaled.inputs[2].default_value = (0.5, 0.5, 0.5)
    emission = tree.nodes.new("ShaderNodeEmission")
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    tree.links.new(normal, scaled.inputs[0])
    tree.links.new(scaled.outputs[0], emission.inputs["Color"])
    tree.links.new(emission.outputs[0], output.inputs["Surface"])


def load_sky(scene, file):
    tree = scene.world.node_tree
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(file)
    tree.links.new(picture.outputs["Color"], tree.nodes["Background"].inputs["Color"])


def rendered(scene, temporary):
    """RGBA, rows from the top down."""
    scene.render.filepath = temporary
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(temporary)
    width, height = image.size
    pixels = array.array("f", bytes(16 * width * height))
    image.pixels.foreach_get(pixels)
    os.remove(temporary)
    out = array.array("f")
    for y in reversed(range(height)):
        out += pixels[4 * width * y:4 * width * (y + 1)]
    return out


def normals_of(pixels):
    """From colours (n + 1) / 2 in Blender's axes to normals in those of glTF."""
    for i in range(0, len(pixels), 4):
        x, y, z = (2 * c - 1 for c in pixels[i:i + 3])
        pixels[i:i + 3] = array.array("f", (x, z, -y) if pixels[i + 3] == 1 else (0, 0, 0))
    return pixels


def main(job_file):
    folder = os.path.dirname(os.path.abspath(job_file))
    with open(job_file) as text:
        job = json.load(text)
    for output in job["outputs"]:
        scene = empty_scene()
        add_camera(scene, output.get("camera", job.get("camera")), job["size"])
        file = os.path.join(folder, output["file"])
        if output["what"] == "normals":
            scene.render.film_transparent = True
            import_model(os.path.join(folder, output.get("model", job.get("model"))))
            for material in bpy.data.materials:
                if material.use_nodes:
                    show_normals(material)
        else:
            load_sky(scene, os.path.join(folder, output.get("sky", job.get("sky"))))
        pixels = rendered(scene, file + ".exr")
        with open(file, "wb") as out:
            (normals_of(pixels) if output["what"] == "normals" else pixels).tofile(out)


main(sys.argv[sys.argv.index("--") + 1])
