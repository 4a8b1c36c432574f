"""Silhouettes of meshes and point clouds: found, kept up to date while a camera moves, and drawn.

For example::

    import rimline

    mesh = rimline.load("bunny.obj")
    print(mesh.silhouette(eye=(2, 1, 2)).edges)         # N x 2 vertex numbers
    tracker = rimline.Tracker(mesh, eye=(2, 1, 2))
    print(tracker.move_to((2, 1, 1.9)).added)           # what changed, as arrays
    rimline.draw(mesh, hidden="dashed").save("bunny.svg")
    rimline.render(mesh, style="toon", ground=True).save("bunny.png")

Coordinates are those of the mesh. Directions point from the mesh towards the viewer or the light. Long calls let other
threads run, stop on Ctrl-C, and take `progress`: True for a bar of tqdm, such a bar, or a function of the finished
share.
"""

from __future__ import annotations

import collections.abc
import importlib
import inspect
import operator
import os
import re
import threading
from typing import Any, Iterable, NamedTuple, Sequence, SupportsIndex, Union

import numpy as np
import numpy.typing as npt

from rimline import _rimline
from rimline._rimline import (
    FIELD_FUNCTIONS,
    LINE_KINDS,
    POINT_LABELS,
    CameraPath,
    CancelledError,
    ChangeSet,
    DeviceLostError,
    Error,
    FileError,
    InputError,
    LineDrawer,
    LineDrawing,
    Mesh,
    MissingFileError,
    NoDeviceError,
    PointSilhouette,
    PointSurface,
    ServiceTracker,
    Silhouette,
    SilhouetteService,
    Snapshot,
    TangentialField,
    TooLargeError,
    Tracker,
    View,
    __version__,
    best_light,
    devices,
    load,
    load_points,
)

__all__ = [
    "FIELD_FUNCTIONS",
    "LINE_KINDS",
    "POINT_LABELS",
    "CameraPath",
    "CancelledError",
    "ChangeSet",
    "DeviceLostError",
    "Error",
    "FileError",
    "InputError",
    "Line",
    "LineDrawer",
    "LineDrawing",
    "Mesh",
    "MissingFileError",
    "NoDeviceError",
    "Picture",
    "PointSilhouette",
    "PointSurface",
    "Renderer",
    "Scene",
    "ServiceTracker",
    "Silhouette",
    "SilhouetteService",
    "Snapshot",
    "TangentialField",
    "TooLargeError",
    "Tracker",
    "View",
    "__version__",
    "best_light",
    "best_views",
    "camera_path",
    "devices",
    "draw",
    "load",
    "load_points",
    "render",
]


def __dir__() -> list[str]:
    return sorted(__all__)


Vector = Union[Sequence[float], "npt.NDArray[Any]"]


class Line(NamedTuple):
    """A line of a LineDrawing on its page."""

    kind: str
    """One of LINE_KINDS."""
    hidden: bool
    closed: bool
    points: npt.NDArray[np.float64]
    """N x 2, in mm, y downwards."""


class Picture(np.ndarray):  # type: ignore[type-arg]
    """An H x W x 4 array of uint8: sRGB and straight alpha, rows from the top."""

    def save(self, path: str | bytes | os.PathLike[str] | os.PathLike[bytes]) -> None:
        """Writes a .png file, whole or not at all."""
        if isinstance(path, (str, bytes, os.PathLike)):
            name = os.fsdecode(path)
            if os.path.splitext(name)[1].lower() not in (".png", ""):
                raise ValueError(f"path: pictures are saved as .png, not {name!r}")
        _rimline.save_png(self, path)

    def _repr_png_(self) -> bytes | None:
        is_picture = self.ndim == 3 and self.shape[2] == 4 and self.dtype == np.uint8 and self.size > 0
        return _rimline.encode_png(self) if is_picture else None


