"""What editors and type checkers read of the package."""

import inspect
import typing
from pathlib import Path

import talus


def public():
    for name in talus.__all__:
        thing = getattr(talus, name)
        yield name, thing
        if inspect.isclass(thing) and not issubclass(thing, BaseException):
            for member, value in inspect.getmembers(thing):
                own = any(member in vars(base) for base in thing.__mro__ if base.__module__.startswith("talus"))
                if own and not member.startswith("_") and (inspect.isfunction(value) or isinstance(value, property)):
                    yield f"{name}.{member}", value


def test_all_that_is_public_has_a_docstring_and_types_that_resolve():
    names = set()
    for name, thing in public():
        names.add(name)
        assert inspect.getdoc(thing), name
        assert thing.__doc__, f"{name}: has no text of its own"
        call = thing.fget if isinstance(thing, property) else thing
        if not inspect.isfunction(call):
            continue
        hints = typing.get_type_hints(call)
        expected = {parameter for parameter in inspect.signature(call).parameters if parameter != "self"}
        assert set(hints) == expected | {"return"}, name
    assert {"run", "open", "Simulation.poses", "Record.positions", "PileSleeper3D.step"} <= names


def test_the_package_says_that_it_is_typed():
    assert (Path(talus.__file__).parent / "py.typed").exists()
    assert (Path(talus.__file__).parent / "_talus.pyi").exists()
