"""Points are sent to the platform once, also after it was unavailable."""

import asyncio
import time
from pathlib import Path

import pytest

from svsa.teaching.course.criterion import CriterionResult
from svsa.teaching.course.progress import ProgressStore
from svsa.teaching.grading.grade import Grade
from svsa.teaching.grading.gradebook import Book
from svsa.teaching.submission import Submission, read_submission
from svsa_server.lti import scores
from svsa_server.lti.links import Link, Links
from svsa_server.lti.platforms import read_lti_file
from svsa_server.lti.scores import ScoreSender, build_scores_address
from svsa_server.lti.tool import LtiTool
from tests.server.access.classroom import run_class
from tests.server.lti.platform import CLIENT, ISSUER, read_audit, run_platform

PERSON = "p-1"


@pytest.fixture
def platform():
    with run_platform() as platform:
        yield platform


class Log:
    """The entries of the audit log."""

    def __init__(self) -> None:
        self.lines: list[dict] = []

    def write(self, **line: object) -> None:
        self.lines.append(line)


class Clock:
    """A clock that a test advances."""

    def __init__(self) -> None:
        self.now = time.time()

    def __call__(self) -> float:
        return self.now


class Class:
    """A class of one launched user with a submission and a grade."""

    def __init__(self, folder, platform) -> None:
        self.folder, self.log, self.clock = folder, Log(), Clock()
        self.settings = read_lti_file(platform.write_settings(folder))
        self.store, self.book = ProgressStore(folder), Book(folder / "course" / "book")
        self.link = Link(PERSON, "mechanism", ISSUER, CLIENT, "user-42", platform.line_item)
        self.platform, platform.clock = platform, self.clock

    def submit(self, answer: float = 0.7) -> Path:
        path = self.store.find_submission("mechanism", PERSON)
        path.parent.mkdir(parents=True, exist_ok=True)
        answers = {"predict-lever": answer}
        Submission(student="Ada", exercise="mechanism", answers=answers).write(path)
        return path

    def grade(self, points: float, answer: float = 0.7) -> None:
        path = self.submit(answer)
        one = CriterionResult(step="s", name="n", points=points, max_points=13.0, feedback="")
        self.book.keep(
            Grade(
                student="Ada", exercise="mechanism", submission=read_submission(path).digest,
                points=points, max_points=13.0, criteria=(one,),
            )
        )  # fmt: skip

    def send(self, times: int = 1) -> None:
        """A lab that starts, checks this many times, and ends."""

        async def look() -> None:
            tool = LtiTool(self.settings, self.folder)
            self.platform.read_keys = tool.list_keys
            tool.links.learn(self.link)
            sender = ScoreSender(tool, self.store, self.log, self.clock)
            for _ in range(times):
                await sender.send_due()
            await tool.client.aclose()

        asyncio.run(look())


@pytest.fixture
def class_(tmp_path, platform):
    return Class(tmp_path, platform)


def test_points_are_sent_once_and_logged(class_, platform):
    class_.send()
    assert platform.scores == []

    class_.grade(11.5)
    class_.send(2)
    class_.send()
    ((path, score),) = platform.scores
    assert path == "/items/3/lineitem/scores?type_id=1"
    assert score["userId"] == "user-42"
    assert (score["scoreGiven"], score["scoreMaximum"]) == (11.5, 13.0)
    assert (score["activityProgress"], score["gradingProgress"]) == ("Completed", "FullyGraded")
    assert score["timestamp"].endswith("+00:00")
    (line,) = class_.log.lines
    assert (line["person"], line["points"], line["problem"]) == (PERSON, 11.5, None)
    assert platform.problems == []


def test_unavailable_platform_is_retried_later_and_after_a_restart(class_, platform):
    class_.grade(11.5)
    platform.failures = 2
    class_.send(3)
    assert len(class_.log.lines) == 1
    assert "503" in class_.log.lines[0]["problem"]
    class_.clock.now += 31
    class_.send(3)
    assert len(class_.log.lines) == 2
    class_.clock.now += 61
    class_.send(3)
    assert [score["scoreGiven"] for _, score in platform.scores] == [11.5]
    assert class_.log.lines[-1]["problem"] is None


def test_retries_end_and_a_new_grade_is_sent_again(class_, platform, monkeypatch):
    monkeypatch.setattr(scores, "MAX_TRIES", 3)
    class_.grade(3.0)
    platform.failures = 3
    for _ in range(5):
        class_.send()
        class_.clock.now += 3601
    assert len(class_.log.lines) == 3
    assert "Given up" in class_.log.lines[-1]["problem"]
    class_.grade(12.0, answer=0.8)
    class_.send()
    assert [score["scoreGiven"] for _, score in platform.scores] == [12.0]


def test_expired_token_is_requested_again(class_, platform):
    async def look():
        tool = LtiTool(class_.settings, class_.folder)
        platform.read_keys = tool.list_keys
        tool.links.learn(class_.link)
        sender = ScoreSender(tool, class_.store, class_.log, class_.clock)
        class_.grade(3.0)
        await sender.send_due()
        platform.tokens.clear()
        class_.grade(4.0, answer=0.8)
        await sender.send_due()
        class_.clock.now += 31
        await sender.send_due()
        await tool.client.aclose()

    asyncio.run(look())
    assert [score["scoreGiven"] for _, score in platform.scores] == [3.0, 4.0]


def test_launch_with_another_line_item_sends_the_score_there(class_, platform):
    class_.grade(3.0)
    class_.send(2)
    class_.link = class_.link._replace(line_item=f"{platform.url}/items/4/lineitem")
    class_.send(2)
    assert [path for path, _ in platform.scores] == [
        "/items/3/lineitem/scores?type_id=1",
        "/items/4/lineitem/scores",
    ]
    assert [one.line_item for one in Links(class_.folder).list()] == [class_.link.line_item]


def test_score_address_keeps_the_query():
    assert build_scores_address("https://m.org/i/3?a=1") == "https://m.org/i/3/scores?a=1"
    assert build_scores_address("https://m.org/i/3/") == "https://m.org/i/3/scores"


def test_grades_of_the_instructor_are_sent(tmp_path, platform, monkeypatch):
    monkeypatch.setattr(scores, "POLL_S", 0.05)
    class_, platform.clock = Class(tmp_path, platform), time.time
    class_.submit()
    Links(tmp_path).learn(class_.link)
    with run_class(tmp_path, lti=str(platform.write_settings(tmp_path))) as room:
        instructor = room.log_in()
        platform.read_keys = lambda: instructor.get("/lti/keys").json()
        instructor.post("/api/v1/grades", json={"again": False}).raise_for_status()
        for _ in range(10_000):
            if noted := read_audit(tmp_path, "lti score"):
                break
            time.sleep(0.02)
        (student,) = instructor.get("/api/v1/grades").json()["students"]
    grade = student["submissions"][0]["grade"]
    assert [one["points"] for one in noted] == [grade["points"]]
    (score,) = (score for _, score in platform.scores)
    assert (score["scoreGiven"], score["scoreMaximum"]) == (grade["points"], grade["max_points"])
