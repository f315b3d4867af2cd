"""FMUs made by `pong fmu`, in FMPy: see ci/fmu.

    python ci/fmu.py PONG FOLDER
"""

import csv
import ctypes
import pathlib
import shutil
import subprocess
import sys
import time

import fmpy
import numpy as np
from fmpy import fmi2
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave
from fmpy.logging import addLoggerProxy
from fmpy.validation import validate_fmu

ROOT = pathlib.Path(__file__).resolve().parent.parent
TRIPOD = ROOT / "models/tripod/scene_drop.ron"
DOUBLES = ctypes.POINTER(ctypes.c_double)
DOCKING = ROOT / "models/idss_docking/scene_soft_capture.ron"


def run(*command):
    return subprocess.run([str(part) for part in command], check=True, capture_output=True, text=True).stdout


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def make(pong, scene, fmi, path, *options):
    run(pong, "fmu", scene, "-o", path, "--fmi", fmi, "--quiet", *options)
    problems = validate_fmu(str(path))
    expect(not problems, f"{path.name}: FMPy finds: {problems}")
    return path


def executive(pong, scene, folder):
    """States that `pong run` writes: {body: rows of time, position, quaternion}."""
    run(pong, "run", scene, "-o", folder, "--quiet")
    bodies = {}
    with open(folder / "states.csv", newline="") as file:
        rows = csv.reader(file)
        names = [name.split(" ")[0] for name in next(rows)]
        body = names.index("body")
        for row in rows:
            numbers = [float(row[0])] + [float(value) for value in row[body + 1 : body + 8]]
            bodies.setdefault(row[body], []).append(numbers)
    return {name: np.array(rows) for name, rows in bodies.items()}


def name_in_unit(body):
    """Name of a body in the unit: `chaser/ring/latch_0` in the tables of a run is `chaser.ring.latch_0`."""
    return body.replace("/", ".")


class Unit:
    """An unpacked FMU. Messages of all its instances are appended to `told`."""

    def __init__(self, path):
        self.path = path
        self.folder = pathlib.Path(fmpy.extract(str(path), unzipdir=str(path.with_suffix(""))))
        self.description = fmpy.read_model_description(str(path))
        self.fmi = int(self.description.fmiVersion[0])
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.told = []

    def instance(self, exchange, token=None):
        return Instance(self, exchange, token)


