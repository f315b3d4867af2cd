"""Campaigns on Dask: runs are tasks of workers; the process that began the campaign writes their results."""

import contextlib
import sys
import time

import pong

from . import _case, _dispersions
from ._errors import CampaignError
from ._plan import Plan
from ._stops import Beyond
from ._store import Store

# Tasks queued on a worker beside the running one: enough that it never waits for the network.
TASKS_AHEAD = 3


def job_of(plan, digest=None, scene_hash=None):
    """Data of a plan that a worker needs."""
    entry = plan.to_json()
    keys = ("scene", "step", "integrator", "duration", "criteria", "stops", "look_every", "pivots")
    job = {key: entry[key] for key in keys} | {"alternative": plan.alternative, "parameters": plan.parameters, "scene_hash": scene_hash}
    try:
        job["digest"] = _case.read(plan.scene)[1] if digest is None else digest
    except (OSError, UnicodeDecodeError) as reason:
        raise CampaignError(f"scene `{plan.scene}`: it cannot be read: {reason}; name a scene file that can be read") from None
    return job


def checked(plan):
    """Job of a plan, with all of its names resolved."""
    job = job_of(plan)
    simulation = _case.build(job)
    job["scene_hash"] = simulation.scene_hash
    bodies = simulation.bodies
    named = [(f"criterion `{criterion.name}`", criterion) for criterion in plan.criteria]
    named += [(f"stop `{stop.name}`", stop) for stop in plan.stops if isinstance(stop, Beyond)]
    for thing, entry in named:
        for name in (entry.body, entry.of):
            if name not in bodies:
                raise CampaignError(f"{thing}: there is no body `{name}`; name one of: {', '.join(bodies)}")
    for name in plan.pivots:
        if name not in {body.split("/")[0] for body in bodies}:
            raise CampaignError(f"pivot of `{name}`: there is no such Object; name one of: {', '.join(bodies)}")
    try:
        _case.apply(simulation, job, [0.5 * sum(dispersion.ends()) for dispersion in plan.dispersions])
    except CampaignError:
        raise
    except pong.PongError as reason:
        raise CampaignError(f"dispersions: the scene refuses their middle: {reason}") from None
    return job


def run(plan, folder, *, workers=None, scheduler=None, runs_per_task=1, progress=True):
    """Runs a campaign, or its remaining runs, into a folder. Runs that fail are kept apart and do not end it.

    Parameters
    ----------
    plan : Plan
        Plan of the campaign; for remaining runs, the same as before.
    folder : path_like
        Folder of the results.
    workers : int, optional
        Processes that are started on this machine; by default one for each core.
    scheduler : str, optional
        Address of a Dask cluster, instead of processes on this machine.
    runs_per_task : int, default 1
        Runs that a worker takes at once.
    progress : bool, default True
        Prints the progress.

    Returns
    -------
    pyarrow.Table
        Rows of all completed runs, as `results` gives them.

    Raises
    ------
    CampaignError
        The plan, the scene or the folder cannot be used.
    """
    store = Store(folder)
    if not isinstance(plan, Plan):
        raise CampaignError(f"plan: it is {type(plan).__name__}; give a pong.campaign.Plan")
    workers, runs_per_task = map(_dispersions.number, (workers, runs_per_task))
    for thing, given in (("workers", 1 if workers is None else workers), ("runs_per_task", runs_per_task)):
        if not (isinstance(given, int) and given >= 1):
            raise CampaignError(f"{thing}: it is {given!r}; give a whole number from 1 up")
    with contextlib.ExitStack() as stack:
        perform(plan, store, plan.runs, lambda: stack.enter_context(client(workers, scheduler)), runs_per_task, progress)
    return store.table()


def perform(plan, store, count, connect, runs_per_task, progress):
    """Runs the unfinished ones of the first runs of a plan. `connect` returns a client, and is called if there are any."""
    job = checked(plan)
    with store.locked():
        store.begin(plan, job, pong.__version__)
        values = _dispersions.values(plan)
        done = store.done()
        left = [index for index in range(count) if index not in done]
        tasks = [left[first : first + runs_per_task] for first in range(0, len(left), runs_per_task)]
        bar = Progress(count, count - len(left), len(store.failures())) if progress else None
        if tasks:
            connected = connect()
            refuse_unless_ready(connected, job)
            for rows in finished(connected, job, tasks, values):
                store.add(rows)
                if bar:
                    bar.count(rows)
        if bar:
            bar.end()


