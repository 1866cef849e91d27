"""Blender's side of scripts/bench: blender -b --factory-startup -P scripts/bench_blender.py -- import MESH.obj
or -- bump MESH.obj HEIGHT.exr AMPLITUDE SIZE OUT.exr. Prints seconds of the operator alone: no start, no textures read."""
import sys
import time
import bpy

job, *args = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)


def imported(path):
    begin = time.perf_counter()
    bpy.ops.wm.obj_import(filepath=path, forward_axis="Y", up_axis="Z")
    return time.perf_counter() - begin, bpy.context.selected_objects[0]


def bump(mesh, height, amplitude, size, out):
    """The Bump node on the height as a texture, one sample a texel, baked to a tangent-space normal map."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 1
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    item = imported(mesh)[1]
    item.data.polygons.foreach_set("use_smooth", [True] * len(item.data.polygons))
    material = bpy.data.materials.new("relief")
    material.use_nodes = True
    item.data.materials.clear()
    item.data.materials.append(material)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = bpy.data.images.load(height)
    texture.image.colorspace_settings.name = "Non-Color"
    texture.interpolation = "Cubic"
    node = nodes.new("ShaderNodeBump")
    node.inputs["Strength"].default_value = 1
    node.inputs["Distance"].default_value = float(amplitude)
    links.new(texture.outputs["Color"], node.inputs["Height"])
    links.new(node.outputs["Normal"], nodes["Principled BSDF"].inputs["Normal"])
    image = bpy.data.images.new("map", int(size), int(size), float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    target = nodes.new("ShaderNodeTexImage")
    target.image = image
    nodes.active = target
    bpy.context.view_layer.objects.active = item
    item.select_set(True)
    bpy.ops.object.bake(type="NORMAL", normal_space="TANGENT", margin=0)  # loads the texture, builds the scene
    begin = time.perf_counter()
    bpy.ops.object.bake(type="NORMAL", normal_space="TANGENT", margin=0)
    seconds = time.perf_counter() - begin
    image.file_format = "OPEN_EXR"
    image.filepath_raw = out
    image.save()
    return seconds


print("SECONDS", imported(*args)[0] if job == "import" else bump(*args))
