"""`svsa.ActuatorEnv`: an environment of Gymnasium on the plant of a run."""

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import svsa


def play(env, seed):
    """Observations and rewards of an episode under an agent with random actions."""
    observation, _ = env.reset(seed=seed)
    env.action_space.seed(seed)
    rows, rewards, over = [observation], [], False
    while not over:
        action = 0.02 * env.action_space.sample()
        observation, reward, terminated, truncated, _ = env.step(action)
        rows.append(observation)
        rewards.append(reward)
        over = terminated or truncated
    return np.array(rows), rewards


@pytest.mark.filterwarnings("ignore::UserWarning:gymnasium")
def test_check_of_gymnasium_passes():
    check_env(svsa.ActuatorEnv("5", effects=svsa.RIG, duration_s=1.0))


def test_episode_ends_at_its_duration_and_is_determined_by_its_seed():
    noise = svsa.RIG.changed(noise={"motor_std_rad": 1e-4, "deflection_std_rad": 1e-4})
    env = svsa.ActuatorEnv("4a", effects=noise, loads=(), duration_s=0.2)
    rows, rewards = play(env, 1)
    assert len(rewards) == 20
    assert all(0.0 < reward <= 1.0 for reward in rewards)
    np.testing.assert_array_equal(play(env, 1)[0], rows)
    assert not np.array_equal(play(env, 2)[0], rows)


def test_action_is_a_share_of_the_torque_limits_held_for_the_period():
    env = svsa.ActuatorEnv("4a", loads=(), action_period_s=0.02)
    env.reset(seed=0)
    env.step(np.array([0.01, -0.005], np.float32))
    limits = env.stepper.torque_limits_nm
    assert env.stepper.sample.time_s == pytest.approx(0.019)
    assert env.stepper.sample.torque1_nm == pytest.approx(0.01 * limits.u1)
    assert env.stepper.sample.torque2_nm == pytest.approx(-0.005 * limits.u2)


def test_fault_terminates_the_episode_and_an_option_changes_the_next():
    env = svsa.ActuatorEnv("4a")
    env.reset(seed=0, options={"loads": ()})
    assert env.stepper.configuration.loads == ()
    terminated = False
    while not terminated:
        *_, terminated, _, info = env.step(np.array([1.0, 0.0], np.float32))
    assert "passed its limit" in info["fault"]
    with pytest.raises(svsa.ParameterError, match="action is"):
        env.step(np.array([2.0, 0.0], np.float32))