class Scene:
    """A mesh, and how to draw it. The keywords are options of `rimline render`, with _ for -::

        Camera   eye (a point, or auto, front, back, left, right, top, bottom, three-quarter), azimuth, elevation,
                 target, up, fov, ortho
        Style    style (ink, toon, blueprint, hatch, mask), palette, color, line_color, materials, lines, line_width,
                 crease, intersections, min_length, hidden, silhouette_from (a point), silhouette_direction (towards
                 the viewer), shadows, ground, ground_up
        Lights   light (a point, or several), sun (a direction, several, or auto), lighting
        Image    size (width and height), background (a color, or 'none'; None: a color of the style), seed (of all
                 random numbers, 0 to 2^32 - 1)

    A color is a name, '#rrggbb', or three numbers from 0 to 1. What is not given is chosen for the mesh.
    """

    def __init__(self, mesh: Mesh, **options: Any) -> None:
        if not isinstance(mesh, Mesh):
            raise TypeError(f"mesh: expected a rimline.Mesh, not {type(mesh).__name__}")
        size = options.get("size")
        if size is not None and not isinstance(size, str):
            if isinstance(size, (bytes, bytearray)) or not isinstance(size, (collections.abc.Sequence, np.ndarray)):
                raise TypeError(f"size: expected width and height, not {size!r}")
            try:
                width, height = map(operator.index, size)
            except (TypeError, ValueError) as error:
                raise type(error)(f"size: expected width and height, not {size!r}") from None
            options["size"] = f"{width}x{height}"
        _rimline._check_scene_options(options)
        self.mesh = mesh
        self.options = options

    def replace(self, **options: Any) -> Scene:
        """A scene with other options in place of these."""
        return Scene(self.mesh, **{**self.options, **options})

    def _repr_png_(self) -> bytes | None:
        return render(self)._repr_png_()


class Renderer(_rimline.Renderer):
    """Draws scenes on a Vulkan device. Meshes and silhouettes stay on it from one picture of a mesh to the next."""

    def render(self, scene: Scene | Mesh, *, progress: Any = None, **options: Any) -> Picture:
        """Draws a scene, or a mesh with the options of Scene, as an H x W x 4 array of uint8."""
        if not isinstance(scene, Scene):
            scene = Scene(scene, **options)
        elif options:
            scene = scene.replace(**options)
        return self._render(scene.mesh, scene.options, progress).view(Picture)


_shared_renderer: Renderer | None = None
# The garbage collector may run code that draws while the renderer is made.
_shared_renderer_lock = threading.RLock()


def _refuse_copies(self: Any, protocol: Any = None) -> Any:
    raise TypeError(f"cannot copy or pickle a {type(self).__name__}")


# Python's own way would make objects without their C++ part.
for _value in vars(_rimline).values():
    if isinstance(_value, type) and not issubclass(_value, BaseException):
        _value.__reduce__ = _value.__reduce_ex__ = _refuse_copies  # type: ignore[assignment]


def _forget_renderer() -> None:
    """In a child of fork(): the device belongs to the parent."""
    global _shared_renderer, _shared_renderer_lock
    _shared_renderer, _shared_renderer_lock = None, threading.RLock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_renderer)


def _renderer() -> Renderer:
    global _shared_renderer
    with _shared_renderer_lock:
        if _shared_renderer is None:
            _shared_renderer = Renderer(os.environ.get("RIMLINE_DEVICE", ""))
        return _shared_renderer


def render(scene: Scene | Mesh, *, progress: Any = None, **options: Any) -> Picture:
    """Draws a scene, or a mesh with the options of Scene, on the default device (or that of RIMLINE_DEVICE)."""
    return _renderer().render(scene, progress=progress, **options)


class _Parts:
    """One `progress` for calls that follow each other."""

    def __init__(self, progress: Any) -> None:
        self._progress = progress
        self._shown = 0.0
        self._closes = progress is True
        if progress is True:
            bars = importlib.import_module("tqdm.auto")  # Which has no types.
            self._progress = bars.tqdm(total=1.0, bar_format="{percentage:3.0f}%|{bar}| {elapsed}")

    def __enter__(self) -> _Parts:
        return self

    def __exit__(self, *_: object) -> None:
        if self._closes:
            self._progress.close()

    def part(self, begin: float, end: float) -> Any:
        """For a call that takes the share from `begin` to `end`."""
        progress = self._progress
        is_bar = hasattr(progress, "update") and hasattr(progress, "n")
        if not is_bar and not callable(progress):
            return progress  # None, or what the call refuses.
        if is_bar and progress.total is None:
            progress.total = 1.0

        def show(share: float) -> None:
            reached = begin + (end - begin) * share
            if reached <= self._shown:
                return
            if is_bar:
                progress.update(progress.total * (reached - self._shown))
            else:
                progress(reached)
            self._shown = reached

        return show


