"""Which rows go to a worker at once: few while nobody knows how long one takes, then about half a second's worth."""

from collections.abc import Iterable, Mapping, Sequence

from exo.scenario import Value
from exo.sweep.store import Done
from exo.sweep.work import Chunk

#: What a chunk should take (s): long beside what a task costs, short beside what a kill may lose.
WANTED_S = 0.5
LARGEST = 256


class Queue:
    """Rows that still have to run."""

    def __init__(self, rows: Sequence[Mapping[str, Value]], done: Iterable[int]) -> None:
        there = set(done)
        self._rows = rows
        self._waiting = [i for i in range(len(rows)) if i not in there][::-1]
        self._seconds = 0.0
        self._counted = 0
        #: Rows that were given back: each goes alone, so that one that ends its process takes no other with it.
        self._alone: list[int] = []
        self._failed: dict[int, int] = {}

    def __len__(self) -> int:
        return len(self._waiting) + len(self._alone)

    def next(self) -> Chunk:
        """The next rows, none when none are left."""
        if self._alone:
            i = self._alone.pop()
            return [(i, self._rows[i])]
        size = 1
        if self._counted:
            size = max(1, min(LARGEST, round(WANTED_S * self._counted / max(self._seconds, 1e-9))))
        taken = [self._waiting.pop() for _ in range(min(size, len(self._waiting)))]
        return [(i, self._rows[i]) for i in taken]

    def learn(self, done: Sequence[Done]) -> None:
        """How long rows take."""
        # The first row of a worker opens the archives; a mean over all forgets it soon.
        self._seconds += sum(one.seconds for one in done)
        self._counted += len(done)

    def wait_again(self, chunk: Chunk) -> None:
        """Rows that were under way when the cluster was lost."""
        self._waiting += [i for i, _ in reversed(chunk)]

    def give_back(self, chunk: Chunk, *, attempts: int = 2) -> list[int]:
        """Rows whose worker is lost: they wait again, each alone. Returns those that have lost `attempts` workers."""
        lost = []
        for i, _ in chunk:
            alone = len(chunk) == 1
            self._failed[i] = self._failed.get(i, 0) + alone
            if self._failed[i] >= attempts:
                lost.append(i)
            else:
                self._alone.append(i)
        return lost
