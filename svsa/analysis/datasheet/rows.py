"""The numbers of a datasheet as rows of a table."""

from svsa.analysis.datasheet.measure import SHORTEST_S, Datasheet, Variation


def list_rows(found: Datasheet) -> list[tuple[str, str]]:
    """List the numbers of a datasheet with their labels."""

    def write_range(given: tuple[float, float] | None) -> str:
        return "none" if given is None else f"{given[0]:.3g} to {given[1]:.3g} N·m/rad"

    def write_time(given: Variation | None) -> str:
        if given is None:
            return "none"
        most = "≤ " if given.time_s <= SHORTEST_S else ""
        ends = f"{given.start_nm_per_rad:.3g} to {given.end_nm_per_rad:.3g} N·m/rad"
        return f"{most}{given.time_s:.2g} s from {ends}"

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
        ("Largest elastic energy of the presets", f"{found.elastic_energy_max_j:.3g} J"),
    ]
