"""The finished results of a sweep in a file of SQLite, so that a second run goes on where the first one stopped."""

from __future__ import annotations

import hashlib
import io
import os
import pickle
from typing import Any, Dict, Iterable, List, Optional, Tuple, Union

from .errors import BusyError, DataError

FORMAT = "feather sweep 1"


def digest(value: Any) -> str:
    """Of its pickle without memory of what it met: equal values have equal ones, whichever objects they share."""
    out = io.BytesIO()
    pickler = pickle.Pickler(out, 4)
    pickler.fast = True
    pickler.dump(value)
    return hashlib.sha256(out.getvalue()).hexdigest()


def identity(function: Any, parameters: List[Any], world: Optional[bytes]) -> Dict[str, str]:
    """What the file's results belong to, in the order in which a difference is named."""
    name = f"{getattr(function, '__module__', '')}.{getattr(function, '__qualname__', type(function).__qualname__)}"
    return {
        "format": FORMAT,
        "function": name.replace("__mp_main__", "__main__"),
        "world": hashlib.sha256(world).hexdigest() if world else "none",
        "number of parameters": str(len(parameters)),
        "parameters": hashlib.sha256("".join(digest(each) for each in parameters).encode()).hexdigest(),
    }


class Results:
    """Results by the place of their parameter. One process has the file at a time."""

    def __init__(self, path: Union[str, "os.PathLike[str]"], belongs_to: Dict[str, str]) -> None:
        import sqlite3  # here, not above: only who resumes needs it

        self._path = os.fspath(path)
        self._errors = sqlite3
        self._link = sqlite3.connect(self._path, timeout=0)
        try:
            self._open(belongs_to)
        except BaseException as error:
            self._link.close()
            if isinstance(error, sqlite3.OperationalError) and "locked" in str(error):
                raise BusyError(f"sweep: resume={self._path!r} is in use by another process") from error
            if isinstance(error, sqlite3.DatabaseError):
                raise DataError(f"sweep: resume={self._path!r} is no file of a sweep, or damaged: {error}") from error
            raise

    def _open(self, belongs_to: Dict[str, str]) -> None:
        link = self._link
        link.execute("PRAGMA locking_mode = EXCLUSIVE")
        link.execute("BEGIN EXCLUSIVE")
        link.execute("CREATE TABLE IF NOT EXISTS sweep (name TEXT PRIMARY KEY, value TEXT)")
        link.execute("CREATE TABLE IF NOT EXISTS results (place INTEGER PRIMARY KEY, data BLOB)")
        written = dict(link.execute("SELECT name, value FROM sweep"))
        for name, value in belongs_to.items() if written else ():
            if written.get(name) != value:
                raise DataError(f"sweep: resume={self._path!r} is of another sweep: its {name} differs")
        if not written:
            link.executemany("INSERT INTO sweep VALUES (?, ?)", belongs_to.items())
        link.commit()

    def read(self) -> List[Tuple[int, Any]]:
        """What an earlier run left: place and result."""
        try:
            rows = self._link.execute("SELECT place, data FROM results ORDER BY place").fetchall()
        except self._errors.DatabaseError as error:
            raise DataError(f"sweep: resume={self._path!r} is damaged: {error}") from error
        return [(place, pickle.loads(data)) for place, data in rows]

    def add(self, rows: Iterable[Tuple[int, bytes]]) -> None:
        """All of them are in the file when it returns, or none."""
        with self._link:
            self._link.executemany("INSERT OR REPLACE INTO results VALUES (?, ?)", rows)

    def close(self) -> None:
        """Closes the file."""
        self._link.close()
