"""A record contains its actuator, name and parameters, and is replayed exactly."""

import json

import pytest

import svsa
from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.runs.definition.command import Set
from svsa.runs.definition.configuration import Configuration
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.reader import open_record
from svsa.runs.records.resimulation import compare_with_simulation
from svsa.runs.session.simulated import SimulatedSession
from tests.actuators.members import STIFFNESS
from tests.exhaustive import exhaust

from .records import build_header

OTHERS = [name for name in list_mechanism_names() if name != "svsa"]


@pytest.mark.parametrize("name", exhaust(OTHERS, ["qbmove"]))
def test_record_names_its_actuator_and_is_replayed_exactly(name: str, catalogue: Catalogue):
    mechanism = get_mechanism(name)
    result = svsa.simulate(
        "4a",
        actuator=name,
        stiffness=STIFFNESS[name],
        position=0.01,
        loads=(),
        duration_s=0.01,
    )
    configuration = result.configuration
    session = SimulatedSession("test", configuration)
    written = configuration.model_dump(mode="json")
    header = build_header(lanes=("lane1",), configuration=written, seed=configuration.seed)
    recorder = catalogue.record(header)
    session.start_recording(recorder)
    session.step(300)
    softer = configuration.actuator.changed(link_inertia_kg_m2=0.017)
    session.change(Set("actuator", softer))
    session.step(300)
    session.stop_recording()
    catalogue.finish(header.run_id, recorder.close())
    record = open_record(catalogue.folder / "runs" / header.run_id)
    assert record.samples.shape[0] == 600
    found = record.header.configuration["actuator"]
    assert found == {"mechanism": name, **json.loads(mechanism.prototype.model_dump_json())}
    assert compare_with_simulation(record).identical


def test_record_without_an_actuator_is_of_the_svsa():
    written = svsa.paper.get_figure("4a").build_configuration().model_dump(mode="json")
    assert "mechanism" not in written["actuator"]
    found = Configuration(**written)
    assert type(found.actuator) is svsa.ActuatorParameters
    assert found.actuator.radius_m == written["actuator"]["radius_m"]