def draw(mesh: Mesh, *, progress: Any = None, **options: Any) -> LineDrawing:
    """The lines of a mesh from a camera, with the options of LineDrawer.draw().

    They are those of `rimline draw`, but `page` is 'fit' if it is not given, and that of the command A4.
    """
    with _Parts(progress) as parts:
        return LineDrawer(mesh, progress=parts.part(0.0, 0.5)).draw(progress=parts.part(0.5, 1.0), **options)


def best_views(
    mesh: Mesh,
    count: SupportsIndex = 4,
    *,
    visible: bool = True,
    renderer: Renderer | None = None,
    below: str = "less",
    by_area: bool = False,
    up: Vector | str | None = None,
    progress: Any = None,
) -> list[View]:
    """The viewpoints that together show a mesh best, the best one first.

    visible: weigh votes by the visible share of the silhouette, which is drawn by `renderer` or on the default device;
    without any device rays count it.
    below: 'less', views from below, from behind and of the ends of long meshes count less; 'full', they do not.
    by_area: planes count by the areas of their faces. count: 1 to 64; there are fewer views where no other shows more.
    up: a direction, an axis as 'z' or '-y', or 'auto': along which the mesh stands; None: mesh.up.
    """
    if not isinstance(visible, (bool, np.bool_)):
        raise TypeError(f"visible: expected True or False, not {visible!r}")
    if renderer is not None and not isinstance(renderer, _rimline.Renderer):
        raise TypeError(f"renderer: expected a rimline.Renderer, not {type(renderer).__name__}")
    if visible and renderer is None:
        try:
            renderer = _renderer()
        except NoDeviceError:
            if os.environ.get("RIMLINE_DEVICE"):
                raise  # One was asked for.
    return _rimline._best_views(mesh, count, bool(visible), renderer, below, by_area, up, progress)


def camera_path(
    mesh: Mesh,
    views: SupportsIndex | Iterable[View | Vector] | npt.NDArray[Any] = 4,
    *,
    up: Vector | str | None = None,
    progress: Any = None,
    **options: Any,
) -> CameraPath:
    """A closed, smooth path through the best views of a mesh; `options` are those of best_views().

    views: how many (2 to 64), or those of best_views(), or their eyes (N x 3, 1.73 to 2 radii from the center).
    """
    if isinstance(views, (str, bytes)) or not isinstance(views, (Iterable, SupportsIndex)):
        raise TypeError(f"views: expected an integer, views or points, not {type(views).__name__}")
    if not isinstance(views, Iterable):
        if not 2 <= operator.index(views) <= 64:
            raise ValueError(f"views: expected 2 to 64, not {operator.index(views)}")
        unknown = next((name for name in options if name not in inspect.signature(best_views).parameters), None)
        if unknown is not None:
            raise TypeError(f"camera_path() got an unexpected keyword argument '{unknown}'")
        with _Parts(progress) as parts:
            found = best_views(mesh, views, up=up, progress=parts.part(0.0, 0.7), **options)
            found_eyes: list[Any] = [view.eye for view in found]
            return CameraPath(mesh, found_eyes, up=up, progress=parts.part(0.7, 1.0))
    if options:
        name = next(iter(options))
        known = inspect.signature(best_views).parameters
        raise TypeError(
            f"{name}: only where views is a number" if name in known else f"unexpected keyword argument '{name}'"
        )
    eyes: list[Any] = [view.eye if isinstance(view, View) else view for view in views]
    if len(eyes) < 2:
        raise ValueError(f"views: expected at least two, not {len(eyes)}")
    try:
        return CameraPath(mesh, eyes, up=up, progress=progress)
    except (TypeError, ValueError) as error:
        raise type(error)(re.sub(r"^eyes\b", "views", str(error))) from None
