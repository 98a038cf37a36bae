"""Reference pages of the documentation site, written from the code before each build.

Each page is a function that returns Markdown; `PAGES` names them.
"""

import json
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

from interface_pages import write_commands, write_rest, write_stream
from markdown_table import NONE, format_table
from pydantic import BaseModel
from pydantic_core import to_jsonable_python

from svsa.actuators.faults import FAULTS
from svsa.actuators.parameters import ActuatorParameters, Limits
from svsa.actuators.signals import CHANNELS
from svsa.control.gains import Gains
from svsa.control.installed import get_law, get_title, has_own_parameters, list_law_names
from svsa.evaluation.ranking.results import load_published
from svsa.hardware.bench.settings import BusSettings, DeflectionSettings, MotorSettings
from svsa.hardware.description.file import (
    DesignSettings,
    EmulatorSettings,
    HomeSettings,
    SafetySettings,
    TimingSettings,
)
from svsa.inputs.checked import read_quantity
from svsa.simulation.plant.effects import EFFECTS, Effects
from svsa.simulation.plant.loads import LOADS
from svsa.simulation.reference.kinds import POSITIONS, STIFFNESSES
from svsa_server.config import Settings


def _format_default(value: object) -> str:
    if value is None or value == "":
        return NONE
    return f"`{json.dumps(value, ensure_ascii=False)}`"


def _find_bounds(metadata: Iterable[object]) -> str:
    signs = {"ge": "≥", "gt": ">", "le": "≤", "lt": "<"}
    found = [
        f"{sign} {getattr(one, name):g}"
        for one in metadata
        for name, sign in signs.items()
        if hasattr(one, name)
    ]
    return ", ".join(found).replace(" ", "\u00a0").replace(",\u00a0", ", ") or NONE


def format_fields(model: type[BaseModel]) -> str:
    """The fields of a model: name, unit, meaning, default and bounds."""
    rows = []
    for name, field in model.model_fields.items():
        if name == "kind":
            continue
        declared = read_quantity(model, name)
        default = "required"
        if not field.is_required():
            plain = to_jsonable_python(field.get_default(call_default_factory=True))
            default = NONE if plain == {} else _format_default(plain)
        unit = declared.unit or NONE
        bounds = _find_bounds(field.metadata)
        rows.append((f"`{name}`", unit, declared.meaning, default, bounds))
    return format_table(("field", "unit", "meaning", "default", "bounds"), rows)


def _get_summary(documented: object) -> str:
    return (documented.__doc__ or "").strip().partition("\n\n")[0].replace("\n    ", " ")


def write_settings() -> str:
    """The settings of the server."""
    rows = [
        (
            f"`SVSA_{name.upper()}`",
            field.description,
            _format_default(to_jsonable_python(field.default)),
            _find_bounds(field.metadata),
        )
        for name, field in Settings.model_fields.items()
    ]
    others = [
        ("`SVSA_DATA`", "Folder of runs, studies and course progress", "`~/.local/share/svsa`"),
        (
            "`SVSA_CACHE`",
            "Folder of the compiled functions; `svsa-UID` in the folder of temporary files if it"
            " cannot be used",
            "`~/.cache/svsa`",
        ),
    ]
    return f"""# Settings

The server reads its settings from environment variables. `svsa serve` has options for the most
used ones; an option
takes precedence. A wrong value is reported at the start with its bound.

{format_table(("variable", "meaning", "default", "bounds"), rows)}

Library and server read two more:

{format_table(("variable", "meaning", "default"), others)}
"""


def write_channels() -> str:
    """The channels of a sample."""
    rows = [(f"`{one.name}`", one.unit, one.label) for one in CHANNELS]
    return f"""# Channels

A sample has {len(CHANNELS)} channels. They have the same names as attributes of a result, as
columns of exported files,
in recordings and in the stream. Every value is in SI units; the page converts to degrees. Signs
are defined in the
[conventions](../../explanation/conventions.md).

{format_table(("channel", "unit", "label"), rows)}

On a bench the true disturbances are not known: their channels are NaN. The residuals compare the
bench with its
simulated twin; they are 0 in every other lane.
"""


