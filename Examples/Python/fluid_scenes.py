"""Scenes of particles to coat, at 25 frames a second; fluid_solver.py makes most of them.

y is up. Gravity is 9.81 except in the scene dam.

    scene = load_scene("fountain", "folder")      # made once, then read from folder/fountain.npz
    for positions, velocities, ids in scene.frames:

Still particles are scene.spacing = 2 r apart, so that N of them fill N (2 r)^3. The box has
its corner at the origin, the size scene.size, and is open above. The scenes sheet and ball extend
beyond the box.
The scenes:

    pool      still, ten layers deep; scene.drops are the ids of the particles of twelve drops
              above it, single particles and pairs, of which half stand still and half fall
    jitter    the pool without drops, each particle displaced by up to r / 10 along each axis, new
              in each frame
    slosh     the pool in a box that is shaken
    splash    a ball falls into a pool; the option size_of of load_scene is the approximate number
              of particles, default 20,000
    dam       a column of water breaks under a gravity of 14: particles go up to 25 r in a frame
    fountain  a jet from a nozzle, new particles in each frame, falls into a basin, which drains
    rain      drops of 3 to 30 particles appear in the air and fall into a shallow pool
    sheet     a single layer, stretched until it tears; not by the solver
    ball      a ball that stands, then moves by 2 r in each frame; not by the solver

Run: python3 fluid_scenes.py FOLDER [scene ...]
"""

import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from fluid_solver import Fluid

RATE = 25
SPACING = 0.05
ACROSS = 24  # particles along the smaller boxes
COHESION = 15.0  # acceleration of neighbours 1.3 spacings apart


@dataclass
class Scene:
    name: str
    spacing: float
    size: tuple  # of the box
    frames: list  # of (positions, velocities, ids)
    drops: np.ndarray = field(default_factory=lambda: np.empty(0, np.int64))


def lattice(low, high, spacing):
    axes = [np.arange(a + 0.5 * spacing, b - 0.25 * spacing, spacing) for a, b in zip(low, high)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(low))


def shaken(places, amount, seed):
    """Returns the points, with each coordinate moved at random by `amount` at most."""
    return places + amount * (2.0 * np.random.default_rng(seed).random(places.shape) - 1.0)


def ball(radius, spacing, seed=1):
    """Returns the points within a ball about the origin, of a slightly shaken lattice."""
    half = spacing * np.ceil(radius / spacing)
    places = lattice((-half,) * 3, (half,) * 3, spacing)
    inside = (places * places).sum(axis=1) < radius * radius
    return shaken(places[inside], 0.05 * spacing, seed)


def record(name, fluid, count, before=lambda frame: None, **motion):
    """Returns `count` frames. `before` is called before each frame except the first, and may add
    and remove particles."""
    frames = []
    for frame in range(count):
        if frame:
            before(frame)
            fluid.advance(1.0 / RATE, **motion)
        frames.append(fluid.frame())
        places = len(frames[-1][0])
        print(f"\r{name}: frame {frame + 1} of {count}, {places} particles ", end="", flush=True)
    print()
    return frames


