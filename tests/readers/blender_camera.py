"""Run inside Blender: imports a .glb and writes the poses of its animated camera as JSON.

blender -b --factory-startup --python blender_camera.py -- GLB OUT.json WIDTH HEIGHT TIME...
"""
import json
import sys

import bpy
import numpy

# Debian 12's importer is older than its NumPy, which has dropped these names.
for name, kind in [("bool", bool), ("int", int), ("float", float), ("object", object)]:
    if name not in numpy.__dict__:
        setattr(numpy, name, kind)

path, out, width, height, *times = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=path)
scene = bpy.context.scene
camera = next(thing for thing in scene.objects if thing.type == "CAMERA")
scene.camera = camera
fps = scene.render.fps / scene.render.fps_base
poses = []
for time in map(float, times):
    at = time * fps
    scene.frame_set(int(at // 1), subframe=at % 1)
    poses.append([list(row) for row in camera.matrix_world])
things = {}
for thing in scene.objects:
    if thing.type != "MESH":
        continue
    corners = [thing.matrix_world @ vertex.co for vertex in thing.data.vertices]
    if "object_id" in thing:
        things[thing["object_id"]] = [[min(c[i] for c in corners) for i in range(3)],
                                      [max(c[i] for c in corners) for i in range(3)]]
projection = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=int(width),
                                       y=int(height))
with open(out, "w") as file:
    json.dump({"poses": poses, "projection": [list(row) for row in projection],
               "boxes": things}, file)
