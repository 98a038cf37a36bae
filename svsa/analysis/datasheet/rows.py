"""The numbers of a datasheet as rows of a table."""

from svsa.analysis.datasheet.measure import SHORTEST_S, Datasheet, Variation

PUBLISHED_HEADS = ("Quantity", "Simulated plant", "Published", "Deviation", "Source")


def write_figure(value: float) -> str:
    """Write a number with three digits, and as an integer from 1000 on: not as 1e+03."""
    return f"{value:.3g}" if abs(value) < 999.5 else f"{value:.0f}"


def list_published(sheet: Datasheet) -> list[tuple[str, str, str, str, str]]:
    """List the published figures as rows below `PUBLISHED_HEADS`."""
    fields = Datasheet.model_json_schema()["properties"]

    def write(numbers: list[float], unit: str) -> str:
        return f"{' to '.join(f'{number:.4g}' for number in numbers)} {unit}" if numbers else "none"

    return [
        (
            str(fields[figure.field]["description"]),
            write(figure.measured, fields[figure.field]["unit"]),
            write(figure.published, fields[figure.field]["unit"]),
            ", ".join(f"{100.0 * share:+.1f} %" for share in figure.deviation) or "none",
            figure.source,
        )
        for figure in sheet.published
    ]


def list_rows(sheet: Datasheet) -> list[tuple[str, str]]:
    """List the numbers of a datasheet with their labels."""

    def write_range(ends: tuple[float, float] | None) -> str:
        return "none" if ends is None else f"{' to '.join(map(write_figure, ends))} N·m/rad"

    def write_time(variation: Variation | None) -> str:
        if variation is None:
            return "none"
        most = "≤ " if variation.time_s <= SHORTEST_S else ""
        ends = write_range((variation.start_nm_per_rad, variation.end_nm_per_rad))
        return f"{most}{variation.time_s:.2g} s from {ends}"

    def write_speed(speed: float | None) -> str:
        return "no limit stated" if speed is None else f"{speed:.3g} rad/s"

    return [
        ("Peak torque of spring and motor 1", f"{sheet.peak_torque_nm:.3g} N·m"),
        ("Nominal torque (half of it, assumed)", f"{sheet.nominal_torque_nm:.3g} N·m"),
        ("Stiffness range, unloaded", write_range(sheet.stiffness_range_nm_per_rad)),
        (
            "Stiffness range at nominal torque",
            write_range(sheet.stiffness_range_at_nominal_nm_per_rad),
        ),
        ("Stiffness-variation time, unloaded", write_time(sheet.variation_unloaded)),
        ("Stiffness-variation time at nominal torque", write_time(sheet.variation_loaded)),
        ("Maximum deflection", f"{sheet.deflection_max_rad:.3g} rad"),
        ("Maximum speed, unloaded", write_speed(sheet.speed_max_rad_per_s)),
        ("Largest elastic energy of the presets", f"{sheet.elastic_energy_max_j:.3g} J"),
    ]
