"""Outcomes of the energy account under each integrator, and their predictions. Run by mechanisms/run.py, as a mechanism
is."""

from kit import mjcf, parameters_check, ron
from kit.machine import Machine
from kit.rows import Limit, Row

INTEGRATORS = ("Euler", "implicitfast", "RK4")
MASS, RADIUS, STIFFNESS, STEP = 1.0, 0.1, 2e4, 1e-3  # kg, m, N/m of contact, s: 44 steps in a period of the contact
SPRING, DAMPER = 400.0, 20.0  # N/m, N·s/m of the joint


def ball(integrator, joint="", drive="", height=2 * RADIUS, step=STEP, damping=0.0, gravity=0.0):
    """A ball on a joint along z over a plane."""
    sphere = ron.primitive("Sphere", "shell", center=(0, 0, 0), radius=RADIUS)
    plane = ron.primitive("Plane", "floor", normal=(0, 0, 1), offset=0)
    texts = [
        ron.model("ball", ron.elastic(STIFFNESS, damping), [sphere]),
        ron.model("ground", ron.rigid(), [plane]),
    ]
    extension = mjcf.contact_instance(
        {"ball": "text1", "ground": "text2"}, [("ball", "ground")], {"ground": "world"}, texts
    )
    body = (
        f'<body name="ball" pos="0 0 {height:g}"><joint name="z" type="slide" axis="0 0 1" {joint}/>'
        f'<inertial pos="0 0 0" mass="{MASS:g}" diaginertia="1 1 1"/></body>'
    )
    return Machine(mjcf.model("ball", extension, body, drive, step, integrator, (0, 0, -gravity)), ["ball", "world"])


def moving(made, place, speed):
    made.data.qpos[0], made.data.qvel[0] = place, speed
    made.start()
    return made


def kinetic(made):
    return 0.5 * MASS * made.speed("z") ** 2


def bounce(integrator):
    """Contact begins and ends within steps, with and without damping: the account still closes to rounding."""
    for damping in (0.0, 100.0):
        made = moving(ball(integrator, damping=damping, height=RADIUS + 1.3e-4), 0.0, -1.0)
        made.run(0.05)
        what = f"bounce, {damping:g} N s/m"
        yield Row(
            f"{what}: work of the contact is the change of ½mv²",
            made.ledger.work["contact"],
            kinetic(made) - 0.5 * MASS,
            1e-12,
            "J",
        )
        yield Limit(f"{what}: energy that does not close", made.ledger.open_share(), 1e-12)


def oscillator(integrator):
    """Semi-implicit steps create ½h·k·Δ(q·v) in a spring in any case; Runge–Kutta leaves a second-order error."""
    left = []
    for step in (STEP, STEP / 2):
        made = moving(
            ball(integrator, f'stiffness="{SPRING:g}" damping="{DAMPER:g}"', height=1.0, step=step), 0.05, 0.3
        )
        made.run(0.087)
        left.append(made.ledger.opened())
        predicted = 0.5 * step * SPRING * (made.joint("z") * made.speed("z") - 0.05 * 0.3)
    if integrator == "RK4":
        yield Row(
            "damped oscillator: half the step leaves of the energy that does not close", left[1] / left[0], 0.25, 0.02
        )
    else:
        yield Row("damped oscillator: energy made, ½h·k·Δ(q·v)", left[1], predicted, 1e-9, "J")
    made.run(1.0)
    held = 0.5 * SPRING * 0.05**2 + 0.5 * MASS * 0.3**2
    yield Row("at rest dampers have taken what was there", -made.ledger.work["dampers"], held, 1e-2, "J")


