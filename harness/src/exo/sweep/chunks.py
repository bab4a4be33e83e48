"""Which rows go to a worker at once: few while nobody knows how long one takes, then about half a second's worth.

Towards the end they become fewer again, so that all workers end at about the same time: a last chunk of half a second
is time in which every other worker has nothing to do.
"""

from collections.abc import Iterable, Mapping, Sequence

from exo.scenario import Value
from exo.sweep.store import Done
from exo.sweep.work import Chunk

#: What a chunk should take (s): long beside what a task costs, short beside what a kill may lose.
WANTED_S = 0.5
LARGEST = 2048
#: Shortest chunk of the last ones (s): it still is long beside what a task costs, on a cluster, too.
SHORTEST_S = 0.02


class Queue:
    """Rows that still have to run."""

    def __init__(self, rows: Sequence[Mapping[str, Value]], done: Iterable[int]) -> None:
        there = set(done)
        self._rows = rows
        self._waiting = [i for i in range(len(rows)) if i not in there][::-1]
        self._seconds = 0.0
        self._counted = 0
        #: Rows that were under way when a process ended: one of them ended it.
        self._suspects: list[int] = []
        self._ended: dict[int, int] = {}
        #: Whether the chunk that was taken last is one of those.
        self._alone = False

    def __len__(self) -> int:
        return len(self._waiting) + len(self._suspects)

    @property
    def alone(self) -> bool:
        """Whether the next row runs alone."""
        return bool(self._suspects)

    def next(self, among: int = 1) -> Chunk:
        """The next rows, none when none are left; `among` is how many workers share them."""
        self._alone = self.alone
        if self._alone:
            i = self._suspects.pop()
            return [(i, self._rows[i])]
        size = 1
        if self._counted:
            a_second = self._counted / max(self._seconds, 1e-9)
            share = max(len(self._waiting) / (2 * among), SHORTEST_S * a_second)
            size = max(1, min(LARGEST, round(min(WANTED_S * a_second, share))))
        taken = [self._waiting.pop() for _ in range(min(size, len(self._waiting)))]
        return [(i, self._rows[i]) for i in taken]

    def learn(self, done: Sequence[Done]) -> None:
        """How long rows take."""
        # The first row of a worker opens the archives; a mean over all forgets it soon.
        self._seconds += sum(one.seconds for one in done)
        self._counted += len(done)

    def wait_again(self, chunk: Chunk) -> None:
        """Rows that have not begun, or that were under way when the cluster was lost."""
        self._waiting += [i for i, _ in reversed(chunk)]

    def admits(self, running: int, *, most: int) -> bool:
        """Whether the next chunk may begin beside `running` others, of which there may be `most`.

        A row that may end its process runs alone.
        """
        self._alone = self._alone and running > 0
        return len(self) > 0 and running < (1 if self._suspects or self._alone else most)

    def give_back(self, chunks: Sequence[Chunk], *, attempts: int = 2) -> list[int]:
        """Rows that were under way when a process ended wait again, each alone. Returns those that have ended one
        `attempts` times while no other row ran."""
        rows = [i for chunk in chunks for i, _ in chunk]
        if len(rows) == 1:
            self._ended[rows[0]] = self._ended.get(rows[0], 0) + 1
        guilty = [i for i in rows if self._ended.get(i, 0) >= attempts]
        self._suspects += [i for i in rows if i not in guilty]
        return guilty