class Instance:
    """Common part of both versions and kinds."""

    def __init__(self, unit, exchange, token=None):
        kinds = {(2, True): FMU2Model, (2, False): FMU2Slave, (3, True): FMU3Model, (3, False): FMU3Slave}
        self.unit, self.exchange = unit, exchange
        kind = unit.description.modelExchange if exchange else unit.description.coSimulation
        self.fmu = kinds[unit.fmi, exchange](
            guid=token or unit.description.guid,
            unzipDirectory=str(unit.folder),
            modelIdentifier=kind.modelIdentifier,
            instanceName="one",
        )
        if unit.fmi == 2:
            self.callbacks = fmi2.fmi2CallbackFunctions()
            self.callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(
                lambda environment, name, status, category, message: unit.told.append(message.decode())
            )
            self.callbacks.allocateMemory = fmi2.defaultCallbacks.allocateMemory
            self.callbacks.freeMemory = fmi2.defaultCallbacks.freeMemory
            addLoggerProxy(ctypes.byref(self.callbacks))
            self.fmu.instantiate(callbacks=self.callbacks)
        else:
            self.fmu.instantiate(logMessage=lambda environment, status, category, text: unit.told.append(text.decode()))
        self.states = unit.description.numberOfContinuousStates
        self.x = np.zeros(self.states)
        self.rates = np.zeros(self.states)
        fmu, is_2 = self.fmu, unit.fmi == 2
        self.get_values, self.set_values = (fmu.getReal, fmu.setReal) if is_2 else (fmu.getFloat64, fmu.setFloat64)
        if exchange:
            self.get_rates = fmu.getDerivatives if is_2 else fmu.getContinuousStateDerivatives
            self.update = fmu.newDiscreteStates if is_2 else fmu.updateDiscreteStates

    def begin(self):
        if self.unit.fmi == 2:
            self.fmu.setupExperiment(startTime=0.0)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=0.0)
        self.fmu.exitInitializationMode()
        if self.exchange:
            self.event(enter=False)

    def event(self, enter=True):
        if enter:
            self.fmu.enterEventMode()
        expect(not self.update()[0], "an event that never ends")
        self.fmu.enterContinuousTimeMode()

    def get(self, *names):
        return list(self.get_values([self.unit.references[name] for name in names]))

    def set(self, name, value):
        self.set_values([self.unit.references[name]], [value])

    def pose(self, body):
        names = [f"{body}.position[{i}]" for i in (1, 2, 3)] + [f"{body}.orientation[{i}]" for i in (1, 2, 3, 4)]
        return np.array(self.get(*names))

    def trial(self, t, x):
        self.fmu.setTime(t)
        np.copyto(self.x, x)
        self.fmu.setContinuousStates(self.x.ctypes.data_as(DOUBLES), self.states)

    def derivatives(self):
        self.get_rates(self.rates.ctypes.data_as(DOUBLES), self.states)
        return self.rates.copy()

    def runge_kutta(self, first, last, h):
        """Classic Runge-Kutta, as in a fixed-step importer."""
        self.fmu.getContinuousStates(self.x.ctypes.data_as(DOUBLES), self.states)
        x = self.x.copy()
        for step in range(first, last):
            t = step * h
            a = self.derivatives()
            self.trial(t + h / 2, x + h / 2 * a)
            b = self.derivatives()
            self.trial(t + h / 2, x + h / 2 * b)
            c = self.derivatives()
            self.trial(t + h, x + h * c)
            x = x + h / 6 * (a + 2 * b + 2 * c + self.derivatives())
            self.trial((step + 1) * h, x)
            if self.fmu.completedIntegratorStep()[0]:
                self.event()

    def advance(self, first, last, h):
        if self.exchange:
            self.runge_kutta(first, last, h)
        else:
            for step in range(first, last, 10):
                self.fmu.doStep(currentCommunicationPoint=step * h, communicationStepSize=10 * h)

    def saved(self):
        state = self.fmu.getFMUState()
        data = self.fmu.serializeFMUState(state)
        self.fmu.freeFMUState(state)
        return bytes(data)

    def restore(self, data):
        state = self.fmu.deserializeFMUState(data)
        self.fmu.setFMUState(state)
        self.fmu.freeFMUState(state)


def compare_co_simulation(unit, scene_states, step, every, body_names):
    """Largest difference of any pose at any record, m or 1, of a run with the record interval as communication step."""
    one = unit.instance(exchange=False)
    one.begin()
    worst = 0.0
    rows = len(next(iter(scene_states.values())))
    for row in range(rows):
        if row > 0:
            # The communication point as in FMPy: a product, so that no error accumulates.
            one.fmu.doStep(currentCommunicationPoint=(row - 1) * every * step, communicationStepSize=every * step)
        for body in body_names:
            worst = max(worst, np.abs(one.pose(name_in_unit(body)) - scene_states[body][row][1:]).max())
    return worst


def refused(unit, action, told, what):
    unit.told.clear()
    try:
        action()
    except Exception:
        pass
    else:
        sys.exit(f"FAILED: {what}: not refused")
    expect(any(told in text for text in unit.told), f"{what}: the logger was told {unit.told}")