def settled(across, deep, spacing, height, settling=40, cohesion=COHESION):
    """Returns a fluid: a pool in a box, settled after a little stirring."""
    fluid = Fluid(spacing, (across * spacing, height, across * spacing), cohesion)
    places = lattice((0, 0, 0), (across * spacing, deep * spacing, across * spacing), spacing)
    fluid.add(shaken(places, 0.15 * spacing, 2), (0.1, 0.0, 0.07))
    for frame in range(settling):
        print(f"\rsettling {len(places)} particles: {frame + 1} of {settling} ", end="", flush=True)
        fluid.advance(1.0 / RATE, damping=0.02 if frame < settling // 2 else 0.1)
    fluid.velocities[:] = 0.0
    return fluid


def still_pool():
    return settled(ACROSS, 10, SPACING, 40 * SPACING)


def pool(count=12):
    fluid = still_pool()
    drops, falling = _drops()
    places, _, ids = fluid.frame()
    ids = np.concatenate([ids, fluid.next_id + np.arange(len(drops))])
    frames = []
    for frame in range(count):
        time = frame / RATE
        there, speed = drops.copy(), np.zeros_like(drops)
        there[falling, 1] -= 0.5 * 9.81 * time * time
        speed[falling, 1] -= 9.81 * time
        moving = np.concatenate([np.zeros_like(places), speed])
        frames.append((np.concatenate([places, there]), moving, ids))
    return Scene("pool", SPACING, tuple(fluid.size), frames, ids[-len(drops) :])


def _drops():
    """Returns the particles of twelve drops, and a mask of the particles that fall.

    Six drops stand 4 to 9 spacings above the pool; six drops fall from 35 spacings above the pool.
    """
    places, falling = [], []
    for number in range(12):
        column, row = number % 4, number // 4
        falls = number >= 6
        height = (45 if falls else 14 + number) * SPACING
        center = [(5 + 4.5 * column) * SPACING, height, (6 + 6 * row) * SPACING]
        for side in (-0.5, 0.5) if number % 2 else (0.0,):
            places.append([center[0] + side * SPACING, *center[1:]])
            falling.append(falls)
    return np.array(places), np.array(falling)


def jitter(count=16):
    fluid = still_pool()
    places, velocities, ids = fluid.frame()
    frames = [(shaken(places, 0.05 * SPACING, seed), velocities, ids) for seed in range(count)]
    return Scene("jitter", SPACING, tuple(fluid.size), frames)


def slosh(count=30):
    fluid, time = still_pool(), 0.0

    def pull(since):
        return (1.2 * math.sin(6.0 * (time + since)), -9.81, 0.0)

    def before(frame):
        nonlocal time
        time = (frame - 1) / RATE

    return Scene(
        "slosh", SPACING, tuple(fluid.size), record("slosh", fluid, count, before, gravity=pull)
    )


def splash(size_of=20000, count=26):
    width, deep, radius = 2.4, 0.24, 0.32
    spacing = ((width * width * deep + 4.189 * radius**3) / size_of) ** (1 / 3)
    across, layers = round(width / spacing), round(deep / spacing)
    fluid = settled(across, layers, spacing, 3.0, settling=12, cohesion=3.0)
    middle = (0.5 * across + 0.3) * spacing  # off the lattice's symmetry
    drop = ball(radius, spacing) + (middle, layers * spacing + radius + 1.5 * spacing, middle)
    fluid.add(drop, (0.0, -6.0, 0.0))
    return Scene("splash", spacing, tuple(fluid.size), record("splash", fluid, count))


def dam(count=30, across=12, high=40):
    """The box is three times as long as the column; the water rises along the opposite wall."""
    fluid = Fluid(SPACING, (60 * SPACING, 2 * high * SPACING, across * SPACING), 3.0)
    column = lattice((0, 0, 0), (20 * SPACING, high * SPACING, across * SPACING), SPACING)
    fluid.add(shaken(column, 0.1 * SPACING, 6), (0.0, 0.0, 0.0))
    frames = record("dam", fluid, count, gravity=(0.0, -14.0, 0.0))
    return Scene("dam", SPACING, tuple(fluid.size), frames)


def fountain(count=40, across=ACROSS):
    """An arc from a nozzle near one side. Water leaves by drains in the corners."""
    speed, layers = 4.4, 3
    fluid = settled(across, 3, SPACING, 40 * SPACING, settling=12)
    disc = lattice((-3 * SPACING,) * 2, (3 * SPACING,) * 2, SPACING)
    disc = 1.06 * disc[(disc * disc).sum(axis=1) < (2.3 * SPACING) ** 2]

    def before(frame):
        sides = np.minimum(fluid.places[::2], fluid.size[0] - fluid.places[::2])
        corner = (sides < 4 * SPACING).all(axis=0) & (fluid.places[1] < 4 * SPACING)
        leaving = np.flatnonzero(corner)[:: max(corner.sum() // (layers * len(disc)), 1)]
        fluid.keep(np.delete(np.arange(len(fluid.ids)), leaving))
        for layer in range(layers):
            lag = layer / RATE / layers
            middle = (0.22 * fluid.size[0] - lag * 0.8, 0.5 * fluid.size[2])
            places = np.insert(disc + middle, 1, 9 * SPACING - lag * speed, axis=1)
            places = shaken(places, 0.03 * SPACING, layers * frame + layer)
            fluid.add(places[_free(places, fluid)], (0.8, speed, 0.05))

    return Scene("fountain", SPACING, tuple(fluid.size), record("fountain", fluid, count, before))


def _free(places, fluid):
    """Returns a mask of `places`: True for points without particles of the fluid nearby."""
    apart = places.T[:, :, None] - fluid.places[:, None, :]
    return (apart * apart).sum(axis=0).min(axis=1) > (0.8 * SPACING) ** 2


def rain(count=40):
    fluid = settled(ACROSS, 3, SPACING, 40 * SPACING, settling=12)
    random = np.random.default_rng(5)
    cells = random.permutation(36)  # simultaneous drops are apart

    def before(frame):
        for cell in cells[2 * frame % 36 :][:2] if frame % 2 else ():
            particles = 3 + int(28 * random.random())
            drop = ball(2.2 * SPACING, SPACING, seed=int(cell)) * 0.98
            nearest = np.argsort((drop * drop).sum(axis=1), kind="stable")[:particles]
            place = np.array(
                [3 + 3.6 * (cell % 6), 20 + 4 * random.random(), 3 + 3.6 * (cell // 6)]
            )
            fluid.add(drop[nearest] + place * SPACING, (0.0, -1.0, 0.0))

    return Scene("rain", SPACING, tuple(fluid.size), record("rain", fluid, count, before))


def sheet(count=20, across=32):
    """Sheet stretched unevenly along x, by 4 % of its initial length in each frame."""
    weights = 0.6 + 0.8 * np.random.default_rng(3).random(across - 1)
    flat = lattice((0, 0, 0), (across * SPACING, SPACING, across * SPACING), SPACING)
    ids, offsets = np.arange(len(flat)), shaken(flat, 0.03 * SPACING, 4) - flat
    reach = np.concatenate([[0.0], np.cumsum(weights)]) * SPACING
    speeds = np.zeros(flat.shape)
    speeds[:, 0] = 0.04 * RATE * np.repeat(reach - reach.mean(), across)
    frames = [
        tuple(
            array.astype(np.float32) for array in (flat + offsets + frame / RATE * speeds, speeds)
        )
        + (ids,)
        for frame in range(count)
    ]
    return Scene("sheet", SPACING, (across * SPACING, SPACING, across * SPACING), frames)


def moving_ball(count=20, standing=3):
    places = ball(6.0 * SPACING, SPACING)
    ids, frames = np.arange(len(places)), []
    for frame in range(count):
        moved = places + [max(frame - standing, 0) * SPACING, 0.0, 0.0]
        speed = np.zeros(places.shape, np.float32)
        speed[:, 0] = SPACING * RATE * (frame >= standing)
        frames.append((moved.astype(np.float32), speed, ids))
    return Scene("ball", SPACING, (12 * SPACING,) * 3, frames)


SCENES = {
    "pool": pool,
    "jitter": jitter,
    "slosh": slosh,
    "splash": splash,
    "dam": dam,
    "fountain": fountain,
    "rain": rain,
    "sheet": sheet,
    "ball": moving_ball,
}


def load_scene(name, folder, **options):
    """Loads a scene from a folder; if its file is missing, makes the scene and the file first."""
    said = "".join(f"_{value}" for value in options.values())
    path = Path(folder) / f"{name}{said}.npz"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        _write(path, SCENES[name](**options))
    return _read(path)


def _write(path, scene):
    places, velocities, ids = (np.concatenate(arrays) for arrays in zip(*scene.frames))
    np.savez_compressed(
        path,
        name=scene.name,
        spacing=scene.spacing,
        size=scene.size,
        counts=[len(frame[0]) for frame in scene.frames],
        places=places.astype(np.float32),
        velocities=velocities.astype(np.float32),
        ids=ids.astype(np.int64),
        drops=scene.drops,
    )


def _read(path):
    with np.load(path) as file:
        ends = np.cumsum(file["counts"])[:-1]
        arrays = (np.split(file[key], ends) for key in ("places", "velocities", "ids"))
        return Scene(
            str(file["name"]),
            float(file["spacing"]),
            tuple(file["size"].tolist()),
            list(zip(*arrays)),
            file["drops"],
        )


if __name__ == "__main__":
    for chosen in sys.argv[2:] or SCENES:
        made = load_scene(chosen, sys.argv[1])
        print(f"{chosen}: {len(made.frames)} frames, {len(made.frames[-1][0])} particles")
