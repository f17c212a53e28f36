"""A run in this process, step by step."""

from . import _voussoir
from ._assembly import _first
from ._progress import bar_of, ended
from ._snapshot import Snapshot


class Simulation:
    """The stages of a case, one after the other, in this process; nothing is written.

    case      Case, or what Case() takes
    assembly  Assembly; None: that of the case. A dictionary without "bridge" uses this one
    threads   None: all that the machine has; fewer are used where the model is too small to share

    The results have the same bits as the program's, for any number of threads.
    """

    def __init__(self, case, *, assembly=None, threads=None):
        from ._case import Case
        if isinstance(case, dict) and "bridge" not in case and assembly is not None:
            case = Case(case, assembly=assembly)
        self.case = case if isinstance(case, Case) else Case(case)
        self.assembly = assembly if assembly is not None else self.case.assembly()
        self._run = _voussoir.Simulation(self.case._case, self.assembly,
                                         _first(threads, _voussoir.available_threads()))

    def run(self, until=None, *, on_sample=None, control=None, control_every=0.0, on_log=None, progress=False):
        """Runs what is left of the stages, or on to `until` s of simulated time. Returns 'finished' or 'stopped'.

        on_sample      function of a dictionary, called at every row of the history ([output] history_every): time (s),
                       stage (counted from 0), energies {name: J}, balance_error, base_displacement (m),
                       base_acceleration (m/s2), contacts (number of contacts found during the run), reactions
                       {group: (fx, fy, fz) in N}, accelerations (of the sensors, m/s2), and for quasi-static stages
                       multiplier, displacement (m), force (N). A true result stops the run there.
        control        function of this Simulation, called at the beginning of each stage with time and then every
                       `control_every` s of simulated time (0: at every time step). It may read the state.
                       It returns the forces that act until the next call: None for the same forces as before, or a
                       dictionary as for push().
        on_log         function of a line of text
        progress       True: a progress bar; or a function of a dictionary, see ProgressBar

        Other Python threads run meanwhile. Ctrl-C stops at the next time step and raises KeyboardInterrupt; an
        exception in a callback stops the run and is raised here. Either way the state stays as it is, and run() goes
        on from there. Raises RunError if the run fails, for example if it finds no equilibrium or a block moves faster
        than 1000 m/s.
        """
        def asked():
            forces = control(self)
            if forces is not None:
                self.push(forces)

        bar = bar_of(progress)
        try:
            return self._run._run(_first(until, -1.0), on_sample, asked if control else None, control_every, bar, on_log)
        finally:
            ended(bar)

    def push(self, forces):
        """Forces that act in addition to those of the case in all time steps from now on, until the next call.

        forces  {block: (fx, fy, fz)} in N, or {block: ((fx, fy, fz), (x, y, z))} with the point of the block, as built,
                on which it acts (else its centroid); {} ends them.

        They keep their direction and are no part of the case: a run that is to be repeated has to push them again.
        Raises InputError for a block that is fixed.
        """
        import numpy as np
        blocks = [int(b) for b in forces]
        values = [np.asarray(forces[b], dtype=float) for b in forces]
        centroids = self.assembly.centroids
        at = [v[1] if v.shape == (2, 3) else centroids[b] if 0 <= b < len(centroids) else (0.0, 0.0, 0.0)
              for b, v in zip(blocks, values)]
        first = [v[0] if v.shape == (2, 3) else v for v in values]
        for block, force in zip(blocks, first):
            if np.shape(force) != (3,):
                raise ValueError(f"the force on block {block} must be three numbers, in N.")
        self._run._push(blocks, np.array(first, dtype=float).reshape(-1, 3), np.array(at, dtype=float).reshape(-1, 3))

    # Views of the state, one row a body: writing into them is refused, and they show what the state is at any time.
    @property
    def pose(self):
        """View of the placements, shape (n, 7): displacement since the assembly (m), rotation (w, x, y, z).

        One row a body; body_of_block says which. Nothing is copied: the view changes as the run goes on.
        """
        return self._run.pose

    @property
    def velocity(self):
        """View of the velocities at the last half time step, shape (n, 3), m/s; rows as in pose."""
        return self._run.velocity

    @property
    def angular_momentum(self):
        """View of the angular momenta about the centroids at the last half time step, shape (n, 3), kg m2/s."""
        return self._run.angular_momentum

    @property
    def body_of_block(self):
        """Row of each block in the views, shape (n,)."""
        return self._run.body_of_block

    def snapshot(self):
        """The state now, joints too, in the assembly's order: a Snapshot."""
        return Snapshot(self._run._snapshot())

    @property
    def time(self):
        """Simulated time, s."""
        return self._run.time

    @property
    def time_step(self):
        """Time step, s; 0 before the first stage with time."""
        return self._run.time_step

    @property
    def end_time(self):
        """Simulated time at the end of all stages, s."""
        return self._run.end_time

    @property
    def steps(self):
        """Time steps so far."""
        return self._run.steps

    @property
    def threads(self):
        """Threads in use."""
        return self._run.threads

    @property
    def energy_error(self):
        """Largest error of the energy balance so far, share of its largest term."""
        return self._run.energy_error

    @property
    def state_hash(self):
        """Number of 64 bits over the whole state: equal where two states have the same bits."""
        return self._run.state_hash

    @property
    def equilibrium(self):
        """How the last equilibrium was found, in words."""
        return self._run.equilibrium

    @property
    def collapse(self):
        """Result of a collapse stage as a dictionary.

        found       whether equilibrium was lost
        multiplier  largest multiplier with an equilibrium
        above       smallest multiplier that was tried above it, at which equilibrium was lost
        curve       shape (k, 3): multiplier, displacement along the load and largest displacement, both in m
        mechanism   [{a, b (blocks), slides, place (m), opening, slip}]; opening and slip are shares of the largest
                    displacement
        account     result as a text
        """
        return self._run.collapse

    def __repr__(self):
        return f"<voussoir.Simulation at {self.time:g} of {self.end_time:g} s, {len(self.assembly)} blocks>"
