"""The names of the laws of this package, for type checkers."""

from typing import Literal, NewType, TypeAlias

KnownLaw: TypeAlias = Literal[
    "adrc",
    "backstepping",
    "eso_saturated",
    "esp",
    "fl",
    "fl_integral",
    "ilc",
    "impedance",
    "linear_dob",
    "lqi",
    "ndobc",
    "ndobc_k",
    "ndobc_s",
    "ndobc_w",
    "nmpc",
    "pd",
    "pi_observer",
    "pid",
    "prescribed_performance",
    "rbf_network",
    "super_twisting",
]
"""A type checker does not see entry points; a test compares the two lists."""

AnyLaw = NewType("AnyLaw", str)
"""The name of a law that a type checker cannot know: from another package, or in a variable."""
