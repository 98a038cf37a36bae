"""The installed drive families: the entry points `svsa.drives` of packages.

Families need python-can, an extra; therefore they are imported only when a motor's section is read.
"""

from collections.abc import Callable
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import TYPE_CHECKING, Any, TypeVar

from svsa.errors import ParameterError, SvsaError, Violation
from svsa.hardware.bench.settings import DEFAULT_DRIVE, MotorSettings
from svsa.hardware.drives.emulated import EmulatedMotor
from svsa.inputs.checked import Checked
from svsa.inputs.extras import require_extra
from svsa.inputs.nearest import suggest

if TYPE_CHECKING:
    from svsa.hardware.drives.drive import Drive, StopFrames
    from svsa.hardware.drives.family import DriveFamily

GROUP = "svsa.drives"
_Section = TypeVar("_Section", bound=Checked)


class DriveFamilyError(SvsaError):
    """A family of drives with a package that does not work."""


@cache
def _find_entries() -> dict[str, EntryPoint]:
    entries = entry_points(group=GROUP)
    return {name: next(iter(entries.select(name=name))) for name in sorted(entries.names)}


def list_drive_names() -> tuple[str, ...]:
    """The names of the families of drives that are installed."""
    return tuple(_find_entries())


@cache
def get_family(name: str) -> "DriveFamily":
    """Return a family of drives by its name.

    Raises:
        ParameterError: If no family of that name is installed.
        DriveFamilyError: If its package cannot be loaded.
    """
    entry = _find_entries().get(name)
    if entry is None:
        names = list_drive_names()
        bound = f"a family of drives that is installed here: {', '.join(names)}"
        bound += suggest(name, names)
        raise ParameterError(Violation("drive", name, "", bound))
    require_extra("bench")
    try:
        from svsa.hardware.drives.family import DriveFamily

        family = entry.load()
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
        raise DriveFamilyError(
            f"The drives {name} of {entry.module} do not load: {reason}"
        ) from None
    if not isinstance(family, DriveFamily) or family.name != name:
        raise DriveFamilyError(f"{entry.value} is not the family of drives {name}.")
    return family


def read_motor(section: Any) -> MotorSettings:
    """A motor's section of a bench file, as the family of its drive describes it."""
    if isinstance(section, MotorSettings):
        return section
    return _read_section(section, lambda family: family.settings)


def read_emulated_motor(section: Any) -> EmulatedMotor:
    """A motor's section of an emulator's file, as the family of its drive describes it."""
    if isinstance(section, EmulatedMotor):
        return section
    return _read_section(section, lambda family: family.emulated)


def _read_section(section: Any, choose: "Callable[[DriveFamily], type[_Section]]") -> _Section:
    """A section as the family of its drive describes it; names the family of a foreign field."""
    family = _find_family(section)
    fields = choose(family).model_fields
    foreign = {
        field: name
        for name in list_drive_names()
        for field in choose(get_family(name)).model_fields
        if field in section and field not in fields
    }
    if foreign:
        known = ", ".join(list_drive_names())
        raise ParameterError(
            *(
                Violation(
                    field,
                    section[field],
                    "",
                    f"omitted: it belongs to drive = {name!r}, and drive is {family.name!r}"
                    f" (known drives: {known})",
                )
                for field, name in foreign.items()
            )
        )
    return choose(family)(**section)


def _find_family(section: Any) -> "DriveFamily":
    if not isinstance(section, dict) or not all(isinstance(name, str) for name in section):
        raise ParameterError(Violation("", section, "", "a section with named fields"))
    name = section.get("drive", DEFAULT_DRIVE)
    if not isinstance(name, str):
        raise ParameterError(Violation("drive", name, "", "the name of a family of drives"))
    return get_family(name)


def build_drive(motor: MotorSettings, period_s: float, speed_max: float) -> "Drive":
    """Create the drive of a motor.

    Args:
        motor: Section of the motor in the bench file.
        period_s: Control period, s.
        speed_max: A speed that the motor never reaches, counts/s.

    Returns:
        The drive.
    """
    return get_family(motor.drive).build(motor, period_s, speed_max)


def build_stop(motor: MotorSettings) -> "StopFrames":
    """The frames that remove the torque of the drive of a motor."""
    return get_family(motor.drive).build_stop(motor)
