"""Scenes and values of their keys, as the extension module takes them."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any, Mapping, Union

import numpy as np

from ._talus import open_run

#: A path, the name of a scene that `talus list` shows, or TOML text, as talus.run() tells them apart.
Scene = Union[str, os.PathLike]
#: Values of keys by path.
Values = Mapping[str, Any]


def toml_text(value):
    """A Python value as TOML. Raises TypeError for what has none, as None."""
    if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and value.ndim == 0):
        value = value.item()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{toml_text(str(key))} = {toml_text(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(toml_text(item) for item in value) + "]"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return int.__repr__(value)
    if isinstance(value, float):
        return float.__repr__(value)
    raise TypeError(f"{value!r}: must be a number, a text, true or false, a list or a dict")


def _is_text(scene):
    """Whether a scene is TOML text, as the documentation of talus.run() has it."""
    return isinstance(scene, str) and ("\n" in scene or ("=" in scene and not os.path.isfile(scene)))


def _scene_folder():
    """The folder of the scenes that come with talus, of the build or of where it is installed."""
    folders = (folder / "share/talus/scenes" for folder in Path(__file__).resolve().parents)
    return next(filter(Path.is_dir, folders), "")


def open_scene(scene, policy, seed, backend, values, *, warnings=False, contacts=False, out=None):
    """The run of the extension module. values: of keys by path."""
    settings = [f"{path}={toml_text(value)}" for path, value in (values or {}).items()]
    is_text = _is_text(scene)
    text = scene if is_text else os.fsencode(scene)
    folder, out = os.fsencode(_scene_folder()), os.fsencode(out or "")
    return open_run(text, is_text, folder, policy or "", seed, backend or "", settings, warnings, contacts, out)
