"""A march of a bearing: the numbers of every step, fields at some times, and where it goes on after a stop."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from roughfilm.contact.foundation.arrays import Array
from roughfilm.contact.foundation.errors import ConvergenceError, Outcome
from roughfilm.rom.bearing.free.film import FreeFilm
from roughfilm.rom.bearing.march.course import Duty, course_of, film_at, started
from roughfilm.rom.bearing.march.heated import HeatedMarch
from roughfilm.rom.bearing.march.numbers import Observer
from roughfilm.rom.bearing.march.rough_walls import walls_of
from roughfilm.rom.cavitation.motion.march import Moving, march
from roughfilm.rom.cavitation.motion.past import Known
from roughfilm.rom.cavitation.network import State

CHUNK = 200
"""Number of steps that are kept together."""

FIRST_STEP = 0.1
"""First time step over the largest one of a wall without mass, which jumps where its first forces do not balance."""

CLOSEST = 1e-4
"""Film thickness over the clearance, or over the first film, at which the walls count as touching."""

TOLERANCE = 1e-10
"""Residual at which a step is solved."""

Saved = Mapping[str, Array]
"""All numbers from which a march goes on, by name."""


@dataclass(frozen=True, kw_only=True)
class Numerics:
    """The grid and the time steps of a march.

    Attributes
    ----------
    cells : cells along and across.
    end : last time, s.
    error : largest error of a step, see :func:`roughfilm.rom.cavitation.motion.march.march`; None for equal steps.
    step : largest time step, s.
    field_times : times, s, at or after which the next step's fields are kept.
    """

    cells: tuple[int, int]
    end: float
    error: float | None
    step: float
    field_times: tuple[float, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Snapshot:
    """The fields of a step, each with its unit, shape (nx, ny)."""

    time: float
    fields: Mapping[str, tuple[Array, str]]


@dataclass(frozen=True, kw_only=True)
class Chunk:
    """Some steps that follow one another.

    Attributes
    ----------
    rows : the numbers of the steps, shape (steps, numbers).
    snapshots : the fields of some of them.
    state : from which the march goes on after them.
    """

    rows: Array
    snapshots: tuple[Snapshot, ...]
    state: Saved


@dataclass(frozen=True, kw_only=True)
class Series:
    """The steps of a march.

    Attributes
    ----------
    units : name and unit of every number.
    rows : the numbers of every step, shape (steps, numbers), the first of which is the start.
    snapshots : fields at some times.
    grid : positions x, y of the nodes of the fields, with units.
    known : number of steps that were kept before.
    leading : the input on which the temperature of the last step depends most, in words; "" if there is none.
    """

    units: Mapping[str, str]
    rows: Array
    snapshots: tuple[Snapshot, ...]
    grid: Mapping[str, tuple[Array, str]]
    known: int
    leading: str = ""

    @cached_property
    def columns(self) -> dict[str, Array]:
        """The numbers over the steps by name."""
        return dict(zip(self.units, self.rows.T, strict=True))

    def __getitem__(self, name: str) -> Array:
        """The numbers of a name over the steps."""
        return self.columns[name]

    @property
    def time(self) -> Array:
        """The times of the steps, s."""
        return self.columns["time"]


Keep = Callable[[Chunk], None]


def run(
    duty: Duty,
    numerics: Numerics,
    *,
    part: float = 1.0,
    known: Sequence[Chunk] = (),
    keep: Keep = lambda _chunk: None,
    progress: Callable[[float, str], None] = lambda _fraction, _words: None,
    tolerance: float = TOLERANCE,
) -> Series:
    """March a bearing to the last time.

    Parameters
    ----------
    part : heat transfer to still air over the one that is taken where none is given.
    known : chunks that were kept before; the march goes on behind them with the same numbers, bit for bit.
    keep : called with each finished chunk.

    Raises
    ------
    InputError
        If the first load has no equilibrium.
    ConvergenceError
        If a film becomes too thin, or a step does not converge; the steps before it are kept.
    """
    walls = walls_of(duty.scene)
    film = film_at(duty, numerics.cells, walls)
    heats = not duty.scene.lubricant.lacking
    observer, chunks = Observer(duty=duty, film=film, asperities=walls.contact, heated=heats), list(known)
    warming = HeatedMarch(duty=duty, observer=observer, part=part) if heats else None
    if chunks:
        moving = moving_of(film, chunks[-1].state)
    else:
        begin = partial(started, duty, film) if warming is None else warming.started
        moving = begin(tolerance=tolerance)
        if duty.body.mass is None:
            moving = replace(moving, following=FIRST_STEP * numerics.step)
        first = Snapshot(time=moving.now.time, fields=observer.fields(moving))
        chunks.append(
            Chunk(
                rows=_row(observer, warming, moving)[None],
                snapshots=(first,) if numerics.field_times else (),
                state=saved(moving),
            )
        )
        keep(chunks[0])
    if moving.now.time < numerics.end * (1 - 1e-12):
        for chunk in _chunks(duty, observer, warming, moving, numerics, tolerance, progress):
            keep(chunk)
            chunks.append(chunk)
    return Series(
        units=observer.units,
        rows=np.concatenate([chunk.rows for chunk in chunks]),
        snapshots=tuple(one for chunk in chunks for one in chunk.snapshots),
        grid=observer.grid,
        known=sum(len(chunk.rows) for chunk in known),
        leading="" if warming is None else warming.leading(moving_of(film, chunks[-1].state)),
    )


def _chunks(
    duty: Duty,
    observer: Observer,
    warming: HeatedMarch | None,
    moving: Moving,
    numerics: Numerics,
    tolerance: float,
    progress: Callable[[float, str], None],
) -> Iterator[Chunk]:
    """The steps of a march in chunks; one that an error ends is given before the error."""
    rows: list[Array] = []
    snapshots: list[Snapshot] = []
    left = [time for time in numerics.field_times if time > moving.now.time]
    begin, last, film = duty.begin, moving, observer.film
    steps = march(
        film.solved,
        replace(course_of(duty, film), warming=warming),
        moving,
        numerics.end,
        largest_step=numerics.step,
        error=numerics.error,
        tolerance=tolerance,
        closest=closest_of(film),
    )

    def chunk() -> Chunk:
        done = Chunk(rows=np.array(rows), snapshots=tuple(snapshots), state=saved(last))
        rows.clear()
        snapshots.clear()
        return done

    try:
        for moved in steps:
            _refuse_touching(observer, moved)
            last = moved
            rows.append(_row(observer, warming, last))
            if left and last.now.time >= left[0] * (1 - 1e-12):
                snapshots.append(Snapshot(time=last.now.time, fields=observer.fields(last)))
                left = [time for time in left if time > last.now.time * (1 + 1e-12)]
            time = last.now.time
            progress((time - begin) / (numerics.end - begin), f"time {time:.4g} s of {numerics.end:.4g} s")
            if len(rows) >= CHUNK:
                yield chunk()
    except Exception:
        if rows:
            yield chunk()
        raise
    if rows:
        yield chunk()


def _refuse_touching(observer: Observer, moving: Moving) -> None:
    """Raise ConvergenceError if walls without contact meet between the nodes of the grid."""
    if observer.film.solved.contact is None and observer.least(moving.instant.faces.thickness)[0] <= 0:
        raise ConvergenceError(
            f"motion: at the time {moving.now.time:.6g} s the walls touch between the nodes of the grid; lower the "
            "load, raise the viscosity or the speed, or take more cells",
            outcome=Outcome.STALLED,
            iterations=moving.instant.iterations,
        )


def _row(observer: Observer, warming: HeatedMarch | None, moving: Moving) -> Array:
    """The numbers of a step."""
    return observer.row(moving) if warming is None else observer.row(moving, warming.estimated(moving))


def closest_of(film: FreeFilm) -> float:
    """The film thickness, m, at which the walls count as touching, or below which their contact is not known."""
    if film.solved.contact is not None:
        return film.solved.contact.closest
    return max(CLOSEST * float(film.wall.unit[0]), film.solved.closest)


def saved(moving: Moving) -> dict[str, Array]:
    """The numbers from which a march goes on."""
    instant, past = moving.instant, moving.past
    return {
        "place": instant.place,
        "pressures": np.append(instant.pressures, 0.0),
        "pressure": instant.state.pressure,
        "fill": instant.state.fill,
        "kind": instant.kind,
        "past_time": np.array([known.time for known in past]),
        "past_place": np.array([known.place for known in past]),
        "past_velocity": np.array([known.velocity for known in past]),
        "past_held": np.array([known.held for known in past]),
        "past_temperature": np.array([known.temperature for known in past]),
        "temperatures": np.array([moving.solved_at, moving.balanced]),
        "steps": np.array([moving.step, moving.following, moving.order, moving.error, moving.turned]),
    }


def moving_of(film: FreeFilm, state: Saved) -> Moving:
    """The film from which a march goes on, from what :func:`saved` gives."""
    step, following, order, error, turned = (float(number) for number in state["steps"])
    first = (film.reversed if turned else film).first(state["place"])
    instant = replace(
        first,
        pressures=state["pressures"][:-1],
        state=State(pressure=state["pressure"], fill=state["fill"]),
        kind=state["kind"].astype(np.int8),
    )
    past = tuple(
        Known(time=float(time), place=place, velocity=velocity, held=held, temperature=float(temperature))
        for time, place, velocity, held, temperature in zip(
            *(state[f"past_{name}"] for name in ("time", "place", "velocity", "held", "temperature")), strict=True
        )
    )
    return Moving(
        instant=instant,
        past=past,
        step=step,
        following=following,
        order=int(order),
        error=error,
        turned=bool(turned),
        solved_at=float(state["temperatures"][0]),
        balanced=float(state["temperatures"][1]),
    )
