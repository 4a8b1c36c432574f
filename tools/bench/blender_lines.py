"""Lines of a mesh by Blender's Freestyle and Line Art, for `rimline bench lines`.

Runs within Blender 3 (--python-expr), started with --debug-freestyle. Reads a mesh and a perspective camera from
standard input, as little-endian numbers:

    uint64  vertices, triangles
    float32 x, y, z      for each vertex
    uint32  a, b, c      for each triangle
    float64 x, y, z      of the eye, and of the camera's axes to the right, upwards and forwards
    float64 tangent of half the field of view

and prints, among Blender's own output, one line: `RIMLINE ` and a JSON object with Blender's version and, for each
method, the milliseconds that it says it takes for one view, and its silhouettes and borders as segments of seven
numbers: two ends in space, and 1 for visible or 0 for hidden. A method that fails is left out.
"""

import array
import json
import math
import os
import re
import sys
import tempfile
import time

import bpy
from mathutils import Matrix, Vector


def read(type_code, count):
    numbers = array.array(type_code)
    numbers.frombytes(sys.stdin.buffer.read(count * numbers.itemsize))
    if len(numbers) != count:
        sys.exit("blender_lines.py: standard input ends early")
    return numbers


STYLE = """
import bpy
from freestyle.types import Operators, UnaryPredicate1D

class Collect(UnaryPredicate1D):
    def __call__(self, view_edge):
        edge = view_edge.first_fedge
        while edge is not None:
            found.append((tuple(edge.first_svertex.point_3d), tuple(edge.second_svertex.point_3d),
                          view_edge.qi == 0))
            if edge == view_edge.last_fedge:
                break
            edge = edge.next_fedge
        return False

found = bpy.app.driver_namespace["found"]
Operators.select(Collect())
"""


class Output:
    """Catches what Blender itself prints while it runs."""

    def __enter__(self):
        self.file = tempfile.TemporaryFile()
        self.kept = os.dup(1)
        os.dup2(self.file.fileno(), 1)
        return self

    def __exit__(self, *_):
        os.dup2(self.kept, 1)
        self.file.seek(0)
        self.text = self.file.read().decode(errors="replace")


vertex_count, triangle_count = read("Q", 2)
positions, corners = read("f", 3 * vertex_count), read("I", 3 * triangle_count)
numbers = read("d", 13)
eye, right, up, forward = (Vector(numbers[k:k + 3]) for k in (0, 3, 6, 9))

scene = bpy.context.scene
for thing in list(scene.objects):
    bpy.data.objects.remove(thing)
mesh = bpy.data.meshes.new("mesh")
mesh.vertices.add(vertex_count)
mesh.vertices.foreach_set("co", positions)
mesh.loops.add(len(corners))
mesh.loops.foreach_set("vertex_index", corners)
mesh.polygons.add(triangle_count)
mesh.polygons.foreach_set("loop_start", range(0, len(corners), 3))
mesh.polygons.foreach_set("loop_total", [3] * triangle_count)
mesh.update(calc_edges=True)
thing = bpy.data.objects.new("mesh", mesh)
scene.collection.objects.link(thing)
camera = bpy.data.cameras.new("camera")
camera.angle = 2 * math.atan(numbers[12])
camera.clip_start, camera.clip_end = 1e-3 * eye.length, 1e3 * eye.length
seen_from = bpy.data.objects.new("camera", camera)
seen_from.matrix_world = Matrix((
    (right.x, up.x, -forward.x, eye.x), (right.y, up.y, -forward.y, eye.y),
    (right.z, up.z, -forward.z, eye.z), (0, 0, 0, 1)))
scene.collection.objects.link(seen_from)
scene.camera = seen_from
render = scene.render
render.resolution_x = render.resolution_y = 1000
render.engine = "CYCLES"
scene.cycles.samples = 1
scene.cycles.max_bounces = 0
scene.cycles.use_denoising = False


def seconds(name, text):
    return float(re.search(name + r"\s*:\s*([\d.]+)", text).group(1))


def by_freestyle():
    render.use_freestyle = True
    settings = bpy.context.view_layer.freestyle_settings
    settings.mode = "SCRIPT"
    text = bpy.data.texts.new("style")
    text.write(STYLE)
    settings.modules.new().script = text
    found = bpy.app.driver_namespace["found"] = []
    with Output() as output:
        bpy.ops.render.render()
    render.use_freestyle = False
    world = seen_from.matrix_world
    # Without the mesh's own structures, which it builds for each view too.
    return {"ms": 1e3 * (seconds("Feature lines", output.text) + seconds("ViewMap building", output.text)),
            "segments": [[*(world @ Vector(a)), *(world @ Vector(b)), int(seen)] for a, b, seen in found]}


def by_line_art():
    pencil = bpy.data.grease_pencils.new("lines")
    ink = bpy.data.materials.new("ink")
    bpy.data.materials.create_gpencil_data(ink)
    pencil.materials.append(ink)
    drawn = bpy.data.objects.new("lines", pencil)
    scene.collection.objects.link(drawn)
    for layer, first_level, last_level in (("visible", 0, 0), ("hidden", 1, 128)):
        pencil.layers.new(layer).frames.new(scene.frame_current)
        modifier = drawn.grease_pencil_modifiers.new(layer, "GP_LINEART")
        modifier.source_type = "SCENE"
        modifier.target_layer, modifier.target_material = layer, ink
        modifier.use_contour = modifier.use_loose = True
        modifier.use_crease = modifier.use_material = modifier.use_edge_mark = modifier.use_intersection = False
        modifier.stroke_depth_offset = 0.0
        modifier.use_multiple_levels = True
        modifier.level_start, modifier.level_end = first_level, last_level
        modifier.use_cache = layer == "hidden"  # One computation serves both layers.
    bpy.app.debug_value = 4000  # It prints its time.
    with Output() as output:
        bpy.context.view_layer.update()
        lines = drawn.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    segments = []
    for layer in lines.layers:
        for stroke in layer.active_frame.strokes:
            points = [tuple(point.co) for point in stroke.points]
            segments += [[*a, *b, int(layer.info == "visible")] for a, b in zip(points, points[1:])]
    return {"ms": 1e3 * seconds("[Ll]ine ?art total time", output.text), "segments": segments}


methods = {}
for name, method in (("Freestyle", by_freestyle), ("Line Art", by_line_art)):
    try:
        methods[name] = method()
    except Exception as error:  # The other one is still tried.
        print(f"{name}: {error}", file=sys.stderr)
print("RIMLINE " + json.dumps({"version": bpy.app.version_string, "methods": methods}), flush=True)
