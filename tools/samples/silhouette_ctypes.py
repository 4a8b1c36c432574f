"""The silhouette of a model by rimline.h from Python's ctypes, as any language with a foreign function interface calls it.

    python3 silhouette_ctypes.py LIBRARY MODEL X Y Z
"""

import ctypes
import sys


class Point(ctypes.Structure):
    _fields_ = [("x", ctypes.c_double), ("y", ctypes.c_double), ("z", ctypes.c_double), ("is_direction", ctypes.c_int)]


library_path, model, *eye = sys.argv[1:]
rimline = ctypes.CDLL(library_path)
rimline.rimline_error_message.restype = ctypes.c_char_p
rimline.rimline_bytes_data.restype = ctypes.c_void_p
rimline.rimline_bytes_size.restype = ctypes.c_size_t
for name in ("mesh_free", "bytes_free", "bytes_data", "bytes_size", "error_message", "error_free"):
    getattr(rimline, f"rimline_{name}").argtypes = [ctypes.c_void_p]


def call(name, *arguments):
    error = ctypes.c_void_p()
    if getattr(rimline, f"rimline_{name}")(*arguments, ctypes.byref(error)) != 0:
        message = rimline.rimline_error_message(error).decode()
        rimline.rimline_error_free(error)
        sys.exit(f"silhouette_ctypes.py: {message}")


mesh, edges = ctypes.c_void_p(), ctypes.c_void_p()
call("mesh_load", model.encode(), None, ctypes.byref(mesh))
call("mesh_silhouette", mesh, ctypes.byref(Point(*map(float, eye), 0)), ctypes.byref(edges))
count = rimline.rimline_bytes_size(edges) // 4
ids = (ctypes.c_uint32 * count).from_address(rimline.rimline_bytes_data(edges))
vertices = (ctypes.c_uint32 * (2 * count))()
call("mesh_edge_vertices", mesh, ids, ctypes.c_size_t(count), vertices)
for first, second in zip(vertices[::2], vertices[1::2]):
    print(first, second)
rimline.rimline_bytes_free(edges)
rimline.rimline_mesh_free(mesh)