def write_faults() -> str:
    """The fault sheet: a table of all faults, and cause and advice of each."""
    rows = [(f"[`{name}`](#{name})", kind.label, kind.cause) for name, kind in FAULTS.items()]
    sheets = "\n".join(
        f"## `{name}`\n\n**{kind.label}**: {kind.cause}.\n\n"
        f"* Occurs: {'bench' if kind.where == 'bench' else 'simulation and bench'}\n"
        + (f"* Zero current within {1000 * kind.within_s:g} ms\n" if kind.within_s else "")
        + f"* Advice: {kind.advice}\n"
        for name, kind in FAULTS.items()
    )
    return f"""# Faults

A fault ends a run. It is latched, with the values that caused it, until a user clears it.
`svsa.FaultError`, the state of
a session and the recording of the run carry the code.

{format_table(("code", "label", "cause"), rows)}

{sheets}
"""


def write_kinds() -> str:
    """Effects, loads and references with their parameters."""
    parts = ["# Effects, loads and references\n"]
    parts.append(
        "## Non-ideal effects\n\nArguments of `svsa.Effects`, the field `effects` in REST.\n"
    )
    for effect in EFFECTS:
        model = type(effect.on)
        parts.append(f"### `{effect.name}`\n")
        if isinstance(effect.on, BaseModel):
            parts.append(f"{_get_summary(model)}\n\n{format_fields(type(effect.on))}\n")
        else:
            parts.append(f"{_describe_effect_value(effect.name)}\n")
    for title, kinds in (
        ("Loads", LOADS),
        ("Position references", POSITIONS),
        ("Stiffness references", STIFFNESSES),
    ):
        parts.append(f"## {title}\n")
        for kind in kinds:
            name = kind.model_fields["kind"].default
            parts.append(
                f'### `svsa.{kind.__name__}`\n\nIn REST and files `kind = "{name}"`.'
                f" {_get_summary(kind)}\n\n{format_fields(kind)}\n"
            )
    return "\n".join(parts)


def _describe_effect_value(name: str) -> str:
    """Meaning, unit and default of an effect that is one number."""
    declared = read_quantity(Effects, name)
    unit = f", {declared.unit}" if declared.unit not in ("", "1") else ""
    return f"{declared.meaning}{unit}. Default: {Effects.model_fields[name].get_default()}."


def write_parameters() -> str:
    """Parameters of actuator, limits, gains and control laws."""
    parts = [
        "# Parameters\n",
        "Fields of a parameter file (TOML), of the library's models and of REST."
        " `svsa.read_design` reads a file.\n",
        f"## Actuator\n\n{format_fields(ActuatorParameters)}\n",
        f"## Limits\n\n{format_fields(Limits)}\n",
        f"## Gains of FL and NDOBC\n\n{format_fields(Gains)}\n",
        "## Control laws\n\nLaws with parameters of their own, in the table `[parameters.NAME]`.\n",
    ]
    ranked = {row.law for row in load_published().rows}
    for name in list_law_names():
        if has_own_parameters(name):
            title, summary = get_title(name), get_law(name).summary
            page = f"[{title}](../../laws/{name}.md)" if name in ranked else f"{title}: {summary}"
            fields = format_fields(get_law(name).parameters)
            parts.append(f"### `{name}`\n\n{page}\n\n{fields}\n")
    return "\n".join(parts)


def write_bench_file() -> str:
    """The sections of a bench file."""
    sections: Mapping[str, type[BaseModel]] = {
        "bus": BusSettings,
        "motor1] and [motor2": MotorSettings,
        "deflection": DeflectionSettings,
        "home": HomeSettings,
        "timing": TimingSettings,
        "safety": SafetySettings,
        "design": DesignSettings,
        "emulator": EmulatorSettings,
    }
    parts = [
        "# Bench file\n",
        "One TOML file describes a bench: `svsa serve --bench FILE`. `svsa bench-check FILE` tests"
        " it step by step. A motor has further fields of its drive's family.\n",
    ]
    parts += [f"## `[{name}]`\n\n{format_fields(model)}\n" for name, model in sections.items()]
    return "\n".join(parts)


PAGES: dict[str, Callable[[], str]] = {
    "settings": write_settings,
    "channels": write_channels,
    "faults": write_faults,
    "kinds": write_kinds,
    "parameters": write_parameters,
    "bench_file": write_bench_file,
    "commands": write_commands,
    "rest": write_rest,
    "stream": write_stream,
}


def write_reference_pages(folder: Path) -> None:
    """Write every page into a folder; a page that did not change keeps its time stamp."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, write in PAGES.items():
        path, text = folder / f"{name}.md", write()
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