def motor(integrator):
    """A motor with a torque-speed line against a damper, from rest: Δ½mv² is the motor's work less the damper's."""
    drive = f"<actuator>{mjcf.motor('push', 'z', 20.0, 2.0)}</actuator>"
    made = ball(integrator, f'damping="{DAMPER:g}"', drive, height=1.0)
    made.start()
    made.data.ctrl[0] = 1.0
    made.run(0.5)
    steady = 20.0 / (DAMPER + 10.0)
    yield Row("a motor against a damper: speed, τ/(d + τ/v₀)", made.speed("z"), steady, 1e-6, "m/s")
    # ∫v² dt of v = steady·(1 − e^(−t/T)) over many T.
    settled = MASS / (DAMPER + 10.0)
    yield Row(
        "work of the damper, −d·∫v²",
        made.ledger.work["dampers"],
        -DAMPER * steady**2 * (0.5 - 1.5 * settled),
        1e-2,
        "J",
    )
    yield Limit("energy that does not close", made.ledger.open_share(), 1e-12)


def pushed(integrator):
    """A host's force on a body."""
    made = ball(integrator, height=1.0)
    made.start()
    made.data.xfrc_applied[made.model.body("ball").id, 2] = 5.0
    made.run(0.1)
    yield Row(
        "a force pushes for a time: work (F·t)²/2m",
        made.ledger.work["motors"],
        (5.0 * 0.1) ** 2 / (2 * MASS),
        1e-12,
        "J",
    )
    yield Limit("energy that does not close", made.ledger.open_share(), 1e-12)


def inserted(integrator, more=0.02):
    """Energy without a force: the account must show it."""
    made = moving(ball(integrator, damping=100.0, height=RADIUS + 1.3e-4), 0.0, -1.0)
    made.run(0.05)
    before = kinetic(made)
    made.data.qvel[0] += more
    made.run(0.01)
    yield Row(
        "speed is put in: energy that does not close is that", made.ledger.opened(), kinetic(made) - before, 1e-12, "J"
    )
    yield Limit("of what went through", made.ledger.open_share(), 1e-3, least=True)


def pendulums(integrator):
    """Two swinging arms with dampers, whose inertia depends on the pose."""
    left = []
    for step in (STEP, STEP / 2):
        made = Machine(arms(integrator, step), ["world", "low"])
        made.data.qpos[:] = (1.0, -2.0)
        made.start()
        made.run(0.5)
        left.append(made.ledger.open_share())
    order = 2 if integrator == "RK4" else 1
    yield Row("two pendulums: half the step leaves of what does not close", left[1] / left[0], 0.5**order, 0.1)
    if order == 2:
        yield Limit("two pendulums: energy that does not close", left[0], 1e-4)


def arms(integrator, step):
    point = ron.model(
        "tip", ron.elastic(STIFFNESS, 0.0), [ron.primitive("Sphere", "tip", center=(0, 0, 0), radius=0.01)]
    )
    plane = ron.model("ground", ron.rigid(), [ron.primitive("Plane", "floor", normal=(0, 0, 1), offset=-9)])
    extension = mjcf.contact_instance(
        {"ground": "text1", "low": "text2"}, [("ground", "low")], {"ground": "world"}, [plane, point]
    )
    rod = '<inertial pos="0 0 -0.2" mass="1" diaginertia="0.02 0.02 0.001"/>'
    inside = f'<body name="low" pos="0 0 -0.4"><joint name="low" axis="0 1 0" damping="0.05"/>{rod}</body>'
    world = f'<body name="high"><joint name="high" axis="0 1 0" damping="0.05"/>{rod}{inside}</body>'
    return mjcf.model("arms", extension, world, "", step, integrator, (0, 0, -9.81))


def account(integrator):
    yield from bounce(integrator)
    yield from oscillator(integrator)
    yield from motor(integrator)
    yield from pushed(integrator)
    yield from inserted(integrator)
    yield from pendulums(integrator)


def rows(thorough):
    for integrator in INTEGRATORS:
        yield f"account of energy, {integrator}", account(integrator)
    thrown = lambda speed: moving(ball("RK4", height=RADIUS), 0.0, -speed)  # noqa: E731
    yield "loads cases", parameters_check.rows(thrown, MASS, STIFFNESS)
