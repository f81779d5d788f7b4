"""The second simulator: six degrees of freedom, Fossen's forces on a rigid body of MuJoCo.

Equations: Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2021, chapters 3 to 6.
Ratios: the Otter of MSS and PythonVehicleSimulator (Fossen, MIT licence, vehicles/otter), whose
hull was measured; size, mass, speed, turn rate and drag are the vehicle's own. MuJoCo integrates
the rigid body; all that the water does is applied by `qfrc_applied`.
"""

import numpy as np

from planner_ft.simulation.fast import STEP, Floats, Vessel
from planner_ft.support.errors import PlannerError

SUBSTEPS = 5
WATER, GRAVITY = 1025.0, 9.81
ADDED = np.array([0.1, 1.5, 1.0, 0.2, 0.8, 1.7])
"""Added mass over mass, and added inertia over inertia (Otter)."""
GYRATION = np.array([0.4, 0.25, 0.25])  # radii of gyration over beam, length and length (Otter)
WATERPLANE, BLOCK = 0.75, 0.4  # coefficients of the hull (one pontoon of the Otter)
DAMPING = np.array([0.3, 0.2, 0.4])  # relative damping of heave, roll and pitch (Otter)
SWAY, LAG = 1.0, 0.1  # time constants in s of sway and of the thrusters (Otter)
STRIPS = 20
CROSS = 0.56  # cross-flow drag coefficient of a hull that is much wider than deep (Hoerner 1965)


class FossenSimulator:
    """B hulls with two thrusters in one MuJoCo model, in axes ahead, to port and up.

    Surge drag is the vehicle's and grows with the square of the speed so that full thrust gives its
    top speed; yaw drag is such that full opposed thrust gives its top turn rate. A run whose forces
    are not finite has a pose of NaN from then on, and the others go on.
    """

    def __init__(self, vessel: Vessel, runs: int) -> None:
        """Raises PlannerError without MuJoCo, and for a vehicle that is no such hull."""
        try:
            import mujoco
        except ImportError:
            hint = "pip install planner_ft[sim], or --simulator fast"
            raise PlannerError(f"--simulator mujoco: MuJoCo is not installed; {hint}") from None
        if vessel.drive != "differential":
            problem = "has a model of hulls with two thrusters, not of free drives"
            raise PlannerError(f"--simulator mujoco: {problem}; use --simulator fast")
        self.vessel, self.step_seconds, self._step = vessel, STEP, mujoco.mj_step
        self.hull = _Hull(vessel)
        self.model = mujoco.MjModel.from_xml_string(_model(self.hull, runs))
        self.data = mujoco.MjData(self.model)
        self.pose, self.twist = np.zeros((runs, 4)), np.zeros((runs, 4))
        self.thrust, self.broken = np.zeros((runs, 2)), np.zeros(runs, dtype=bool)

    def reset(self, pose: Floats) -> None:
        places = np.zeros((len(pose), 7))
        places[:, :2] = pose[:, :2]
        places[:, 3], places[:, 6] = np.cos(pose[:, 3] / 2), np.sin(pose[:, 3] / 2)
        self.data.qpos[:], self.data.qvel[:] = places.ravel(), 0.0
        self.thrust[:], self.broken[:] = 0.0, False
        self._read()

    def step(self, actuators: Floats, current: Floats, wind: Floats) -> None:
        dt = self.step_seconds / SUBSTEPS
        for _substep in range(SUBSTEPS):
            self.thrust += dt / LAG * (actuators - self.thrust)
            turn, velocity = self._rotations(), self.data.qvel.reshape(-1, 6)
            heave = self.data.qpos.reshape(-1, 7)[:, 2]
            force = self.hull.forces(heave, turn, velocity, self.thrust, current, wind)
            self.broken |= ~np.isfinite(force).all(axis=1)
            force[self.broken], velocity[self.broken] = 0.0, 0.0
            self.data.qfrc_applied[:] = force.ravel()
            self._step(self.model, self.data)
        self._read()

    def _rotations(self) -> Floats:
        """(B, 3, 3): body to world."""
        w, x, y, z = self.data.qpos.reshape(-1, 7)[:, 3:].T
        rows = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        return np.array(rows).transpose(2, 0, 1)

    def _read(self) -> None:
        turn, velocity = self._rotations(), self.data.qvel.reshape(-1, 6)
        yaw = np.arctan2(turn[:, 1, 0], turn[:, 0, 0])
        self.pose = np.column_stack([self.data.qpos.reshape(-1, 7)[:, :3], yaw])
        cosine, sine = np.cos(yaw), np.sin(yaw)
        east, north, climb = velocity[:, :3].T
        rate = np.einsum("ni,ni->n", turn[:, 2], velocity[:, 3:])
        ahead, aside = cosine * east + sine * north, cosine * north - sine * east
        self.twist = np.column_stack([ahead, aside, climb, rate])
        self.pose[self.broken], self.twist[self.broken] = np.nan, np.nan


