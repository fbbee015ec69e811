"""The sentences on mass-spring systems whose numbers scripts/figures.py checks.

Each entry of SENTENCES has a document, a text with places for numbers, and a function that computes the numbers from the
tables in docs/topology.
"""
import sys

from recorded_tables import by, ends, mean, median, table

SOLVERS = {"explicit-euler": "explicit Euler, 16 steps", "semi-implicit-euler": "semi-implicit Euler, 4 steps",
           "rk4": "RK4, 4 steps", "backward-euler": "backward Euler, 1 step"}
TOPOLOGIES = ("sticks", "prisms", "separable-sticks", "separable-prisms")


def frame_steps(*models):
    return [row for row in table("topology/topology-steps.csv") if row["model"] in models]


def wall_ratios(row, fits):
    """Returns the ratios of wall times (baseline time / our time) of the baselines whose name the function accepts."""
    suffix = "_ratio"
    return [value for key, value in row.items() if key.endswith(suffix) and not key.endswith("_processor_ratio")
            and value != "" and fits(key.removesuffix(suffix))]


# The columns of the table of ratios in docs/topology.md: a name and a function that accepts the column's baselines. If a
# column has several baselines, the table contains the fastest one.
COLUMNS = {
    "o3": lambda name: name == "serial-o3",
    "fast": lambda name: name == "serial-fast",
    "two": lambda name: name == "parallel-fast-2",
    "o3_double": lambda name: name == "serial-o3-double",
    "fast_double": lambda name: name == "serial-fast-double",
    "eigen": lambda name: name.startswith("eigen") and name.endswith("-1"),
    "eigen_two": lambda name: name.startswith("eigen") and name.endswith("-2"),
}


def ratio_lines():
    """Returns one entry of SENTENCES per line of the table of ratios in docs/topology.md."""
    lines = []
    for row in frame_steps("bunny"):
        found = {name: wall_ratios(row, fits) for name, fits in COLUMNS.items()}
        values = {name: format(min(ratios), ".3g") for name, ratios in found.items() if ratios}
        cells = [SOLVERS[row["variant"]], row["dynamics.topology"]] + ["{" + name + "}" if name in values else "" for name in COLUMNS]
        lines.append(("docs/topology.md", " ".join(("| " + " | ".join(cells) + " |").split()), lambda values=values: values))
    return lines


def large_ratios(name):
    return [ratio for row in frame_steps("bunny", "elephant") for ratio in wall_ratios(row, COLUMNS[name])]


def ratios_in_words():
    small = [ratio for row in frame_steps("banisch-grass") for ratio in wall_ratios(row, COLUMNS["fast"])]
    one, two, grass = ends(large_ratios("fast"), ".2f"), ends(large_ratios("two"), ".2f"), ends(small, ".2f")
    plain, eigen = ends(large_ratios("o3_double"), ".2f"), ends(large_ratios("eigen"), ".1f")
    return {"least": one["least"], "most": one["most"], "low": two["least"], "high": two["most"],
            "small": grass["least"], "small_most": grass["most"], "plain": plain["least"], "plain_most": plain["most"],
            "eigen": eigen["least"], "eigen_most": eigen["most"]}


def expect(holds, sentence):
    """Ends the program if the rows do not support the words of a sentence, which no number can mend."""
    if not holds:
        sys.exit(f"docs/topology.md: the rows of topology-equal-error do not support: {sentence}")


def equal_errors(tolerance):
    return {row["dynamics.topology"]: row for row in table("topology/topology-equal-error.csv") if row["dynamics.tolerance"] == tolerance}


def order(row, solver):
    """Returns whether the solver is "faster" or "slower" than semi-implicit Euler, or "undecided"."""
    low, high = row[solver + "_ratio_low"], row[solver + "_ratio_high"]
    return "faster" if high < 1 else "slower" if low > 1 else "undecided"


def check_words():
    """Checks the words of the sentences on the cost at equal error."""
    for tolerance, fastest in ((0.001, {"rk4": TOPOLOGIES}), (0.01, {"rk4": ("separable-sticks",)}), (0.05, {})):
        for topology, row in equal_errors(tolerance).items():
            for solver in ("explicit-euler", "rk4", "backward-euler"):
                wanted = "faster" if topology in fastest.get(solver, ()) else "slower"
                if (tolerance, topology, solver) in ((0.01, "sticks", "rk4"), (0.05, "sticks", "backward-euler")):
                    wanted = "undecided"
                expect(order(row, solver) == wanted, f"{solver} is {wanted} on {topology} at an error of {tolerance}")


