"""Bodies that fall asleep or wake, as a structured array."""

from __future__ import annotations

import numpy as np

from . import _talus

_causes = np.array(_talus.cause_names)

#: Fields of an event: step; number of the body; whether it woke, else it fell asleep; why, as docs/record.md has it;
#: pile and layer, -1 for none; score at the decision, 0 where none was involved.
EVENT = np.dtype(
    [("step", "i8"), ("body", "i4"), ("woke", "?"), ("cause", _causes.dtype), ("pile", "i4"), ("layer", "i4"), ("score", "f8")]
)


def events_of(rows: np.ndarray) -> np.ndarray:
    """The rows of the extension module with the names of the causes."""
    events = np.empty(len(rows), EVENT)
    for field in EVENT.names:
        events[field] = _causes[rows["cause"]] if field == "cause" else rows[field]
    return events
