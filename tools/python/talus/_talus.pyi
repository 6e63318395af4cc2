"""The extension module, whose other names the Python files of the package wrap."""

from typing import Any

class SceneError(ValueError):
    """Errors of a scene, a line each with file, line, field, value and rule."""

class NonFiniteState(RuntimeError):
    """The state of a body became NaN or infinite; the message has step and body."""

def __getattr__(name: str) -> Any: ...