@contextlib.contextmanager
def client(workers, scheduler):
    """A client of an existing cluster, or of a local one that ends with the campaign."""
    from dask.distributed import Client, LocalCluster

    if scheduler is not None:
        try:
            connected = Client(scheduler, set_as_default=False)
        except (OSError, ValueError) as reason:
            raise CampaignError(f"scheduler `{scheduler}`: it does not answer: {reason}; name the address of a Dask scheduler") from None
        with connected, connected.as_current():
            yield connected
        return
    # One thread each: a run keeps a core busy.
    options = {"n_workers": workers, "threads_per_worker": 1, "dashboard_address": None, "processes": True}
    with LocalCluster(**options) as cluster, Client(cluster, set_as_default=False) as connected, connected.as_current():
        yield connected


def refuse_unless_ready(connected, job):
    """Checks that every worker has the same scene and models as this machine."""
    told = connected.run(_case.check, job, on_error="return")
    if not told:
        raise CampaignError("workers: the cluster has none; start some, or leave the scheduler out")
    problems = [str(problem) for problem in told.values() if problem is not None]
    if problems:
        raise CampaignError("the campaign cannot begin:\n  " + "\n  ".join(sorted(problems)))


def finished(connected, job, tasks, values):
    """Rows of tasks, as they arrive. The tasks of a worker that dies move to other workers."""
    from dask.distributed import KilledWorker, as_completed

    waiting = iter(tasks)
    running = {}

    def submit(indices):
        future = connected.submit(_case.outcomes, job, indices, values[indices], pure=False)
        running[future] = indices
        return future

    lanes = max(1, sum(connected.nthreads().values()))
    first = [submit(indices) for _, indices in zip(range(lanes * TASKS_AHEAD), waiting)]
    arriving = as_completed(first)
    for future in arriving:
        indices = running.pop(future)
        try:
            rows = future.result()
        except KilledWorker as reason:
            # The worker of these runs died repeatedly, so the runs are the likely cause.
            rows = [killed(job, index, values[index], reason) for index in indices]
        yield rows
        following = next(waiting, None)
        if following is not None:
            arriving.add(submit(following))


def killed(job, index, values, reason):
    row = {"run": index, **dict(zip(job["parameters"], map(float, values)))}
    return row | {"error": "KilledWorker", "message": f"every worker that ran it died: {reason}"}


def repeat(folder, index, *, log=None):
    """Repeats one run of a campaign in this process.

    Parameters
    ----------
    folder : path_like
        Folder of the campaign.
    index : int
        Number of the run.
    log : path_like, optional
        Folder for its response log.

    Returns
    -------
    dict
        Row of the run.

    Raises
    ------
    CampaignError
        The campaign has no such run, or its scene is another than before.
    """
    store = Store(folder)
    plan = store.plan()
    if not 0 <= index < plan.runs:
        raise CampaignError(f"run {index}: the campaign has runs 0 to {plan.runs - 1}; name one of them")
    digest, scene_hash = store.origin()
    job = job_of(plan, digest, scene_hash)
    return _case.outcome(job, index, _dispersions.values(plan)[index], log)


class Progress:
    """Progress of a campaign, in one line of standard error."""

    def __init__(self, total, done, failed):
        self.total, self.done, self.failed = total, done, failed
        self.begun, self.at_begin, self.told = time.monotonic(), done, 0.0

    def count(self, rows):
        self.done += len(rows)
        self.failed += sum("error" in row for row in rows)
        if time.monotonic() - self.told > 1.0:
            self.tell("\r")

    def tell(self, begin):
        self.told = time.monotonic()
        rate = (self.done - self.at_begin) / max(self.told - self.begun, 1e-9)
        print(
            f"{begin}{self.done} of {self.total} runs, {self.failed} failed, {rate:.2f} a second",
            end="" if begin else "\n",
            file=sys.stderr,
            flush=True,
        )

    def end(self):
        if self.told:
            print("\r", end="", file=sys.stderr)
        self.tell("")
