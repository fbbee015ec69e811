"""Finds contradictions between the fields of a row of results. harness/journal/contradiction.cpp is the C++ version."""
import json
import math
import re
from statistics import median

MOST_EVENT_SHARE = 1.1  # largest event time / wall time; above 1, because the two clocks drift
MOST_CPU_SHARE, CPU_MARGIN_MS = 1.5, 20  # CPU time is measured for a slightly longer interval than wall time
FEWEST_CONVERGED = 6  # fewer values have no 95% interval of the median
WEAKEST = {"psnr": (">=", 55), "p99.9": ("<=", 2 / 255), "flips": ("<=", 0.001)}  # harness/compare/tolerances.hpp
DEVICE_KEYS = ("platform", "platform_version", "device_name", "device_version", "driver", "compute_units",
               "lanes", "pocl_affinity", "environment", "timer", "timer_resolution_ns")


def hash_of_texts(texts):
    """Returns the 64-bit FNV-1a hash of texts, each preceded by its length (harness/hash.hpp)."""
    value = 0xcbf29ce484222325
    for text in texts:
        data = text.encode()
        for byte in len(data).to_bytes(8, "little") + data:
            value = (value ^ byte) * 0x100000001b3 % 2**64
    return value


def _equal(a, b):
    return math.isclose(a, b, rel_tol=1e-6)


def _checks(row):
    for check in row["check"]:
        sense, limit = WEAKEST.get(check["metric"], (check["sense"], None))
        if limit is None or check["against"] == "experiment":
            continue
        weaker = float(check["limit"]) < limit if sense == ">=" else float(check["limit"]) > limit
        if check["sense"] != sense or weaker:
            yield f"the row's check {check['metric']} has a limit that is weaker than pelage's"


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
        cpu, cpus = lists.get("cpu_ms"), row["provenance"].get("cpus", 0)
        if cpu and lists["wall_ms"] and cpus >= 1 and (
                median(cpu) > MOST_CPU_SHARE * cpus * median(lists["wall_ms"]) + CPU_MARGIN_MS):
            yield f"the median CPU time of the phase {phase} is more than {cpus} CPUs have"
    if row["provenance"].get("converged") is True and len(wall) < FEWEST_CONVERGED:
        yield f"the row says that its median converged, but it has only {len(wall)} timed frames"
    phases = [lists["event_ms"] for phase, lists in row["samples"].items() if phase != "frame" and lists["event_ms"]]
    if any(len(times) != len(event) for times in phases):
        yield "the row has event times of phases, but not of the frames"
    elif event and not all(_equal(sum(parts), whole) for *parts, whole in zip(*phases, event)):
        yield "the event times of the phases of a frame do not sum to that of the frame"
    if event and median(event) > MOST_EVENT_SHARE * median(wall):
        yield "the median event time of a frame is above its median wall time"


def _metrics(row):
    metrics, samples = row["metrics"], row["samples"]
    wall = samples["frame"]["wall_ms"]
    if "fragments_per_s" in metrics and "covered_fragments" in metrics:
        computed = metrics["covered_fragments"]["value"] / (median(wall) / 1000)
        if not _equal(metrics["fragments_per_s"]["value"], computed):
            yield "the metric fragments_per_s does not follow from the row's times"
    for phase, lists in samples.items():
        if phase == "frame" or not lists["wall_ms"]:
            continue
        rounds = list(zip(lists["wall_ms"], wall))
        for name, ratios in ((f"{phase}_ratio", [own / frame for own, frame in rounds]),
                             (f"frame_over_{phase}", [frame / own for own, frame in rounds])):
            if name in metrics and not _equal(metrics[name]["value"], median(ratios)):
                yield f"the metric {name} does not follow from the row's times"


def _is_hash(text):
    return re.fullmatch("[0-9a-f]{16}", text) is not None


def _names(row):
    identity, provenance = row.get("identity", {}), row["provenance"]
    for part, text in identity.items():
        if not _is_hash(text):
            yield f"the identity's part {part} is '{text}', not a hash"
    if row["image_hash"] and not _is_hash(row["image_hash"]):
        yield f"image_hash is '{row['image_hash']}', not a hash"
    if "device_name" in provenance and provenance["device_name"] != row["device"]:
        yield f"the row is of the device '{row['device']}', but its provenance says '{provenance['device_name']}'"
    seed = provenance.get("check_seed")
    if seed is not None and row["schema"] > 1 and seed != hash_of_texts([row["case"]]) % 2**32:
        yield f"the seed of the row's check is not that of a case with the name {row['case']}"


def _parts(row):
    identity, provenance = row.get("identity", {}), row["provenance"]
    computed = {"scene": provenance.get("scene_hash"), "mesh": provenance.get("mesh_hash")}
    if "device_name" in provenance:
        device = {key: provenance[key] for key in DEVICE_KEYS if key in provenance}
        text = json.dumps(device, separators=(",", ":"), ensure_ascii=False)
        computed["device"] = f"{hash_of_texts([text]):016x}"
    if row["tuning"]:
        text = "".join(f"{axis}={value} " for axis, value in sorted(row["tuning"].items()))
        computed["tuning"] = f"{hash_of_texts([text]):016x}"
    for part, text in computed.items():
        if text and identity.get(part, text) != text:
            yield f"the identity has the {part} {identity[part]}, but the row gives {text}"


def contradiction(row):
    """Returns a message about the first contradiction in a row; "" if there is none. The row must have all fields."""
    for text in _names(row):
        return text
    if row["status"] != "ok":
        return f"the row has the status {row['status']}, but it has times" if row["samples"] else ""
    for check in (_parts, _checks, _times, _metrics):
        for text in check(row):
            return text
    return ""
