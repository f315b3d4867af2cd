"""The limit of stable contact, from the linearised arm: no contact engine and no simulation in it.

The state is angles and speeds of motors and links, the aim of the servos and the filtered force. Between two steps of
the servos the arm moves by the exact exponential of its linear equations; one period of the law is a matrix, and
contact is stable while its spectral radius is below one.
"""

import mujoco
import numpy as np

from kit.arm import dimensions as d
from kit.arm import kinematics


def exponential(matrix):
    """Exponential of a square matrix, by scaling and squaring of its series."""
    squarings = max(0, int(np.ceil(np.log2(max(1e-12, np.abs(matrix).sum(axis=1).max())))) + 4)
    scaled, total = matrix / 2.0**squarings, np.eye(len(matrix))
    term = total
    for order in range(1, 16):
        term = term @ scaled / order
        total = total + term
    for _ in range(squarings):
        total = total @ total
    return total


class Linear:
    """An arm in a posture that presses along `normal` (world) on a spring and damper, with the dead band exceeded."""

    def __init__(self, made, controller, normal, stiffness, damping):
        self.law, self.step = controller.law, made.step
        self.jacobian = controller.jacobian()
        self.along = normal @ self.jacobian[:3]  # rate of the tip along the normal for the rates of the joints
        self.normal, self.spring = normal, (stiffness, damping)
        full = np.zeros((made.model.nv, made.model.nv))
        mujoco.mj_fullM(made.model, made.data, full)
        self.links = full[np.ix_(controller.dofs + 1, controller.dofs + 1)]
        self.moved, self.pushed = self._arm()

    def _arm(self):
        """One step of motors and links under a constant motor torque: x = (motor, link, their speeds)."""
        gear, loss = np.diag(d.GEAR_STIFFNESS), np.diag(d.GEAR_DAMPING)
        pad = np.outer(self.along, self.along)
        stiff = np.block([[gear, -gear], [-gear, gear + self.spring[0] * pad]])
        damp = np.block([[loss, -loss], [-loss, loss + self.spring[1] * pad]])
        masses = np.block([[d.ROTOR * np.eye(7), np.zeros((7, 7))], [np.zeros((7, 7)), self.links]])
        back = np.linalg.inv(masses)
        whole = np.zeros((35, 35))
        whole[:14, 14:28] = np.eye(14)
        whole[14:28, :28] = -back @ np.hstack([stiff, damp])
        whole[14:28, 28:] = back[:, :7]
        # Sensor force: spring and damper, less the inertia of the tip, which acts sideways as well.
        self.felt = -d.TIP_MASS * self.jacobian[:3] @ whole[21:28, :28]
        self.felt[:, 7:14] -= self.spring[0] * np.outer(self.normal, self.along)
        self.felt[:, 21:28] -= self.spring[1] * np.outer(self.normal, self.along)
        grown = exponential(whole * self.step)
        return grown[:28, :28], grown[:28, 28:]

    def root(self, admittance):
        """The greatest eigenvalue of a period of the law, at this admittance, m/s for each N.

        The state: x, how far the aim has gone in three directions, the filtered force.
        """
        # Joint rates for one newton in each direction.
        ways = np.stack([kinematics.resolve(self.jacobian, rates, self.law.damping) for rates in np.eye(6)[:3]]).T
        share = 1.0 - np.exp(-self.law.period / self.law.filter)
        law = np.eye(34)
        law[31:, :28], law[31:, 31:] = share * self.felt, (1.0 - share) * np.eye(3)
        steps = round(self.law.period / self.step)
        roots = np.linalg.eigvals(np.linalg.matrix_power(self._servo(admittance * ways), steps) @ law)
        # The tip's sideways position affects nothing: two eigenvalues are one.
        roots = roots[np.abs(roots - 1.0) > 1e-6]
        return roots[np.abs(roots).argmax()]

    def _servo(self, ways):
        """Matrix of one step of servos and arm."""
        matrix = np.eye(34)
        matrix[28:31, 31:] = self.step * np.eye(3)
        torque = np.zeros((7, 34))
        torque[:, :7], torque[:, 14:21] = -d.SERVO_STIFFNESS * np.eye(7), -d.SERVO_DAMPING * np.eye(7)
        torque[:, 28:31] = d.SERVO_STIFFNESS * ways
        torque[:, 31:] = (d.SERVO_STIFFNESS * self.step + d.SERVO_DAMPING) * ways
        matrix[:28] = self.pushed @ torque
        matrix[:28, :28] += self.moved
        return matrix

    def limit(self):
        """Admittance at the limit of stable contact, by bisection."""
        low, high = 1e-6, 1e-1
        for _ in range(60):
            middle = np.sqrt(low * high)
            low, high = (middle, high) if abs(self.root(middle)) < 1.0 else (low, middle)
        return low
