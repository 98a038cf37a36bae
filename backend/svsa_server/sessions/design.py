"""Responses, stability, margins and initial states of a design, for `POST …/design`."""

import asyncio
from collections.abc import Sequence
from typing import Literal

import numpy as np

from svsa.analysis.design.attraction import (
    Cell,
    Map,
    StartOutcome,
    build_map,
    find_start_outcomes,
    order_cells,
)
from svsa.analysis.design.loop_noise import choose_sensing
from svsa.analysis.design.margins import compute_margins
from svsa.analysis.design.response import LoadResponse, simulate_load
from svsa.analysis.design.robustness import MAX_RATIO, MIN_RATIO
from svsa.analysis.design.sampled_loop import (
    FrequencyResponse,
    compute_disturbance_response,
    linearize_tick,
)
from svsa.analysis.design.stability import Stability, assess
from svsa.control.installed import get_law
from svsa.runs.definition.configuration import Configuration
from svsa_server.jobs.heavy_work import HeavyWork
from svsa_server.schemas.lab.stability import (
    FrequencyResponseState,
    LoadResponseState,
    MarginsState,
    RegionRequest,
    RegionState,
    ResponseState,
    StabilityState,
    StartOutcomeState,
)

LOAD_POINTS = 250


async def compute_load_response(configuration: Configuration, sigma: float) -> ResponseState:
    """Compute the error after the 3 kg, and for a sine on the link."""
    load = await asyncio.to_thread(simulate_load, configuration, sigma)
    response = await asyncio.to_thread(compute_disturbance_response, configuration, sigma)
    encoders = name_encoders(configuration)
    radius = response.radius
    if encoders == "rig":
        radius = await asyncio.to_thread(_compute_sensed_radius, configuration, sigma)
    return ResponseState(
        law=configuration.law,
        stiffness_nm_per_rad=sigma,
        load=_build_load(load),
        disturbance=_build_frequency(response) if response.is_stable else None,
        largest_pole=radius,
        encoders=encoders,
    )


async def compute_stability(
    work: HeavyWork, configuration: Configuration, sigma: float
) -> StabilityState:
    """Assess the linear loop about rest, where Theorem 1 holds."""
    stability, radius = await work.run(_assess, configuration, sigma)
    return _build_stability(configuration, sigma, stability, radius)


async def measure_margins(
    work: HeavyWork, configuration: Configuration, sigma: float
) -> MarginsState:
    """Compute the margins of any law: the sampled loop's tick about rest, linearized."""
    sensing = configuration.changed(effects=choose_sensing(configuration.effects))
    margins = await work.run(compute_margins, sensing, sigma)
    return MarginsState(
        law=configuration.law,
        stiffness_nm_per_rad=sigma,
        encoders=name_encoders(configuration),
        **margins.to_json(),
    )


async def map_attraction(
    work: HeavyWork, configuration: Configuration, sigma: float, request: RegionRequest
) -> RegionState:
    """Simulate a part of the map of initial states."""
    sensing = configuration.changed(effects=choose_sensing(configuration.effects))
    starts, end = build_map(request.starts, request.chosen), request.first + request.count
    cells = order_cells(request.starts)[request.first : end]
    outcomes = await work.run(_find_part, sensing, sigma, starts, cells)
    return RegionState(
        law=configuration.law,
        chosen=request.chosen,
        stiffness_nm_per_rad=sigma,
        encoders=name_encoders(configuration),
        positions_rad=starts.positions.tolist(),
        velocities_rad_per_s=starts.velocities.tolist(),
        outcomes=[
            StartOutcomeState(**cell._asdict(), **result._asdict()) for cell, result in outcomes
        ],
        next=end if end < request.starts**2 else None,
    )


def _assess(configuration: Configuration, sigma: float) -> tuple[Stability, float]:
    return assess(configuration, sigma), _compute_sensed_radius(configuration, sigma)


def _compute_sensed_radius(configuration: Configuration, sigma: float) -> float:
    sensing = configuration.changed(effects=choose_sensing(configuration.effects))
    return linearize_tick(sensing, sigma).radius


def _find_part(
    configuration: Configuration, sigma: float, starts: Map, cells: Sequence[Cell]
) -> list[tuple[Cell, StartOutcome]]:
    return list(find_start_outcomes(configuration, sigma, starts, cells))


def name_encoders(configuration: Configuration) -> Literal["session", "rig"]:
    """Return whose encoders `choose_sensing` selects: the session's, or the rig's."""
    return "session" if configuration.effects.encoders is not None else "rig"


def _build_load(response: LoadResponse) -> LoadResponseState:
    stride = max(1, len(response.time) // LOAD_POINTS)
    return LoadResponseState(
        time_s=response.time[::stride].tolist(),
        position_error_rad=response.error[::stride].tolist(),
        peak_error_rad=float(np.max(np.abs(response.error), initial=0.0)),
        fault=response.fault,
    )


def _build_frequency(response: FrequencyResponse) -> FrequencyResponseState:
    return FrequencyResponseState(
        frequency_hz=response.frequency.tolist(), magnitude_rad_per_nm=response.magnitude.tolist()
    )


def _build_stability(
    configuration: Configuration, sigma: float, stability: Stability, radius: float
) -> StabilityState:
    loop, gain = stability.loop, stability.gain
    return StabilityState(
        law=configuration.law,
        stiffness_nm_per_rad=sigma,
        poles_rad_per_s=loop.poles.tolist(),
        slowest_rad_per_s=loop.slowest,
        least_damping=loop.least_damping,
        largest_pole=radius,
        ranges=stability.ranges,
        least_ratio=MIN_RATIO,
        greatest_ratio=MAX_RATIO,
        ramp_gain_rad_s_per_nm=gain.ramp,
        l1_gain_rad_s_per_nm=gain.l1,
        formula_rad_s_per_nm=stability.formula,
        floor_rad_s_per_nm=stability.floor,
        is_observed=get_law(configuration.law).estimate == "observer",
        fastest_observer_rad_per_s=stability.fastest_observer,
        encoders=name_encoders(configuration),
    )