def solver_ratio(row, solver):
    """Returns the ratio of the solver's time to the time of semi-implicit Euler, with its interval."""
    name = solver + "_ratio"
    return {"ratio": f"{row[name]:.2f}", "low": f"{row[name + '_low']:.2f}", "high": f"{row[name + '_high']:.2f}"}


def solver_ratios(tolerance, solver, topologies):
    rows = equal_errors(tolerance)
    return ends((rows[kind][solver + "_ratio"] for kind in topologies), ".2f")


def jacobian(topology):
    [row] = [row for row in table("topology/topology-jacobian.csv") if row["dynamics.topology"] == topology
             and abs(row["dynamics.step"] - 1 / 60) < 1e-6]

    def percent(key):
        return f"{100 * row[key]:#.2g}".rstrip(".")
    return {"full": percent("full_error_rms"), "pruned": percent("pruned_error_rms"), "full_most": percent("full_error_p99"),
            "pruned_most": percent("pruned_error_p99")}


def gaps():
    rows = {(row["dynamics.topology"], row["dynamics.wind.gust_at"]): f"{row['gap_median']:.2f}"
            for row in table("topology/topology-parting.csv")}
    return {"sticks": rows["separable-sticks", "triangle"], "prisms": rows["separable-prisms", "stick"],
            "apart": rows["separable-prisms", "triangle"]}


def iterations(reading, *models):
    rows = table("topology/topology-mesh-scaling.csv")
    return [row["iterations"] for row in rows if row["reading"] == reading and (not models or row["model"] in models)]


def topologies():
    """For each cell of Table 1, a dictionary from topology to row."""
    cells = by(table("topology/topology-table1.csv"), "model", "layers", "size")
    return [{row["dynamics.topology"]: row for row in rows} for rows in cells.values()]


def simulate_ms(*topology):
    return [c[t]["simulate_ms"] for c in topologies() for t in topology]


def simulate_ratio(topology, other):
    return [c[t]["simulate_ms"] / c[other]["simulate_ms"] for c in topologies() for t in topology]


def shares():
    return {kind: [100 * c[kind]["simulate_ms"] / c[kind]["median_ms"] for c in topologies()] for kind in topologies()[0]}


def longest_steps(solver, spring, topologies):
    rows = table("topology/banisch2006-longest-step.csv")
    return [row["longest_step_ms"] for row in rows if row["dynamics.solver"] == solver and row["reading"] == spring
            and row["dynamics.topology"] in topologies]


def backward_steps():
    return {**ends(longest_steps("backward-euler", "k10", ("sticks", "separable-sticks", "separable-prisms")), ".1f"),
            "prisms": f"{longest_steps('backward-euler', 'k10', ('prisms',))[0]:.1f}"}


def explicit_steps():
    every = ("sticks", "prisms", "separable-sticks", "separable-prisms")
    soft, stiff = ends(longest_steps("explicit-euler", "k10", every), ".2f"), ends(longest_steps("explicit-euler", "k1000", every), ".3f")
    return {"least": soft["least"], "most": soft["most"], "low": stiff["least"], "high": stiff["most"]}


def frames_by_silva(topology):
    return f"{mean(c[topology]['median_ms'] / c['silva']['median_ms'] for c in topologies()):.2f}"


