"""A student who completes an exercise over the public API."""

from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.steps import Experiment, Explain, Predict
from tests.lab import Lab
from tests.waiting import wait_until

COURSE = "/api/v1/course"
WAIT_TICKS = 10_000


def find_law(exercise: Exercise) -> str:
    """Return the law in the text of an exercise."""
    return exercise.steps[-1].text.partition("```python\n")[2].partition("```")[0]


class Student:
    """Works in a private paused session, which does not wait for real time."""

    def __init__(self, lab: Lab, exercise: Exercise) -> None:
        self.client, self.exercise = lab.client, exercise
        self.path = f"{COURSE}/{exercise.name}"
        arms = {one.arm for one in exercise.steps if isinstance(one, Experiment)} - {""}
        wanted = {"from": "arm", "arm": arms.pop()} if arms else {}
        begun = self.client.post("/api/v1/sessions", json=wanted).raise_for_status().json()
        self.session = f"/api/v1/sessions/{begun['session']}"

    def read(self) -> dict:
        return self.client.get(self.path).raise_for_status().json()

    def answer(self, step: str, answer: float | str):
        return self.client.put(f"{self.path}/steps/{step}/answer", json={"answer": answer})

    def set_up(self, step: str):
        wanted = {"exercise": self.exercise.name, "step": step}
        return self.client.post(f"{self.session}/experiment", json={"from": "exercise"} | wanted)

    def restore(self):
        return self.client.post(f"{self.session}/experiment", json={"from": "before_exercise"})

    def run(self, step: str, duration_s: float) -> str:
        """Reset as the page does, record and run; return the id of the run."""
        self.post("reset")
        state = self.post("recording", {"name": step})
        run_id = state["recording"]["run_id"]
        end = round(duration_s * state["rate_hz"])
        while state["tick"] < end and state["status"] != "fault":
            state = self.post("step", {"ticks": min(WAIT_TICKS, end - state["tick"])})
        self.client.delete(f"{self.session}/recording").raise_for_status()
        self.wait(run_id)
        return run_id

    def wait(self, run_id: str) -> None:
        def is_finished() -> bool:
            found = self.client.get(f"/api/v1/runs/{run_id}")
            return found.is_success and found.json()["state"] != "recording"

        wait_until(is_finished)

    def check(self, step: str, run: str):
        return self.client.post(f"{self.path}/steps/{step}/check", json={"run_id": run})

    def try_law(self, text: str):
        return self.client.put(f"{self.path}/law", json={"text": text})

    def submit(self):
        return self.client.post(f"{self.path}/submission", json={"student": "Ada"})

    def change(self, step: str, changes: dict[str, dict]) -> None:
        """Change settings of the student, by their path below the session."""
        for path, body in changes.items():
            self.client.put(f"{self.session}/{path}", json=body).raise_for_status()

    def complete(self, answers: dict, changes: dict[str, dict[str, dict]]) -> dict:
        """Complete the exercise from the first step to the submission, and return the
        assessment.
        """
        for step in self.exercise.steps:
            self.client.put(f"{self.path}/place", json={"step": step.name}).raise_for_status()
            if isinstance(step, Predict | Explain):
                self.answer(step.name, answers[step.name]).raise_for_status()
            elif isinstance(step, Experiment):
                self.set_up(step.name).raise_for_status()
                self.change(step.name, changes.get(step.name, {}))
                run = self.run(step.name, step.duration_s)
                self.check(step.name, run).raise_for_status()
        if self.exercise.takes_law:
            self.try_law(find_law(self.exercise)).raise_for_status()
        return self.submit().raise_for_status().json()

    def post(self, path: str, body: dict | None = None) -> dict:
        return self.client.post(f"{self.session}/{path}", json=body).raise_for_status().json()
