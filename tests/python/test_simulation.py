"""Runs in this process: mechanics, callbacks, views, bits."""

import gc
import signal
import threading
import time

import numpy as np
import pytest

import voussoir as vs

G = 9.81
AT_REST = {"stage": [{"kind": "gravity"}]}
RESTS_AND_SWAYS = {
    "bridge": {"generator": "wall", "length_blocks": 3, "courses": 3},
    "stage": [{"kind": "gravity"},
              {"kind": "motion", "duration": 0.4,
               "pulse": {"kind": "sine", "axis": "y", "amplitude": 6.0, "frequency": 4.0}}],
    "output": {"history_every": 0.01, "fields_every": 0.0}}


def resting(assembly, seconds=0.0, **more):
    stages = [{"kind": "gravity"}] + ([{"kind": "free", "duration": seconds}] if seconds else [])
    return vs.Simulation({"stage": stages, "damping": {"kind": "none"}, **more}, assembly=assembly, threads=1)


def test_a_block_sinks_by_its_weight_over_the_stiffness(stone_on_base):
    run = resting(stone_on_base)
    assert run.run() == "finished"
    sunk = run.snapshot().displacement[1, 2]
    np.testing.assert_allclose(sunk, -2000.0 * 0.5 * G / 1e9, rtol=1e-4)
    np.testing.assert_allclose(run.snapshot().joints["normal_traction"][0], -2000.0 * 0.5 * G, rtol=1e-4)
    assert "converged" in run.equilibrium


def test_bits_are_those_of_the_program_for_any_threads(tmp_path, program):
    import json
    file = tmp_path / "wall.toml"
    from voussoir._toml import dumps
    file.write_text(dumps(RESTS_AND_SWAYS))
    program("run", file, "-o", tmp_path / "run", "--no-pictures", "--quiet", "--threads", "1")
    expected = json.loads((tmp_path / "run" / "summary.json").read_text())["state_hash"]
    for threads in (1, 2):
        run = vs.Simulation(vs.Case(file), threads=threads)
        run.run()
        assert f"{run.state_hash:016x}" == expected
    # Also in pieces, looked at and with callbacks that do nothing.
    run = vs.Simulation(vs.Case(file), threads=2)
    assert run.run(until=0.1) == "stopped"
    run.run(on_sample=lambda sample: None, control=lambda run: None, control_every=0.03, progress=lambda p: None)
    assert f"{run.state_hash:016x}" == expected


def test_views_are_the_state_itself(stone_on_base):
    run = resting(stone_on_base, 0.2)
    pose, velocity = run.pose, run.velocity
    body = run.body_of_block[1]
    before = pose[body, 2]
    assert not pose.flags.owndata and not pose.flags.writeable
    with pytest.raises(ValueError):
        pose[0, 0] = 1.0
    run.run()
    assert pose[body, 2] != before
    np.testing.assert_array_equal(pose[run.body_of_block, :3], run.snapshot().displacement)
    np.testing.assert_array_equal(velocity[run.body_of_block], run.snapshot().velocity)
    assert pose.shape == (2, 7) and run.angular_momentum.shape == (2, 3)
    del run
    gc.collect()
    assert np.isfinite(pose).all()  # the view keeps what it shows


def test_samples_hold_what_the_history_does(stone_on_base):
    samples = []
    run = resting(stone_on_base, 0.05, output={"history_every": 0.01})
    run.run(on_sample=samples.append)
    times = [s["time"] for s in samples]
    np.testing.assert_allclose(np.diff(times[1:]), 0.01, atol=0.5 * run.time_step)  # a whole number of time steps
    assert samples[-1]["stage"] == 1
    assert samples[-1]["energies"]["kinetic"] < 1e-6
    assert abs(samples[-1]["balance_error"]) < 1e-6


def test_a_stop_condition_stops_and_the_run_goes_on(stone_on_base):
    run = resting(stone_on_base, 0.1, output={"history_every": 0.01})
    assert run.run(on_sample=lambda s: s["time"] >= 0.03) == "stopped"
    assert 0.03 - 1e-9 <= run.time < 0.05
    assert run.run() == "finished"
    assert run.time == pytest.approx(0.1, abs=run.time_step)