SENTENCES = [
    ("docs/topology.md", "the simulation of sticks takes the least time: {least} to {most} ms",
     lambda: ends(simulate_ms("sticks"), ".2f")),
    ("docs/topology.md", "in frames of {least} to {most} ms",
     lambda: ends((c["sticks"]["median_ms"] for c in topologies()), ".0f")),
    ("docs/topology.md", "The simulation of sticks takes {least} to {most} times as long as the simulation of Silva's strands",
     lambda: ends(simulate_ratio(["sticks"], "silva"), ".2f")),
    ("docs/topology.md", "The simulation of separable topologies takes {least} to {most} times as long as the simulation of "
     "sticks.", lambda: ends(simulate_ratio(["separable-sticks", "separable-prisms"], "sticks"), ".1f")),
    ("docs/topology.md", "The simulation of shared prisms takes {least} to {most} ms.",
     lambda: ends(simulate_ms("prisms"), ".2f")),
    ("docs/topology.md", "No simulation takes more than {most}% of the frame time.",
     lambda: {"most": f"{max(x for values in shares().values() for x in values):.1f}"}),
    ("docs/topology.md", "the simulation's share of the frame time has a median of at most {most}% over all cases",
     lambda: {"most": f"{max(median(values) for values in shares().values()):.1f}"}),
    ("docs/topology.md", "{sticks} times as long with separable sticks and {prisms} times with separable prisms (geometric "
     "means)", lambda: {"sticks": frames_by_silva("separable-sticks"), "prisms": frames_by_silva("separable-prisms")}),
    ("docs/topology.md", "backward Euler is stable up to time steps of {least} to {most} ms on sticks, separable sticks and "
     "separable prisms, and up to {prisms} ms on prisms.", backward_steps),
    ("docs/topology.md", "Explicit Euler is stable up to time steps of {least} to {most} ms at 10 N/m, and up to {low} to {high} "
     "ms at 1000 N/m.", explicit_steps),
    ("docs/topology.md", "On prisms, the rms error is {full}% with the full Jacobian and {pruned}% with the pruned Jacobian; the "
     "99th percentile is {full_most}% (full) and {pruned_most}% (pruned).", lambda: jacobian("prisms")),
    ("docs/topology.md", "On sticks, the rms error is {full}% (full) and {pruned}% (pruned); the 99th percentile is {full_most}% "
     "(full) and {pruned_most}% (pruned).", lambda: jacobian("sticks")),
    ("docs/topology.md", "Without a reference area, its rows have {least} to {most} iterations on all models.",
     lambda: ends(iterations("vertex"), ".0f")),
    ("docs/topology.md", "With springs between tops that are ten times as stiff, they have {least} to {most} iterations.",
     lambda: ends(iterations("area-stiff"), ".0f")),
    ("docs/topology.md", "they have {least} iterations on the elephant with 1148 faces and {most} on the horse",
     lambda: ends(iterations("area", "banisch-elephant", "horse"), ".0f")),
    ("docs/topology.md", "The median gap is {sticks} fur lengths on separable sticks with separate gusts for each triangle. On "
     "separable prisms it is {prisms} fur lengths with gusts at the sticks, and {apart} with gusts at the triangles.", gaps),
    ("docs/topology.md", "At an rms error of 0.1% of the fur's length, RK4 is the fastest solver on all topologies: it takes "
     "{least} to {most} times as long as semi-implicit Euler.", lambda: solver_ratios(0.001, "rk4", TOPOLOGIES)),
    ("docs/topology.md", "At an rms error of 1%, semi-implicit Euler is the fastest solver on both kinds of prisms: RK4 takes "
     "{least} to {most} times as long.", lambda: solver_ratios(0.01, "rk4", ("prisms", "separable-prisms"))),
    ("docs/topology.md", "On sticks RK4 takes {ratio} times as long (95% interval {low} to {high}), so the results do not decide "
     "which of these solvers is faster.", lambda: solver_ratio(equal_errors(0.01)["sticks"], "rk4")),
    ("docs/topology.md", "On separable sticks RK4 takes {ratio} times as long ({low} to {high}) and is the fastest.",
     lambda: solver_ratio(equal_errors(0.01)["separable-sticks"], "rk4")),
    ("docs/topology.md", "At an rms error of 5%, semi-implicit Euler is the fastest solver on all topologies except sticks, where "
     "backward Euler takes {ratio} times as long ({low} to {high}), which does not decide between the two.",
     lambda: solver_ratio(equal_errors(0.05)["sticks"], "backward-euler")),
    ("docs/topology.md", "the vectorized serial code takes {least} to {most} times as long as our kernels, and the vectorized code "
     "on two threads takes {low} to {high} times as long.", ratios_in_words),
    ("docs/topology.md", "On the square of grass with 16 triangles, the vectorized serial code takes only {small} to {small_most} "
     "times as long", ratios_in_words),
    ("README.md", "the vectorized serial code takes {least} to {most} times as long as our kernels on two cores. On two threads it "
     "takes {low} to {high} times as long.", ratios_in_words),
    ("README.md", "Serial code in double precision, compiled with -O3, takes {plain} to {plain_most} times as long, and Eigen {eigen} "
     "to {eigen_most} times.", ratios_in_words),
    ("README.md", "On a square of grass with 16 triangles the vectorized code takes {small} to {small_most} times as long", ratios_in_words),
    *ratio_lines(),
]
