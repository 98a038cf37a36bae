"""Settings of the server, read from `SVSA_…` environment variables and checked at the start."""

import ipaddress
import re
import textwrap
from pathlib import Path
from typing import Annotated, Literal

from limits import parse
from pydantic import AfterValidator, Field, SecretStr
from pydantic_settings import BaseSettings, SettingsConfigDict

from svsa.errors import ParameterError, SecurityError, Violation

SHORTEST_SECRET = 8
_ROOT_PATH = re.compile(r"(/[\w.~-]+)*", re.ASCII)


def _check_rate(rate: str) -> str:
    parse(rate)
    return rate


Rate = Annotated[str, AfterValidator(_check_rate)]


class Settings(BaseSettings):
    """Deployment settings, each read from the environment variable `SVSA_` + its name.

    `docs/reference` contains the table that is generated from the descriptions.
    """

    model_config = SettingsConfigDict(env_prefix="SVSA_", extra="ignore", frozen=True)

    secret: SecretStr | None = Field(
        default=None,
        description="Shared secret of at least 8 characters that every user of the lab knows."
        " Required beyond loopback, except for a class",
    )
    max_sessions: int = Field(
        default=48, ge=0, le=1000, description="Maximum number of private sessions of the lab"
    )
    max_sessions_each: int = Field(
        default=4,
        ge=1,
        le=1000,
        description="Maximum number of private sessions of one student. The instructor has no"
        " limit",
    )
    max_connections: int = Field(
        default=600,
        ge=8,
        le=10_000,
        description="Maximum number of connections of one address. A class behind one router has"
        " one address: 60 students have up to 10 each",
    )
    idle_s: float = Field(
        default=600.0, ge=1, description="Time after which an unused private session ends, s"
    )
    control_s: float = Field(
        default=15.0,
        ge=1,
        description="Time from the last stream or call of its holder until a control lease expires,"
        " s",
    )
    silence_s: float = Field(
        default=20.0,
        ge=1,
        description="Time after which a silent client is disconnected, s: it does not complete its"
        " request, read the stream or answer a ping",
    )
    max_exports: int = Field(
        default=10,
        ge=0,
        le=1000,
        description="Maximum number of exports, replays, comparisons, maps and ranked runs that run"
        " or wait",
    )
    max_tunings: int = Field(
        default=3,
        ge=0,
        le=100,
        description="Maximum number of tunings that run (one at a time) or wait",
    )
    max_studies: int = Field(
        default=3,
        ge=0,
        le=100,
        description="Maximum number of studies that run (one at a time) or wait",
    )
    max_falsifications: int = Field(
        default=3,
        ge=0,
        le=100,
        description="Maximum number of falsifier searches that run (one at a time) or wait",
    )
    max_submissions: int = Field(
        default=10,
        ge=0,
        le=100,
        description="Maximum number of leaderboard submissions that run (one at a time) or wait",
    )
    max_jobs_each: int = Field(
        default=2,
        ge=1,
        le=100,
        description="Maximum number of jobs of one kind of one student that run or wait. One place"
        " is reserved for the instructor",
    )
    job_s: float = Field(
        default=900.0, ge=1, description="Maximum duration of a job of a student, s"
    )
    bench: Path | None = Field(
        default=None,
        description="Bench file (TOML) that the shared session drives. If not set, the shared"
        " session is a simulation",
    )
    parameters: Path | None = Field(
        default=None,
        description="Parameter file (TOML) from which figures and sessions start. If not set, the"
        " paper's parameters",
    )
    course: Path | None = Field(default=None, description="Folder with additional exercises")
    lti: Path | None = Field(
        default=None, description="File (TOML) with the learning platforms of a class"
    )
    classroom: bool = Field(
        default=False,
        description="Class: students join with a name and a class code, and have roles",
    )
    idle_operator_s: float = Field(
        default=90.0,
        ge=1,
        description="Time without a command after which the lease of a class passes to the next"
        " user who waits, s",
    )
    hosts: str = Field(
        default="",
        description="Host names, separated by commas, that the lab accepts in addition to"
        " addresses and the names of this machine",
    )
    root_path: str = Field(
        default="",
        description="Path under which a proxy serves the lab, such as /svsa. The proxy removes it"
        " from the requests",
    )
    quota_mb: float = Field(
        default=500.0,
        ge=0,
        description="Maximum disk space of the runs and studies of one student, MB",
    )
    disk_low_gb: float = Field(
        default=2.0, ge=0, description="Free disk space below which the lab reports a problem, GB"
    )
    log: Literal["text", "json"] = Field(
        default="text", description="Format of the log on standard error: text, or JSON lines"
    )
    joins: Rate = Field(
        default="300/minute",
        description="Maximum rate of joins from one address. A class behind one router has one"
        " address",
    )
    codes: Rate = Field(
        default="10/minute", description="Maximum rate of wrong class codes of one address and name"
    )
    logins: Rate = Field(
        default="20/minute",
        description="Maximum rate of wrong instructor tokens of one address. The right token is"
        " always accepted",
    )
    commands: Rate = Field(
        default="50/second", description="Maximum rate of commands of one student"
    )
    sessions: Rate = Field(
        default="20/minute", description="Maximum rate of new sessions of one student"
    )
    runs: Rate = Field(
        default="30/minute", description="Maximum rate of new recordings of one student"
    )

    @property
    def secret_text(self) -> str | None:
        """Return the secret; None if it is unset or empty."""
        text = self.secret.get_secret_value() if self.secret else ""
        return text or None

    @property
    def host_names(self) -> frozenset[str]:
        """The names in `hosts`, in lower case."""
        return frozenset(name.strip().lower() for name in self.hosts.split(",") if name.strip())

    def check_root_path(self) -> None:
        """Raise `ParameterError` if it is not a path."""
        if not _ROOT_PATH.fullmatch(self.root_path):
            bound = "a path that begins with / and does not end with one, such as /svsa"
            raise ParameterError(Violation("--root-path", self.root_path, "", bound))

    def choose_host(self, host: str) -> str:
        """Return the address of `host`; "auto" is every address only if authentication is
        required.
        """
        if host != "auto":
            return host
        return "0.0.0.0" if self.secret_text or self.classroom else "127.0.0.1"  # noqa: S104

    def check_exposure(self, host: str) -> None:
        """Raise `SecurityError` if other machines reach a lab without authentication."""
        if self.classroom:
            if self.secret_text is not None:
                raise SecurityError(
                    "A class has its own code and instructor token: remove SVSA_SECRET, or start"
                    " without --class."
                )
        elif self.secret_text is None:
            if not is_loopback(host):
                raise SecurityError(
                    f"Listening on {host} lets others in: serve a class with --class, set"
                    f" SVSA_SECRET to a shared secret of at least {SHORTEST_SECRET} characters, or"
                    " listen on 127.0.0.1."
                )
        elif len(self.secret_text) < SHORTEST_SECRET:
            raise SecurityError(
                f"SVSA_SECRET has {len(self.secret_text)} characters: it must have at least"
                f" {SHORTEST_SECRET}."
            )


def is_loopback(host: str) -> bool:
    """Whether a host name or address means this machine only."""
    if host.lower() == "localhost":
        return True
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False


def write_example() -> str:
    """A file of environment variables with every setting, its meaning and its default."""
    lines = ["# Settings of the lab. Remove the # before a setting to change it."]
    for name, field in Settings.model_fields.items():
        default = "" if field.default is None else field.default
        lines += [
            "",
            *textwrap.wrap(
                field.description or "", 98, initial_indent="# ", subsequent_indent="# "
            ),
        ]
        lines.append(f"#SVSA_{name.upper()}={str(default).lower()}")
    return "\n".join(lines) + "\n"
