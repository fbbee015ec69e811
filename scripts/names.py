#!/usr/bin/env python3
"""Counts the code lines in harness/ and bench/ that refer to a mapping, pipeline, solver, topology or shading model.

A mapping is a way to distribute the work of the fur pipeline over work-items (docs/code.md). Each mapping, pipeline,
solver, topology and shading model is an item. All items of one kind (for example, all mappings) are a family. A line
refers to an item if the line contains the item's name as a string, or if it contains the item's C++ enumerator, class
or factory function. The script does not count lines in the files that implement the item. It also does not count lines
in the files that contain the table of all items of the family.

The exit status is 1 if the script counts more than two lines for an item. The option -v prints the lines.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MOST = 2

# Each family is a tuple of three values:
# - the files that contain the table of all items of the family (for example, of all mappings);
# - a dictionary, whose keys are the names of the items. The value of a name is a pair. Its first element is a pattern
#   that matches the enumerator, the class or the factory function of the item. Its second element is the list of the
#   files that implement the item;
# - a pattern, or None. In lines that match this pattern, the name of an item has another meaning. These lines are
#   not counted.
FAMILIES = {
    "mapping": (["harness/shells/opencl/mappings.cpp", "harness/cl/mapping_names.hpp"], {
        "tile": (r"shells/tile\"|tile_mapping\b|TileMapping", ["harness/shells/opencl/tile_mapping.cpp"]),
        "pixel": (r"shells/pixel\"|pixel_mapping\b|PixelMapping", ["harness/shells/opencl/pixel_mapping.cpp"]),
        "group": (r"shells/group\"|workgroup_mapping\b|WorkgroupMapping", ["harness/shells/opencl/workgroup_mapping.cpp"]),
    }, None),
    "pipeline": (["harness/subjects/pipelines.cpp", "harness/scene/pipelines.cpp", "harness/system/shells/system.cpp",
                  "harness/system/strands/system.cpp", "harness/system/table.cpp"], {
        "shells": (r"shells_system\b", ["harness/system/shells"]),
        "shells+fewer": (r"fewer_layers\(", ["harness/subjects/fewer_layers"]),
        "opengl": (r"shells::open_opengl\b", ["harness/system/shells"]),
        "shells+opengl": (r"shells_against_opengl", []),
        "strands": (r"strands_system\b", ["harness/system/strands"]),
        "strands+raycast": (r"against_raycast", ["harness/subjects/raycast_difference"]),
        "strands+opengl": (r"strands_against_opengl", []),
        "strands-opengl": (r"strands::open_opengl\b", ["harness/system/strands"]),
        "strands-reference": (r"strands_reference\b", ["harness/system/strands"]),
        "strands-raycast": (r"strands::open_raycast\b", ["harness/system/strands"]),
        "reference": (r"shells_reference\b", ["harness/system/shells"]),
        "springs": (r"make_solver\b", ["harness/springs/studies/study"]),
        "springs+rivals": (r"make_solver_against_baselines", ["harness/springs/studies/study"]),
        "springs-error": (r"make_solver_error", ["harness/springs/studies/study"]),
        "springs-limit": (r"make_solver_limit", ["harness/springs/studies/study"]),
        "springs-energy": (r"make_solver_energy", ["harness/springs/studies/study"]),
        "springs-drift": (r"make_solver_drift", ["harness/springs/studies/study", "harness/springs/studies/energy"]),
        "springs-shape": (r"make_solver_shape", ["harness/springs/studies/study", "harness/springs/studies/shape"]),
        "springs-turns": (r"make_solver_turns", ["harness/springs/studies/study", "harness/springs/studies/turns"]),
        "springs-jacobian": (r"make_solver_jacobian", ["harness/springs/studies/study"]),
    # In lines that match this pattern, "springs" is not the pipeline but a metric or a file, "strands" is a stage, a metric
    # or a list, and "opengl" is a phase or a key. The lines are not counted.
    }, r'phase_ms.find\("opengl"\)|others.push_back\(\{"opengl"|opengl_key|stages|IsMember|"strands"\);|"strands", check|"strands", "strands"|metrics\["strands"\]|metrics\["springs"\]|"masses", "springs"|metric\("springs"\)|folder, "springs", chart'),
    "solver": (["harness/scene/spring_kinds.hpp", "harness/scene/spring_kinds.cpp"], {
        "explicit-euler": (r"Solver::explicit_euler", []),
        "backward-euler": (r"Solver::backward_euler", []),
        "semi-implicit-euler": (r"Solver::semi_implicit_euler", []),
        "rk4": (r"Solver::rk4", []),
    }, None),
    "topology": (["harness/scene/spring_kinds.hpp", "harness/scene/spring_kinds.cpp"], {
        "sticks": (r"Kind::sticks\b", []),
        "prisms": (r"Kind::prisms\b", []),
        "separable-sticks": (r"Kind::separable_sticks\b", []),
        "separable-prisms": (r"Kind::separable_prisms\b", []),
    }, r'metrics\["sticks"\]'),  # here "sticks" names a metric: the number of sticks
    "shading": (["harness/scene/shading_models.cpp"], {
        "curling": (r"ShadingModel::curling", []),
        "wet": (r"ShadingModel::wet", []),
        "lambert": (r"ShadingModel::lambert", []),
    }, r'stage == "wet"|emplace_back\("wet"'),  # here "wet" is the stage or phase that computes the wetness mask
}


def main():
    # Searches the file system instead of asking git, because a source archive has no git repository
    files = sorted(str(path.relative_to(ROOT)) for folder in ("harness", "bench") for path in (ROOT / folder).rglob("*.?pp"))
    lines = [(f, n, line) for f in files
             for n, line in enumerate((ROOT / f).read_text().split("\n"), 1)
             if not line.lstrip().startswith(("//", "#include"))]
    failed = False
    for family, (tables, names, other_meaning) in FAMILIES.items():
        for name, (pattern, own) in names.items():
            named = re.compile(rf'"{re.escape(name)}"|{pattern}')
            places = [(f, n, line) for f, n, line in lines
                      if named.search(line.split("//")[0]) and f not in tables and not any(f.startswith(o) for o in own)
                      and not (other_meaning and re.search(other_meaning, line))]
            failed |= len(places) > MOST
            print(f"{family:9} {name:20} {len(places)}{'  MORE THAN ' + str(MOST) if len(places) > MOST else ''}")
            if "-v" in sys.argv or len(places) > MOST:
                for f, n, line in places:
                    print(f"          {f}:{n}: {line.strip()}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
