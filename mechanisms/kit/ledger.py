"""Energy account of a machine: work of each kind of force in each step, as the integrator applied it."""

import mujoco
import numpy as np

EULER, RK4, IMPLICITFAST = (
    getattr(mujoco.mjtIntegrator, f"mjINT_{name}") for name in ("EULER", "RK4", "IMPLICITFAST")
)
WEIGHTS = {EULER: (1.0,), IMPLICITFAST: (1.0,), RK4: (1 / 6, 1 / 3, 1 / 3, 1 / 6)}  # of the stages of a step
MOTORS, CONTACT, DAMPERS, CONSTRAINTS = range(4)


def add_applied(model, data, forces):
    """Adds the wrenches applied by a host to bodies, as generalized forces."""
    for body in np.flatnonzero(data.xfrc_applied.any(axis=1)):
        applied = data.xfrc_applied[body]
        mujoco.mj_applyFT(model, data, applied[:3], applied[3:], data.xipos[body], body, forces)


class Ledger:
    """Energies in and out, J. `with ledger: mujoco.mj_step(model, data)` adds those of a step.

    What the bodies hold (motion, gravity, springs of joints and tendons) changes by the work of motors, contacts,
    dampers and constraints. `through` is the sum of the magnitudes of all of this work: what went through the machine.

    The work of a force in a step is its impulse, as the integrator applied it, times the mean of the velocities before
    and after. Where inertia is constant, the sum of these is the change of kinetic energy, to rounding, whatever the
    step and wherever in it a contact begins. So what does not close is energy that the integrator makes or loses in
    gravity, springs and turning inertias, and what is put in beside the forces. Under Runge–Kutta there is an error of
    the account in it, of second order in the step, where a spring and another force change in one step.
    """

    NAMES = ("motors", "contact", "dampers", "constraints")

    def __init__(self, model, data):
        self.model, self.data = model, data
        self._forces, self._before = np.zeros((len(self.NAMES), model.nv)), np.zeros(model.nv)
        self.work = dict.fromkeys(self.NAMES, 0.0)
        self.through = 0.0
        self.began_with = self._held()

    def opened(self):
        """Energy of the bodies not explained by the work, J."""
        return self._held() - self.began_with - sum(self.work.values())

    def open_share(self):
        """Imbalance relative to the energy transferred."""
        return abs(self.opened()) / self.through if self.through else 0.0

    def _held(self):
        mujoco.mj_energyPos(self.model, self.data)
        mujoco.mj_energyVel(self.model, self.data)
        return float(self.data.energy.sum())

    def __enter__(self):
        self._weights = WEIGHTS.get(self.model.opt.integrator)
        if self._weights is None:
            raise ValueError("the account of energy knows the integrators Euler, RK4 and implicitfast")
        self._before[:] = self.data.qvel
        self._forces[:] = 0.0
        self._stage = 0
        if len(self._weights) > 1:
            mujoco.set_mjcb_control(self._at_stage)

    def __exit__(self, failed, *_):
        if len(self._weights) > 1:
            mujoco.set_mjcb_control(None)
        if failed:
            return
        # The data now hold the last stage; a step of one stage has only this.
        if len(self._weights) == 1:
            self._passive(1.0)
        self._active(self._weights[-1])
        self._implicit(self.data.qvel - self._before)
        works = self.model.opt.timestep * (self._forces @ (0.5 * (self._before + self.data.qvel)))
        for name, work in zip(self.NAMES, works.tolist()):
            self.work[name] += work
            self.through += abs(work)

    def _at_stage(self, *_):
        """Callback of MuJoCo for the controls in each stage: passive forces are those of this stage by then, all others
        of the last."""
        if self._stage > 0:
            self._active(self._weights[self._stage - 1])
        self._passive(self._weights[self._stage])
        self._stage += 1

    def _passive(self, weight):
        d = self.data
        self._forces[CONTACT] += weight * (d.qfrc_passive - d.qfrc_spring - d.qfrc_damper)
        self._forces[DAMPERS] += weight * d.qfrc_damper
        if d.qfrc_applied.any():
            self._forces[MOTORS] += weight * d.qfrc_applied
        if d.xfrc_applied.any():
            pushed = np.zeros(self.model.nv)
            add_applied(self.model, d, pushed)
            self._forces[MOTORS] += weight * pushed

    def _active(self, weight):
        self._forces[MOTORS] += weight * self.data.qfrc_actuator
        self._forces[CONSTRAINTS] += weight * self.data.qfrc_constraint

    def _implicit(self, change):
        """Force change by the change of speed in the step, where the integrator includes it."""
        option = self.model.opt
        explicit = option.integrator == EULER and option.disableflags & mujoco.mjtDisableBit.mjDSBL_EULERDAMP
        if option.integrator == RK4 or explicit:
            return
        damped = -self.model.dof_damping * change
        self._forces[DAMPERS] += damped
        if option.integrator == IMPLICITFAST:
            self._forces[MOTORS] += self._derivative() @ change - damped

    def _derivative(self):
        """Derivative of all forces by the speeds, in MuJoCo's layout: rows of a sparse matrix."""
        m, matrix = self.model, np.zeros((self.model.nv, self.model.nv))
        for row, (first, count) in enumerate(zip(m.D_rowadr, m.D_rownnz)):
            matrix[row, m.D_colind[first : first + count]] = self.data.qDeriv[first : first + count]
        return matrix
