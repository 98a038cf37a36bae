"""Where and how the lab is served: read from SVSA_… variables, checked at the start."""

import ipaddress
import re
from pathlib import Path
from typing import Annotated

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
    """Deployment: SVSA_SECRET is the shared secret that everyone who uses the lab knows.

    SVSA_MAX_SESSIONS: private sessions at once. SVSA_MAX_SESSIONS_EACH: of one person of a class;
    the instructor has as many as there is room for. SVSA_IDLE_S: how long one lives unused, s.
    SVSA_CONTROL_S: how long control of a session outlives the last stream and call of whoever
    has it, s.
    SVSA_SILENCE_S: how long a client may take to send a request, or to read on and answer a ping,
    s; its connection ends then.
    SVSA_MAX_TUNINGS: tunings of laws that are worked at, one at a time, or wait.
    SVSA_MAX_STUDIES: studies that are worked at, one at a time, or wait.
    SVSA_MAX_FALSIFICATIONS: searches for what hurts a law that are worked at, or wait, likewise.
    SVSA_MAX_SUBMISSIONS: laws for the leaderboard that are measured, one at a time, or wait.
    SVSA_MAX_JOBS_EACH: jobs of one kind of one person of a class that run or wait; the instructor
    has a place of their own. SVSA_JOB_S: how long one of theirs may run, s.
    SVSA_MAX_EXPORTS: exports, replays, comparisons, maps and laws in the ranking that are worked at
    or wait.
    SVSA_PARAMETERS: the parameter file that figures and sessions start from; none is the paper's.
    SVSA_COURSE: folder with exercises of one's own, beside those of the package.
    SVSA_BENCH: the file of the bench that the shared session drives; none is a simulation.
    SVSA_LTI: the file that names the learning platforms of a class, docs/lti.md; none launch else.
    SVSA_CLASSROOM: whether people join with a name and a class code, and have roles.
    SVSA_IDLE_OPERATOR_S: how long whoever is in control in a class may give no command before it
    goes on to who waits, s.
    SVSA_QUOTA_MB: disk that runs and studies of one person of a class may take, MB.
    SVSA_JOINS, SVSA_CODES, SVSA_LOGINS: rate limits of a class, as "50/second": joins of an
    address (a class behind one router has one), wrong class codes of an address and name, wrong
    instructor tokens of an address. The right token is always accepted.
    SVSA_COMMANDS, SVSA_SESSIONS, SVSA_RUNS: likewise, commands, new sessions and new recordings of
    a person.
    SVSA_ROOT_PATH: the path under which a proxy has the lab, such as /svsa; it takes it off before
    it asks the lab.
    SVSA_HOSTS: names with commas between, under which others reach the lab, besides addresses and
    the names of this machine.
    """

    model_config = SettingsConfigDict(env_prefix="SVSA_", extra="ignore", frozen=True)

    secret: SecretStr | None = None
    max_sessions: int = Field(default=48, ge=0, le=1000)
    max_sessions_each: int = Field(default=4, ge=1, le=1000)
    idle_s: float = Field(default=600.0, ge=1)
    control_s: float = Field(default=15.0, ge=1)
    silence_s: float = Field(default=20.0, ge=1)
    max_exports: int = Field(default=10, ge=0, le=1000)
    max_tunings: int = Field(default=3, ge=0, le=100)
    max_studies: int = Field(default=3, ge=0, le=100)
    max_falsifications: int = Field(default=3, ge=0, le=100)
    max_submissions: int = Field(default=10, ge=0, le=100)
    max_jobs_each: int = Field(default=2, ge=1, le=100)
    job_s: float = Field(default=900.0, ge=1)
    bench: Path | None = None
    parameters: Path | None = None
    course: Path | None = None
    lti: Path | None = None
    classroom: bool = False
    idle_operator_s: float = Field(default=90.0, ge=1)
    hosts: str = ""
    root_path: str = ""
    quota_mb: float = Field(default=500.0, ge=0)
    joins: Rate = "300/minute"
    codes: Rate = "10/minute"
    logins: Rate = "20/minute"
    commands: Rate = "50/second"
    sessions: Rate = "20/minute"
    runs: Rate = "30/minute"

    @property
    def secret_text(self) -> str | None:
        """The secret, or None where none is set (an empty one is none)."""
        text = self.secret.get_secret_value() if self.secret else ""
        return text or None

    @property
    def host_names(self) -> frozenset[str]:
        """The names in `hosts`, in small letters."""
        return frozenset(name.strip().lower() for name in self.hosts.split(",") if name.strip())

    def check_root_path(self) -> None:
        """Raise `ParameterError` where it is no path."""
        if not _ROOT_PATH.fullmatch(self.root_path):
            bound = "a path that begins with / and does not end with one, such as /svsa"
            raise ParameterError(Violation("--root-path", self.root_path, "", bound))

    def choose_host(self, host: str) -> str:
        """The address for `host`; "auto" is every address, but only where not everyone gets in."""
        if host != "auto":
            return host
        return "0.0.0.0" if self.secret_text or self.classroom else "127.0.0.1"  # noqa: S104

    def check_exposure(self, host: str) -> None:
        """Raise `SecurityError` where strangers could reach a lab that keeps nobody out."""
        if self.classroom:
            if self.secret_text is not None:
                raise SecurityError(
                    "A class has a code and an instructor token of its own: leave out SVSA_SECRET,"
                    " or --class."
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
