"""Figures of a study: distributions, success, sensitivities, and the worst runs."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure as Picture

from svsa.control.installed import get_title
from svsa.evaluation.studies.outcome import REFUSED
from svsa.evaluation.studies.replay import replay_row
from svsa.evaluation.studies.rows import select_rows
from svsa.evaluation.studies.stored import StoredStudy
from svsa.evaluation.studies.study import Study
from svsa.evaluation.studies.summary import SUCCEEDED, Sensitivity
from svsa.evaluation.studies.tables import convert_shown, format_metric, format_unit
from svsa.evaluation.studies.work import LAW, ROW
from svsa.inputs import arrow as pa
from svsa.runs.result.law_style import style_law
from svsa.runs.result.plot import label_axes

DISTRIBUTED = (
    "rms_position_error_rad",
    "peak_position_error_rad",
    "rms_stiffness_error_nm_per_rad",
    "effort_n2m2_s",
)
"""Metrics whose distribution is drawn; for a study without these, its first metrics."""
PANELS = 4
WORST, PEAK = 3, "peak_position_error_rad"
BINS = 16
_DPI = 130
_LETTERS_AN_INCH = 10
COLORS, SHARE = "viridis", Normalize(0.0, 100.0)
LAWLESS = ("#000000", "#666666", "#aaaaaa")


def save_pictures(
    stored: StoredStudy, rows: pa.Table, indices: Sequence[Sensitivity], folder: Path
) -> list[Path]:
    """Save one PNG for each applicable kind of figure in `folder`; return their paths.

    Raises:
        OSError: If the folder cannot be written.
    """
    study = stored.study
    rows = rows.filter(pa.compute.field("fault").is_null() | (pa.compute.field("fault") != REFUSED))
    pictures = {"distributions": draw_distributions(study, rows)}
    numeric = [variation.column for variation in study.vary if variation.is_numeric]
    if len(numeric) > 1 and study.sampling != "sensitivity":
        pictures["success"] = draw_success(study, rows, numeric[0], numeric[1])
    if indices:
        pictures["sensitivity"] = draw_sensitivity(indices)
    pictures["worst"] = draw_worst(stored, rows)
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for name, picture in pictures.items():
        paths.append(folder / f"{stored.name}_{name}.png")
        picture.savefig(paths[-1], dpi=_DPI)
    return paths


def draw_distributions(study: Study, rows: pa.Table) -> Picture:
    """Draw cumulative distributions over all runs; runs with a fault never count as below."""
    picture = Picture(figsize=(9.0, 7.0), layout="constrained")
    _entitle(picture, study.title)
    names = [name for name in DISTRIBUTED if name in study.metrics] or study.metrics[:PANELS]
    lines = math.ceil(len(names) / 2)
    panels = picture.subplots(lines, min(len(names), 2), squeeze=False).flat
    for axes in panels[len(names) :]:
        axes.remove()
    for axes, name in zip(panels, names, strict=False):
        for law in study.laws:
            own = select_rows(rows, LAW, law)
            values = np.sort(own.filter(pa.compute.field("fault").is_null())[name].to_numpy())
            shares = 100.0 * np.arange(1, len(values) + 1) / max(len(own), 1)
            axes.step(convert_shown(name, values), shares, where="post", **style_law(law))
        label_axes(axes, "Runs below [%]")
        axes.set_xlabel(f"{format_metric(name)} [{format_unit(name)}]")
        axes.set_xscale("log")
        axes.set_ylim(0.0, 101.0)
    return picture


def draw_success(study: Study, rows: pa.Table, x: str, y: str) -> Picture:
    """Draw the success rate over two settings, one panel per law; grey: no run."""
    picture = Picture(figsize=(4.4 * len(study.laws) + 0.8, 4.4), layout="constrained")
    _entitle(picture, study.title)
    panels = picture.subplots(1, len(study.laws), squeeze=False, sharex=True, sharey=True)[0]
    edges = [_find_edges(study, rows, column) for column in (x, y)]
    for axes, law in zip(panels, study.laws, strict=True):
        own = select_rows(rows, LAW, law)
        values = [own[column].to_numpy() for column in (x, y)]
        succeeded = own[SUCCEEDED].to_numpy()
        every, _, _ = np.histogram2d(*values, bins=edges)
        good, _, _ = np.histogram2d(*(value[succeeded] for value in values), bins=edges)
        share = np.divide(100.0 * good, every, where=every > 0, out=np.full_like(good, np.nan))
        axes.set_facecolor("#cccccc")
        axes.pcolormesh(*edges, share.T, norm=SHARE, cmap=COLORS)
        axes.set_title(get_title(law))
        axes.set_xlabel(_format_setting(x))
        for axis, column in (("x", x), ("y", y)):
            if _is_log(study, column):
                axes.set(**{f"{axis}scale": "log"})
    panels[0].set_ylabel(_format_setting(y))
    picture.colorbar(ScalarMappable(SHARE, COLORS), ax=panels, label="Succeeded [%]")
    return picture


def draw_sensitivity(indices: Sequence[Sensitivity]) -> Picture:
    """Draw Sobol indices with their intervals as bars, the largest first."""
    picture = Picture(figsize=(8.0, 0.9 + 3.0 * len(indices)), layout="constrained")
    panels = picture.subplots(len(indices), 1, squeeze=False)[:, 0]
    for axes, sensitivity in zip(panels, indices, strict=True):
        names = sorted(
            sensitivity.total_order, key=lambda name: sensitivity.total_order[name].value
        )
        places = np.arange(len(names))
        for shift, order, label, color in (
            (-0.2, sensitivity.first_order, "its own share", "#0072B2"),
            (0.2, sensitivity.total_order, "with interactions", "#E69F00"),
        ):
            values = np.array([order[name] for name in names])
            ends = values[:, 1:]
            axes.barh(places + shift, values[:, 0], 0.38, label=label, color=color)
            axes.errorbar(
                ends.mean(axis=1),
                places + shift,
                xerr=np.ptp(ends, axis=1) / 2.0,
                fmt="none",
                ecolor="black",
                capsize=2,
            )
        axes.set_yticks(places, [_format_setting(name) for name in names])
        axes.set_xlabel(
            f"Share of the variance of {sensitivity.outcome}, {get_title(sensitivity.law)}"
        )
        axes.axvline(0.0, color="#444444", linewidth=0.8)
        axes.legend(loc="lower right", fontsize="small")
    return picture


def draw_worst(stored: StoredStudy, rows: pa.Table) -> Picture:
    """Draw the position error of the worst runs of each law, run again: earliest faults first."""
    study = stored.study
    picture = Picture(figsize=(8.0, 0.9 + 2.4 * len(study.laws)), layout="constrained")
    _entitle(picture, f"{study.title}: the {WORST} worst runs of each law")
    panels = picture.subplots(len(study.laws), 1, squeeze=False, sharex=True)[:, 0]
    for axes, law in zip(panels, study.laws, strict=True):
        own = select_rows(rows, LAW, law)
        for number, row in enumerate(find_worst(own, study.metrics)):
            result = replay_row(stored, row).result
            style: dict[str, Any] = style_law(law) | {"color": LAWLESS[number], "linestyle": "-"}
            ended = f", ended: {result.fault.code}" if result.fault else ""
            style["label"] = f"row {row}{ended}"
            error = np.degrees(result.position_error_rad)
            axes.plot(result.time_s, error, **style)
            if result.fault:
                axes.plot(result.time_s[-1], error[-1], marker="x", color=style["color"])
        label_axes(axes, f"{get_title(law)}\nposition error [°]")
        axes.legend(loc="best", fontsize="small")
    panels[-1].set_xlabel("Time [s]")
    return picture


def _entitle(picture: Picture, title: str) -> None:
    """Wrap a title to the width of the figure."""
    picture.suptitle(
        "\n".join(textwrap.wrap(title, int(_LETTERS_AN_INCH * picture.get_figwidth())))
    )


def find_worst(rows: pa.Table, metrics: Sequence[str], count: int = WORST) -> list[int]:
    """Find the worst rows: faults, earliest first, then the largest peaks.

    `metrics` are those of the table; without peak metrics the first one is used.
    """
    metric = PEAK if PEAK in metrics else metrics[0]
    order = rows.append_column("whole", rows["fault"].is_null()).sort_by(
        [("whole", "ascending"), ("fault_tick", "ascending"), (metric, "descending")]
    )
    return order[ROW].to_pylist()[:count]


def _find_edges(study: Study, rows: pa.Table, column: str) -> np.ndarray:
    """Compute bin edges: between the values of a grid; otherwise of equal width."""
    levels = next(variation.levels for variation in study.vary if variation.column == column)
    if len(levels) > 1:
        at = np.log(np.sort(levels)) if _is_log(study, column) else np.sort(levels)
        middles = (at[1:] + at[:-1]) / 2.0
        ends = np.concatenate([[2 * at[0] - middles[0]], middles, [2 * at[-1] - middles[-1]]])
        return np.exp(ends) if _is_log(study, column) else ends
    values = rows[column].to_numpy()
    space = np.geomspace if _is_log(study, column) else np.linspace
    return space(values.min(), np.nextafter(values.max(), np.inf), BINS + 1)


def _is_log(study: Study, column: str) -> bool:
    variation = next(item for item in study.vary if item.column == column)
    return variation.kind == "log_uniform" or getattr(variation, "spacing", "") == "log"


def _format_setting(column: str) -> str:
    return column.replace(".factor", " ×")
