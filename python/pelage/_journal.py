"""Reads journals of results: files with one row of results per line (docs/results.md, docs/row.schema.json)."""
import json
import math
import re
import zlib
from pathlib import Path
from statistics import median

NEWEST_SCHEMA = 3
CRC_MARK = b',"crc":"'
FIELDS = ("schema", "run_id", "experiment", "case", "variant", "axes", "overrides", "device", "repeat", "status",
          "reason", "check", "samples", "metrics", "build_ms", "first_launch_ms", "tuning", "image_hash", "provenance")
MOST_EVENT_SHARE = 1.1  # largest event time / wall time; above 1, because the two clocks drift
FEWEST_CONVERGED = 6  # fewer values have no 95% interval of the median
STATUSES = ("ok", "failed-check", "diverged", "unsupported", "skipped", "error")


class ResultsError(ValueError):
    """A file of results is missing, damaged or contradictory. The message names the file and the line."""


def number(value):
    """Returns a number from a row as float. JSON has no infinity and no NaN, so rows contain these as strings."""
    return float(value) if isinstance(value, str) else value


def holds(check):
    value, limit = number(check["value"]), number(check["limit"])
    return value >= limit if check["sense"] == ">=" else value <= limit


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
    """Returns a message about the first contradiction between the fields of a row; "" if there is none.

    harness/record/contradiction.cpp also compares the identity, the limits of the checks, the CPU times and the event
    times of phases with other fields; `pelage report` refuses such rows.
    """
    for text in _hashes(row):
        return text
    if row["status"] != "ok":
        return f"the row has the status {row['status']}, but it has times" if row["samples"] else ""
    for check in (_times, _metrics):
        for text in check(row):
            return text
    return ""


def parse_line(line):
    """Returns the row in a line of a journal (bytes without the line feed).

    If the line is damaged, raises ResultsError. The caller adds the file and the line number to the error's message.
    """
    mark = line.rfind(CRC_MARK)
    if mark < 0 or len(line) != mark + len(CRC_MARK) + 10 or not line.endswith(b'"}'):
        raise ResultsError("the row does not end with a checksum")
    body = line[:mark]
    if line[mark + len(CRC_MARK):-2] != b"%08x" % zlib.crc32(body):
        raise ResultsError("the checksum does not match the row")
    try:
        row = json.loads(body + b"}")
    except ValueError as error:
        raise ResultsError(f"this line is not a row: {error}") from None
    schema = row.get("schema")
    if not isinstance(schema, int) or not 1 <= schema <= NEWEST_SCHEMA:
        raise ResultsError(f"the row has schema {schema}; this version of pelage reads schemas 1 to {NEWEST_SCHEMA}")
    missing = [field for field in FIELDS + (("identity",) if schema > 1 else ()) if field not in row]
    if missing:
        raise ResultsError(f"the row has no field {missing[0]}")
    if row["status"] not in STATUSES:
        raise ResultsError(f"unknown status '{row['status']}'")
    if row["status"] == "ok" and not row["check"]:
        raise ResultsError("the row is ok, but nothing was checked")
    for check in row["check"] if row["status"] == "ok" else ():
        if not holds(check):
            raise ResultsError(f"the row is ok, but its check {check['metric']} does not hold")
    if schema < NEWEST_SCHEMA:
        convert_to_present(row)
    if text := contradiction(row):
        raise ResultsError(text)
    return row


def convert_to_present(row):
    """Converts a row of schema 1 or 2 as convert_to_present() does in harness/record/ratios.cpp. These rows call the
    time of the frame divided by the time of a phase half_ratio, quarter_ratio or baseline_ratio."""
    renamed = {f"{phase}_ratio": f"frame_over_{phase}" for phase in ("half", "quarter", "baseline")}
    row["metrics"] = {renamed.get(name, name): metric for name, metric in row["metrics"].items()}
    if row["schema"] == 2:
        row["schema"] = NEWEST_SCHEMA


