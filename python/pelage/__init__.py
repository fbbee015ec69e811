"""Reads results of pelage (folders that `pelage run` writes) as pandas data frames.

    import pelage
    frame = pelage.read("pelage-results/20261123T120000Z-host")
    print(frame[frame.status == "ok"].pivot_table(index="model", columns="layers", values="median_ms"))
"""
from ._journal import ResultsError, identity_hash, median, median_interval, number, read_rows

__all__ = ["read", "ResultsError"]


def _value(text):
    """Returns the value of an axis (a varied parameter) as a number if possible.

    Rows store decimal numbers as strings to keep their digits.
    """
    if isinstance(text, str):
        try:
            return float(text)
        except ValueError:
            return text
    return text


def _contended(provenance):
    """Returns whether other processes used more than 10% of the CPU time, or the process was kept from running; None if
    the row does not record this."""
    if any(name in provenance for name in ("throttled", "stops", "suspended_s")):
        return True
    share = provenance.get("other_cpu_share")
    return None if share is None else share > 0.1


def _names(row):
    """Returns the columns that are the same for all phases of a frame: experiment, case, axes, device and so on."""
    provenance = row["provenance"]
    axes = {key: _value(value) for key, value in row["axes"].items() if key != "variant"}
    return {"experiment": row["experiment"], "case": row["case"], "variant": row["variant"], **axes,
            "overrides": ";".join(f"{key}={value}" for key, value in sorted(row["overrides"].items())),
            "device": row["device"], "host": provenance.get("host", ""), "run_id": row["run_id"],
            "repeat": row["repeat"], "preset": provenance.get("preset", ""),
            "identity": identity_hash(row.get("identity", {})), "status": row["status"], "reason": row["reason"],
            "contended": _contended(provenance)}


def _metrics(row):
    columns = {}
    for name, metric in row["metrics"].items():
        columns[f"metric.{name}"] = number(metric["value"])
        for end in ("low", "high"):
            if end in metric:
                columns[f"metric.{name}.{end}"] = number(metric[end])
    return columns


def _times(row, phase, clock):
    lists = row["samples"].get(phase, {}) if row["status"] == "ok" else {}
    return lists.get(f"{clock}_ms", [])


def _by_case(row, phase, clock):
    times = _times(row, phase, clock)
    low, high = median_interval(times) if times else (None, None)
    return {**_names(row), "phase": phase, "clock": clock, "samples": len(times),
            "median_ms": median(times) if times else None, "low_ms": low, "high_ms": high,
            "converged": row["provenance"].get("converged"), **_metrics(row)}


def _by_sample(row, phase, clock):
    names = _names(row)
    return [{**names, "phase": phase, "clock": clock, "sample": i, "ms": ms}
            for i, ms in enumerate(_times(row, phase, clock))]


def read(place, *more, phase="frame", clock="wall", samples=False):
    """Returns the rows of results in folders (at any depth) or journals (*.jsonl) as a pandas data frame.

    Several places are several arguments or a list: read("a", "b") or read(["a", "b"]).

    The data frame has one line per row of results. A row holds the results of one case in one process. A case is one
    combination of the parameters that an experiment varies (its axes). A case that failed has a row too. The columns
    have the same names as in the output of `pelage export`:
      experiment, case, variant, and one column per axis, such as model, layers, size.
      overrides: the changes made by the options --set, --axis and --model, as "key=value;...". It is "" without these
        options.
      device, host, run_id, repeat, preset, status, reason.
      contended: whether other processes used more than 10% of the machine's CPU time while the case was timed. It is
        None in rows that do not record this.
      identity: a hash of all inputs of the measurement. Lines with different hashes were measured with different
        inputs. The hash is "" in rows of schema 1, which do not record their inputs.
      phase, clock, samples (number), median_ms, low_ms, high_ms (95% interval of the median), converged.
      metric.NAME. If the metric has an interval, also metric.NAME.low and metric.NAME.high.
    Times are NaN if the status of a row is not `ok`, or if a row has no time of the phase.

    phase: "frame" (the whole frame) or a part of the frame ("simulate", "wet", "transform", "bin", "raster",
      "resolve"). It can also be another renderer or solver that was timed alternately with the frame, such as the
      baseline "opengl".
    clock: "wall", "cpu", or "event" (OpenCL events). The parts of a frame have only "event" times. Other renderers and
      solvers have no "event" times.
    samples: if True, the data frame has one line per sample, with the columns sample (index) and ms. Rows whose status
      is not ok then have no lines.

    If several journals contain the same row, it is returned once. A row with the status `error` is left out if a later
    row of the same journal has the same case. If a line is damaged, the function raises ResultsError, whose message
    names the file and the line.
    """
    import pandas

    if clock not in ("wall", "event", "cpu"):
        raise ValueError(f"clock is '{clock}'; give wall, event or cpu")
    places = [one for given in (place, *more) for one in (given if isinstance(given, (list, tuple)) else [given])]
    rows = read_rows(places)
    phases = {name for row in rows for name in row["samples"]}
    if phases and phase not in phases:
        raise ValueError(f"no row has the phase '{phase}'; the phases are {', '.join(sorted(phases))}")
    if samples:
        lines = [line for row in rows for line in _by_sample(row, phase, clock)]
    else:
        lines = [_by_case(row, phase, clock) for row in rows]
    frame = pandas.DataFrame(lines)
    ordered = [name for name in frame.columns if not name.startswith("metric.")]
    return frame[ordered + sorted(set(frame.columns) - set(ordered))]