def test_a_force_pushes_as_newton_says(stone_on_base):
    """Until friction is reached the block vibrates on its tangential spring k: u = F/k (1 - cos wt); then it slides with
    a = (F - mu N) / m from the velocity that it has."""
    mass, mu, force, stiffness, end = 250.0, np.tan(np.radians(30.0)), 3000.0, 4e8 * 0.25, 0.1
    run = resting(stone_on_base, end, analysis={"time_step": 1e-4})
    run.run(until=0.0)
    run.push({1: ((force, 0.0, 0.0), (0.0, 0.0, 0.0))})  # at the base: it does not tip
    run.run()
    friction, omega = mu * mass * G, np.sqrt(stiffness / mass)
    slips = np.arccos(1 - friction / force) / omega
    expected = (friction / stiffness + force / stiffness * omega * np.sin(omega * slips) * (end - slips)
                + 0.5 * (force - friction) / mass * (end - slips) ** 2)
    np.testing.assert_allclose(run.snapshot().displacement[1, 0], expected, rtol=0.02)


def test_control_sees_the_state_and_sets_forces(stone_on_base):
    seen = []

    def control(run):
        seen.append(run.time)
        return {1: (100.0 * np.sin(50 * run.time), 0.0, 0.0)}

    run = resting(stone_on_base, 0.05)
    run.run(control=control, control_every=0.01)
    np.testing.assert_allclose(seen, 0.01 * np.arange(5), atol=run.time_step)
    assert run.energy_error < 1e-2


def test_what_is_pushed_wrongly_is_refused(stone_on_base):
    run = resting(stone_on_base, 0.05)
    run.run(until=0.0)
    with pytest.raises(vs.InputError, match="fixed"):
        run.push({0: (1, 0, 0)})
    with pytest.raises(vs.InputError, match="block 7"):
        run.push({7: (1, 0, 0)}, )
    with pytest.raises(ValueError, match="three numbers"):
        run.push({1: (1, 0)})
    with pytest.raises(vs.InputError, match="not finite"):
        run.push({1: (np.nan, 0, 0)})


@pytest.mark.parametrize("where", ["on_sample", "control", "progress", "on_log"])
def test_exceptions_of_callbacks_come_out(stone_on_base, where):
    def fail(*_):
        raise LookupError("of the callback")

    run = resting(stone_on_base, 0.05)
    with pytest.raises(LookupError, match="of the callback"):
        run.run(**{where: fail})
    assert run.run() == "finished"


def test_a_callback_cannot_run_the_simulation(stone_on_base):
    run = resting(stone_on_base, 0.05)
    with pytest.raises(vs.InputError, match="running already"):
        run.run(on_sample=lambda s: run.run())


def test_other_threads_run_meanwhile():
    stages = [{"kind": "gravity"}, {"kind": "free", "duration": 20.0}]  # some 0.5 s of computing
    run = vs.Simulation({**RESTS_AND_SWAYS, "stage": stages, "output": {"history_every": 1.0}}, threads=1)
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.002)

    other = threading.Thread(target=tick)
    other.start()
    run.run()
    count = len(ticks)
    done.set()
    other.join()
    assert count > 3


def test_ctrl_c_stops_at_the_next_time_step(stone_on_base):
    seconds = 1e6  # some 10^9 time steps: minutes on any machine
    output = {"history_every": 1000.0, "fields_every": 0.0, "checkpoint_every": 1000.0}
    run = resting(stone_on_base, seconds, output=output)
    before = signal.getsignal(signal.SIGINT)
    threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        run.run()
    assert time.monotonic() - begun < 20.0
    assert 0.0 < run.time < seconds
    assert signal.getsignal(signal.SIGINT) is before
    assert run.run(until=run.time + 0.01) == "stopped"


def test_a_run_that_fails_says_why():
    """A semicircular arch of less than 10.7 % of its radius cannot stand (Heyman)."""
    run = vs.Simulation({"bridge": {"generator": "arch", "thickness_ratio": 0.08, "embrace_angle": 180.0},
                         "stage": [{"kind": "gravity"}]}, threads=1)
    with pytest.raises(vs.RunError, match="equilibrium|moved|rest"):
        run.run()


def test_the_progress_bar_shows_stage_and_share(stone_on_base, capsys):
    run = resting(stone_on_base, 0.2)
    run.run(progress=True)
    shown = capsys.readouterr().err
    assert "gravity" in shown and "%" in shown and shown.endswith("\r")
