"""The numbers of a datasheet as rows of a table."""

from svsa.analysis.datasheet.measure import SHORTEST_S, Datasheet, Variation

PUBLISHED_HEADS = ("Quantity", "Simulated plant", "Published", "Deviation", "Source")


def write_figure(value: float) -> str:
    """Write a number with three digits, and as an integer from 1000 on: not as 1e+03."""
    return f"{value:.3g}" if abs(value) < 999.5 else f"{value:.0f}"


def list_published(found: Datasheet) -> list[tuple[str, str, str, str, str]]:
    """List the published figures as rows below `PUBLISHED_HEADS`."""
    fields = Datasheet.model_json_schema()["properties"]

    def write(numbers: list[float], unit: str) -> str:
        return f"{' to '.join(f'{one:.4g}' for one in numbers)} {unit}" if numbers else "none"

    return [
        (
            str(fields[one.field]["description"]),
            write(one.measured, fields[one.field]["unit"]),
            write(one.published, fields[one.field]["unit"]),
            ", ".join(f"{100.0 * share:+.1f} %" for share in one.deviation) or "none",
            one.source,
        )
        for one in found.published
    ]


def list_rows(found: Datasheet) -> list[tuple[str, str]]:
    """List the numbers of a datasheet with their labels."""

    def write_range(given: tuple[float, float] | None) -> str:
        return "none" if given is None else f"{' to '.join(map(write_figure, given))} N·m/rad"

    def write_time(given: Variation | None) -> str:
        if given is None:
            return "none"
        most = "≤ " if given.time_s <= SHORTEST_S else ""
        ends = write_range((given.start_nm_per_rad, given.end_nm_per_rad))
        return f"{most}{given.time_s:.2g} s from {ends}"

    def write_speed(given: float | None) -> str:
        return "no limit stated" if given is None else f"{given:.3g} rad/s"

    return [
        ("Peak torque of spring and motor 1", f"{found.peak_torque_nm:.3g} N·m"),
        ("Nominal torque (half of it, assumed)", f"{found.nominal_torque_nm:.3g} N·m"),
        ("Stiffness range, unloaded", write_range(found.stiffness_range_nm_per_rad)),
        (
            "Stiffness range at nominal torque",
            write_range(found.stiffness_range_at_nominal_nm_per_rad),
        ),
        ("Stiffness-variation time, unloaded", write_time(found.variation_unloaded)),
        ("Stiffness-variation time at nominal torque", write_time(found.variation_loaded)),
        ("Maximum deflection", f"{found.deflection_max_rad:.3g} rad"),
        ("Maximum speed, unloaded", write_speed(found.speed_max_rad_per_s)),
        ("Largest elastic energy of the presets", f"{found.elastic_energy_max_j:.3g} J"),
    ]