class _Hull:
    """Masses, damping and restoring forces of a vessel about its centre of gravity."""

    def __init__(self, own: Vessel) -> None:
        self.own = own
        size = np.array([own.width, own.length, own.length])
        self.inertia = own.mass * (GYRATION * size) ** 2
        self.rigid = np.array([own.mass] * 3 + [*self.inertia])
        self.added = ADDED * self.rigid
        total = self.rigid + self.added
        volume, plane = own.mass / WATER, WATERPLANE * own.length * own.width
        self.draft = volume / (BLOCK * own.length * own.width)
        # The metacentric radii of the waterplane; the centre of gravity lies in it.
        radii = plane * np.array([own.width, own.length]) ** 2 / 12 / volume
        heights = radii - self.draft / 2
        self.restoring = WATER * GRAVITY * np.array([plane, *(volume * heights)])
        swinging = 2 * DAMPING * np.sqrt(self.restoring * total[2:5])
        surge, yaw = own.mass * own.drag[0], own.thrust * own.track / own.turn
        self.damping = np.array([surge, total[1] / SWAY, *swinging, yaw])
        self.square = max(0.0, 2 * own.thrust - surge * own.speed) / own.speed**2
        self.strips = (np.arange(STRIPS) + 0.5) / STRIPS * own.length - own.length / 2

    def forces(
        self,
        heave: Floats,
        turn: Floats,
        velocity: Floats,
        thrust: Floats,
        current: Floats,
        wind: Floats,
    ) -> Floats:
        """What is to be applied to rigid bodies (B, 6): N in the world's axes, N m in the body's.

        The water's mass resists acceleration, so the acceleration is solved for first:
        (M_RB + M_A) a = tau - C_RB v - C_A v_r - D v_r - g + M_A dv_c/dt.
        """
        spin = velocity[:, 3:]
        speed = np.einsum("nij,ni->nj", turn, velocity[:, :3])
        flow = np.einsum("nij,ni->nj", turn[:, :2], current)
        through = np.column_stack([speed - flow, spin])
        momentum = self.added * through
        force, ahead = np.zeros_like(through), thrust.sum(axis=1)
        force[:, 0], force[:, 4] = ahead, -self.draft * ahead  # under the keel
        force[:, 5] = (thrust[:, 1] - thrust[:, 0]) * self.own.track / 2
        over = wind - velocity[:, :2]
        pressed = self.own.windage * np.linalg.norm(over, axis=1)[:, None] * over
        pressed *= (np.linalg.norm(wind, axis=1) > 0)[:, None]
        force[:, :3] += np.einsum("nij,ni->nj", turn[:, :2], pressed)
        force -= self.damping * through + self._cross_flow(through)
        force[:, 0] -= self.square * np.abs(through[:, 0]) * through[:, 0]
        afloat = self.restoring[0] * heave[:, None] * turn[:, 2]  # weight less buoyancy
        force[:, :3] -= np.cross(spin, momentum[:, :3]) + afloat
        munk = np.cross(through[:, :3], momentum[:, :3])
        # As for the Otter: a yaw moment that nonlinear damping would have to balance.
        munk[:, 2] = 0.0
        force[:, 3:] -= munk + np.cross(spin, momentum[:, 3:])
        force[:, 3] -= self.restoring[1] * turn[:, 2, 1]
        force[:, 4] += self.restoring[2] * turn[:, 2, 0]
        force[:, :3] -= self.added[:3] * np.cross(spin, flow)
        carried = self.rigid[0] * np.cross(spin, speed), np.cross(spin, self.inertia * spin)
        centripetal = np.column_stack(carried)
        applied = self.rigid / (self.rigid + self.added) * (force - centripetal) + centripetal
        return np.column_stack([np.einsum("nij,nj->ni", turn, applied[:, :3]), applied[:, 3:]])

    def _cross_flow(self, through: Floats) -> Floats:
        """Drag of strips of the hull against water from the side, as (B, 6) that is taken off."""
        aside = through[:, 1:2] + self.strips * through[:, 5:6]
        width = self.own.length / STRIPS
        drag = 0.5 * WATER * CROSS * self.draft * width * np.abs(aside) * aside
        force = np.zeros_like(through)
        force[:, 1], force[:, 5] = drag.sum(axis=1), drag @ self.strips
        return force


def _model(hull: _Hull, runs: int) -> str:
    inertia = " ".join(f"{value:.6g}" for value in hull.inertia)
    inertial = f'<inertial pos="0 0 0" mass="{hull.own.mass:.6g}" diaginertia="{inertia}"/>'
    body = f"<body><freejoint/>{inertial}</body>"
    option = f'<option timestep="{STEP / SUBSTEPS}" gravity="0 0 0"/>'
    return f"<mujoco>{option}<worldbody>{body * runs}</worldbody></mujoco>"
