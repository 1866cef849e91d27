"""Blender's side of scripts/bench: blender -b --factory-startup -P scripts/bench_blender.py -- JOB ARGUMENTS...

import MESH.obj                          prints SECONDS of the operator alone: no start, no textures read
bump MESH.obj HEIGHT.exr AMPLITUDE SIZE OUT.exr     the same of the bake operator
displace CAGE.obj HEIGHT LEVELS AMPLITUDE OUT.obj   prints SECONDS from import to export, of the modifiers alone, quads
transfer HIGH.obj LOW.obj SIZE SAMPLES EXTRUSION OUT.exr   the same of a bake of HIGH to the uvs of LOW, and peak MiB
render MESH.obj SIZE                     SECONDS of one sample per pixel in Cycles, without import, export and BVH
cage cube|suzanne OUT.obj                writes one of Blender's own primitives, with uvs
"""
import resource
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


def displace(cage, height, levels, amplitude, out):
    """Catmull-Clark limit surface and Displace along the normal, evaluated once and written as it is: modifiers are not
    applied to the object, which would take longer and more memory. The texture is read inside the time."""
    begin = time.perf_counter()
    item = imported(cage)[1]
    item.data.polygons.foreach_set("use_smooth", [True] * len(item.data.polygons))
    item.data.use_auto_smooth = False
    surface = item.modifiers.new("surface", "SUBSURF")
    surface.subdivision_type = "CATMULL_CLARK"
    surface.levels = surface.render_levels = int(levels)
    surface.use_limit_surface = True
    surface.quality = max(3, surface.quality)
    texture = bpy.data.textures.new("height", "IMAGE")
    texture.image = bpy.data.images.load(height)
    texture.image.colorspace_settings.name = "Non-Color"
    texture.use_interpolation = True
    texture.use_mipmap = False
    relief = item.modifiers.new("relief", "DISPLACE")
    relief.texture = texture
    relief.texture_coords = "UV"
    relief.direction = "NORMAL"
    relief.mid_level = 0.5
    relief.strength = float(amplitude)
    middle = time.perf_counter()
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = item.evaluated_get(graph).data
    quads = len(mesh.polygons)
    modifiers = time.perf_counter() - middle
    middle = time.perf_counter()
    exported(out)
    export = time.perf_counter() - middle
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return f"{time.perf_counter() - begin:.4f} {modifiers:.4f} {export:.4f} {quads} {peak:.0f}"


def transfer(high, low, size, samples, extrusion, out):
    """HIGH's normals as a tangent-space map of LOW, both with the normals of their files. Prints peak MiB as well. The bake
    is the first of the process, as a user's is, and builds Cycles' scene and BVH."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = int(samples)
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    source, target = imported(high)[1], imported(low)[1]
    image = bpy.data.images.new("map", int(size), int(size), float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    for item in (source, target):
        material = bpy.data.materials.new("plain")
        material.use_nodes = True
        item.data.materials.clear()
        item.data.materials.append(material)
        item.select_set(True)
    nodes = target.data.materials[0].node_tree.nodes
    nodes.active = nodes.new("ShaderNodeTexImage")
    nodes.active.image = image
    bpy.context.view_layer.objects.active = target
    extruded = {} if extrusion == "default" else {"cage_extrusion": float(extrusion)}
    begin = time.perf_counter()
    bpy.ops.object.bake(type="NORMAL", normal_space="TANGENT", use_selected_to_active=True, margin=0, **extruded)
    seconds = time.perf_counter() - begin
    image.file_format = "OPEN_EXR"
    image.filepath_raw = out
    image.save()
    return f"{seconds:.4f} {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f}"


def render(mesh, size):
    """A diffuse and glossy mesh under one sun, direct light alone. The picture of one sample is rendered twice: with
    persistent data the second time has neither export nor building of the BVH."""
    import math
    from mathutils import Vector
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.samples = 1
    scene.render.use_persistent_data = True
    scene.render.resolution_x = scene.render.resolution_y = int(size)
    item = imported(mesh)[1]
    item.data.polygons.foreach_set("use_smooth", [True] * len(item.data.polygons))
    light = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    light.data.angle = 0
    light.rotation_mode = "QUATERNION"
    light.rotation_quaternion = Vector((-1, -2, -1.5)).to_track_quat("-Z", "Y")
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (0, 2.4, 2.4)
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = Vector((0, -1, -1)).to_track_quat("-Z", "Y")
    camera.data.sensor_fit = "VERTICAL"
    camera.data.angle_y = math.radians(45)
    for thing in (light, camera):
        scene.collection.objects.link(thing)
    scene.camera = camera
    bpy.ops.render.render()
    begin = time.perf_counter()
    bpy.ops.render.render()
    return time.perf_counter() - begin


def exported(out):
    """By the writer of that ending: OBJ's is in C++ and the fastest of them; Debian's Blender has no Alembic and no USD."""
    if out.endswith(".obj"):
        bpy.ops.wm.obj_export(filepath=out, forward_axis="Y", up_axis="Z", apply_modifiers=True, export_uv=True,
                              export_normals=True, export_materials=False, export_selected_objects=True)
    elif out.endswith(".ply"):
        bpy.ops.export_mesh.ply(filepath=out, use_selection=True, use_normals=True, use_uv_coords=True, use_colors=False)
    else:
        bpy.ops.export_scene.gltf(filepath=out, use_selection=True, export_apply=True, export_materials="NONE")


def cage(shape, out):
    if shape == "suzanne":
        bpy.ops.mesh.primitive_monkey_add()
    else:
        bpy.ops.mesh.primitive_cube_add()
    bpy.ops.wm.obj_export(filepath=out, forward_axis="Y", up_axis="Z", export_uv=True, export_normals=False,
                          export_materials=False)
    return 0


jobs = {"import": lambda mesh: imported(mesh)[0], "bump": bump, "displace": displace, "transfer": transfer, "render": render, "cage": cage}
print("SECONDS", jobs[job](*args))
