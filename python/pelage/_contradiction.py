"""Finds contradictions between the fields of a row of results that would make its times or metrics wrong.

harness/record/contradiction.cpp also compares the identity, the limits of the checks, the CPU times and the event times
of phases with other fields; `pelage report` refuses such rows.
"""
import math
import re
from statistics import median

MOST_EVENT_SHARE = 1.1  # largest event time / wall time; above 1, because the two clocks drift
FEWEST_CONVERGED = 6  # fewer values have no 95% interval of the median


def _times(row):
    frame = row["samples"].get("frame", {})
    if not frame.get("wall_ms"):
        yield "the row is ok, but it has no times of frames"
        return
    wall, event = frame["wall_ms"], frame["event_ms"]
    for phase, lists in row["samples"].items():
        for clock, times in lists.items():
            if times and len(times) != len(wall):
                yield f"the row has {len(times)} times {clock} of the phase {phase}, but {len(wall)} timed frames"
            if any(ms is None or ms < 0 or (ms == 0 and clock != "cpu_ms") for ms in times):
                yield f"the row has a time {clock} of the phase {phase} that is not above 0"
    if row["provenance"].get("converged") is True and len(wall) < FEWEST_CONVERGED:
        yield f"the row says that its median converged, but it has only {len(wall)} timed frames"
    if event and median(event) > MOST_EVENT_SHARE * median(wall):
        yield "the median event time of a frame is above its median wall time"


def _metrics(row):
    samples, computed = row["samples"], {}
    wall = samples["frame"]["wall_ms"]
    if "covered_fragments" in row["metrics"]:
        computed["fragments_per_s"] = row["metrics"]["covered_fragments"]["value"] / (median(wall) / 1000)
    for phase, lists in samples.items():
        if phase != "frame" and lists["wall_ms"]:
            rounds = list(zip(lists["wall_ms"], wall))
            computed[f"{phase}_ratio"] = median(own / frame for own, frame in rounds)
            computed[f"frame_over_{phase}"] = median(frame / own for own, frame in rounds)
    for name, value in computed.items():
        if name in row["metrics"] and not math.isclose(row["metrics"][name]["value"], value, rel_tol=1e-6):
            yield f"the metric {name} does not follow from the row's times"


def _hashes(row):
    named = {f"the identity's part {part}": text for part, text in row.get("identity", {}).items()}
    for name, text in {**named, "image_hash": row["image_hash"] or "0" * 16}.items():
        if not re.fullmatch("[0-9a-f]{16}", text):
            yield f"{name} is '{text}', not a hash"


def contradiction(row):
    """Returns a message about the first contradiction in a row; "" if there is none. The row must have all fields."""
    for text in _hashes(row):
        return text
    if row["status"] != "ok":
        return f"the row has the status {row['status']}, but it has times" if row["samples"] else ""
    for check in (_times, _metrics):
        for text in check(row):
            return text
    return ""
