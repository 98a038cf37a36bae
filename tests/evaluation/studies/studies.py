"""Studies of short runs, some of which end in a fault."""

from svsa.evaluation.studies.study import Study

SHORT_S = 1.2
VARIED = (
    {
        "kind": "uniform",
        "path": "actuator.link_inertia_kg_m2",
        "low": 0.5,
        "high": 1.5,
        "relative": True,
    },
    {"kind": "uniform", "path": "loads[0].torque_nm[0]", "low": 0.0, "high": 40.0},
    {"kind": "choice", "path": "effects", "values": ["ideal", "rig"]},
)
LOADED = {"figure": "4a", "loads": [{"kind": "constant", "torque_nm": [0, 0, 0], "start_s": 0.1}]}


def build_study(**changes):
    """Build a study of 40 samples under two laws: inertia, a step load on the link, and effects."""
    given = {
        "title": "Short runs",
        "base": LOADED,
        "laws": ("ndobc", "fl"),
        "vary": VARIED,
        "runs": 40,
        "seed": 5,
        "duration_s": SHORT_S,
        "measure_from_s": 0.05,
    }
    return Study(**(given | changes))