def tripod(pong, work, fmi):
    h, duration = 1e-4, 1.0
    unit = Unit(make(pong, TRIPOD, fmi, work / f"tripod{fmi}.fmu"))
    states = executive(pong, TRIPOD, work / "tripod")
    body = next(name for name in states if name.startswith("tripod"))
    size = unit.path.stat().st_size
    print(f"FMI {fmi}.0: valid; {size / 1e6:.2f} MB, {len(unit.references)} variables")

    apart = compare_co_simulation(unit, states, h, 10, list(states))
    expect(apart == 0.0, f"co-simulation is {apart} from `pong run`")
    result = fmpy.simulate_fmu(
        str(unit.path), fmi_type="CoSimulation", stop_time=duration, output_interval=1e-2, output=["tripod.position[3]"]
    )
    own = states[body][::10, 3]
    apart_there = np.abs(result["tripod.position[3]"] - own).max()
    print(f"  Co-Simulation: {apart} m from `pong run` at 1,001 instants; simulate_fmu of FMPy: {apart_there:.1e} m")
    # FMPy's communication points are sums; the steps are equal up to a relative 1e-6.
    expect(apart_there < 1e-12, "simulate_fmu goes elsewhere")

    one = unit.instance(exchange=True)
    one.begin()
    worst = 0.0
    for tenth in range(10):
        one.runge_kutta(tenth * 1000, (tenth + 1) * 1000, h)
        worst = max(worst, np.abs(one.pose("tripod") - states[body][(tenth + 1) * 100][1:]).max())
    print(f"  Model Exchange, Runge-Kutta 4: {worst:.1e} m from `pong run`")
    expect(worst < 1e-12, "Model Exchange goes elsewhere")
    result = fmpy.simulate_fmu(
        str(unit.path), fmi_type="ModelExchange", solver="CVode", stop_time=0.2, output_interval=1e-3,
        relative_tolerance=1e-9, output=["tripod.position[3]"], record_events=False,
    )
    worst = np.abs(result["tripod.position[3]"] - states[body][: len(result), 3]).max()
    print(f"  Model Exchange, CVode of FMPy: {worst:.1e} m")
    expect(worst < 1e-6, "CVode goes elsewhere")

    for exchange in (True, False):
        one = unit.instance(exchange)
        one.begin()
        one.advance(0, 500, h)
        expect(one.get("contact.count")[0] == 3, "saved out of contact")
        middle = one.saved()
        in_memory = one.fmu.getFMUState()
        one.advance(500, 1000, h)
        end = one.saved()
        one.fmu.setFMUState(in_memory)
        one.advance(500, 1000, h)
        expect(one.saved() == end, "rolled back, it goes elsewhere")
        other = unit.instance(exchange)
        other.restore(middle)
        other.advance(500, 1000, h)
        expect(other.saved() == end, "serialised, it goes elsewhere in another instance")
        refused(unit, lambda: other.restore(middle[:-8]), "damaged", "a state of other size")
    print(f"  saved in contact, rolled back and taken over by another instance: the same bits; {len(middle)} bytes")
    refusals(unit)

    # 10 kg: the impulse of a communication step is the mean contact force times the step.
    means = Unit(make(pong, TRIPOD, fmi, work / f"means{fmi}.fmu", "--step-means"))
    one = means.instance(exchange=False)
    one.begin()
    speed = one.get("tripod.state.velocity[3]")[0]
    one.fmu.doStep(0.0, 0.5)
    pushed = one.get("tripod.mean_contact_force[3]")[0] * 0.5
    gained = 10.0 * (one.get("tripod.state.velocity[3]")[0] - speed + 9.81 * 0.5)
    print(f"  mean force: {pushed:.9f} N s of contact in 0.5 s, {gained:.9f} by the momentum")
    expect(abs(pushed / gained - 1.0) < 1e-9, "the mean force is not momentum over the step")


def refusals(unit):
    one = unit.instance(exchange=False)
    one.begin()
    refused(unit, lambda: one.set("tripod.applied_force[1]", float("nan")), "give a finite number", "a force that is none")
    refused(unit, lambda: one.set("tripod.position[1]", 0.0), "cannot be set", "an output")
    refused(unit, lambda: one.fmu.doStep(5.0, 0.1), "begins at 5 s", "a step from elsewhere")
    refused(unit, lambda: one.fmu.doStep(0.0, 1e300), "give a shorter communication step", "a step without end")
    refused(unit, lambda: unit.instance(False, token="another"), "instantiation token", "another description")
    model = unit.folder / "resources/models/0/tripod.ron"
    text = model.read_text()
    model.write_text(text.replace("100000.0", "200000.0"))
    refused(unit, lambda: unit.instance(True), "tripod.ron: it has changed since the FMU was made", "another model")
    model.write_text(text)
    unit.instance(True)
    print("  refused by the logger: values, outputs, steps, tokens, a model that has changed, states of other size")


def docking(pong, work):
    """Two vehicles with 6 bodies, meshes of contacts and springs."""
    states = executive(pong, DOCKING, work / "docking")
    unit = Unit(make(pong, DOCKING, 3, work / "docking.fmu"))
    apart = compare_co_simulation(unit, states, 5e-4, 20, list(states))
    print(f"docking, Co-Simulation: {apart} m from `pong run` over 8 s")
    expect(apart == 0.0, "the docking goes elsewhere")


def main():
    pong, work = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    began = time.monotonic()
    for fmi in (2, 3):
        tripod(pong, work, fmi)
    docking(pong, work)
    print(f"FMPy {fmpy.__version__}: all as expected, {time.monotonic() - began:.0f} s")


main()