def key_of(row):
    """Returns the values that together identify a row in its journal."""
    return (row["experiment"], row["case"], row["variant"], row["repeat"], tuple(sorted(row["overrides"].items())))


def read_journal(file):
    """Returns the rows of a journal. Leaves out a row with the status `error` if a later row has the same key. Also
    leaves out a truncated last line, which a run leaves behind if it is killed."""
    try:
        text = Path(file).read_bytes()
    except OSError as error:
        raise ResultsError(f"{file}: cannot be read: {error.strerror}") from None
    rows = {}
    for count, line in enumerate(text.split(b"\n")[:-1], 1):
        try:
            row = parse_line(line.removesuffix(b"\r"))  # git writes it where core.autocrlf is set
        except ResultsError as error:
            raise ResultsError(f"{file}:{count}: damaged: {error}") from None
        key = key_of(row)
        if key in rows and rows[key]["status"] != "error":
            raise ResultsError(f"{file}:{count}: damaged: second row of the case {row['case']}")
        rows.pop(key, None)  # without this, dict would leave the new row at the place of the old row
        rows[key] = row
    return list(rows.values())


def journals_in(place):
    place = Path(place)
    if place.is_dir():
        files = sorted(path for path in place.rglob("*.jsonl") if path.is_file())
        if not files:
            raise ResultsError(f"{place}: contains no results (*.jsonl)")
        return files
    if not place.is_file():
        raise ResultsError(f"{place}: no such folder or file of results")
    return [place]


def read_rows(places):
    """Returns the rows of all journals in `places`, a list of folders and files. If several journals contain the same
    row, the function returns this row once."""
    known, timed = {}, {}
    for place in places:
        for file in journals_in(place):
            for row in read_journal(file):
                key = (row["run_id"], row["device"], key_of(row))
                first, other = known.setdefault(key, (row, file))
                if first != row:
                    raise ResultsError(f"{other} and {file}: each contains a row of case {row['case']} from the same "
                                       "run, but the two rows differ. One of the files was changed; give only the "
                                       "original")
                times = tuple(row["samples"].get("frame", {}).get("wall_ms", ()))
                same, other = timed.setdefault(times, (key, file)) if len(times) > 1 else (key, file)
                if same != key:
                    raise ResultsError(f"{other} and {file}: two rows claim to be different measurements, but their "
                                       f"{len(times)} frame times are equal. One of them is a changed copy; give only "
                                       "the original")
    return [row for row, file in known.values()]


def hash_of_texts(texts):
    """Returns the 64-bit FNV-1a hash of texts, each preceded by its length (harness/hash.hpp)."""
    value = 0xcbf29ce484222325
    for text in texts:
        data = text.encode()
        for byte in len(data).to_bytes(8, "little") + data:
            value = (value ^ byte) * 0x100000001b3 % 2**64
    return value


def identity_hash(identity):
    """Returns the hash that `pelage export` prints for the identity of a row (16 hexadecimal digits). Returns "" if the
    row has no identity."""
    if not identity:
        return ""
    return f"{hash_of_texts(text for pair in sorted(identity.items()) for text in pair):016x}"


def interval_rank(count):
    """Returns the rank r of the 95% interval of the median. For a rank r, the interval extends from the value that has
    r smaller values to the value that has r larger values. The larger r is, the less probable it is that this interval
    contains the true median. The function returns the largest r for which this probability is at least 95%. For fewer
    than 6 values there is no such r, and the function returns 0."""
    rank, below = 0, 0.0
    for r in range((count - 1) // 2 + 1):
        # Adds the probability that exactly r of the values are below the true median.
        below += math.exp(math.lgamma(count + 1) - math.lgamma(r + 1) - math.lgamma(count - r + 1)
                          - count * math.log(2))
        if 2 * below > 0.05 or 2 * r + 1 >= count:
            break
        rank = r
    return rank


def median_interval(values):
    """Returns a 95% interval of the median. Its limits are two of the values. The values may have any distribution."""
    ordered = sorted(values)
    rank = interval_rank(len(ordered))
    return ordered[rank], ordered[-1 - rank]
