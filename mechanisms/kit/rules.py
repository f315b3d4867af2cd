"""Rules for every mechanism, as rows of its outcome, and a tally of the rules that a run has checked."""

from kit.rows import Fact, Limit

CLOSES, REACTS = 1e-3, 1e-9
# Rules, and the words in their rows; `honest` below makes those of the first three.
ENERGY, REACTIONS, TUNNELLING = (
    "energy that does not close, of what went through",
    "forces that have no reaction, of the greatest",
    "no contact tunnelled, no limit was met",
)
WORDS = {
    "energy": ENERGY,
    "reactions": REACTIONS,
    "tunnelling": TUNNELLING,
    "half the step": "half the step",
    "restart": "restarted",
}


def honest(*machines):
    """Rules for every run with accounts, at every level: energy, reactions, no tunnelling."""
    yield Limit(ENERGY, max(made.ledger.open_share() for made in machines), CLOSES)
    yield Limit(REACTIONS, max(made.imbalance for made in machines), REACTS)
    yield Fact(TUNNELLING, not any(made.flags for made in machines))


class Tally:
    """Counts the rows of a run."""

    def __init__(self):
        self.rows = {rule: [] for rule in WORDS}

    def watch(self, title, rows):
        for row in rows:
            for rule, words in WORDS.items():
                if words in f"{title}: {row.what}":
                    self.rows[rule].append(row)
            yield row

    def missing(self):
        return [rule for rule, rows in self.rows.items() if not rows]

    def lines(self):
        """One line per rule: number of rows, number that hold, and the largest value of limits."""
        for rule, rows in self.rows.items():
            held = sum(row.holds for row in rows)
            values = [row.measured for row in rows if isinstance(row, Limit) and rule in ("energy", "reactions")]
            most = f", {max(values):.2g} at most" if values else ""
            yield f"rule {rule}: " + (f"{held} of {len(rows)} rows hold{most}" if rows else "no row")
