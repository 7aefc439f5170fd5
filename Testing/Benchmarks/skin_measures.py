"""Measures of the skins of a scene. Each has the parameters scene, skins and voxel, and returns
{name: figure}; r is the particles' radius, half of their spacing."""

import numpy as np
from fluid_solver import pairs_within
from skin_geometry import clusters, neighbours

FIRST = 4  # frame from which the start no longer matters
BIRTH_FRAMES = 8  # frames in which a new particle is observed


def columns_of(scene, across=24):
    """Points (x, z) at least 4 r from the walls."""
    margin = 2.0 * scene.spacing
    lines = [np.linspace(margin, scene.size[axis] - margin, across) for axis in (0, 2)]
    return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 2)


def rest_height(scene, count):
    return count * scene.spacing**3 / (scene.size[0] * scene.size[2])


def pool(scene, skins, voxel):
    r, skin = 0.5 * scene.spacing, skins[-1]
    places, _, ids = scene.frames[-1]
    level = rest_height(scene, len(places) - len(scene.drops))
    mean, p95 = flatness(scene, skin, level)
    heights = skin.heights(columns_of(scene), level + 6 * r, 0.0)
    figures = {
        "flatness, mean [deg]": mean,
        "flatness, p95 [deg]": p95,
        "height over rest [r]": (np.nanmean(heights) - level) / r,
        "volume over rest": skin.volume() / (len(places) * scene.spacing**3),
    }
    drops = np.isin(ids, scene.drops)
    moving = np.abs(scene.frames[-1][1][:, 1]) > 0
    for name, chosen in (("standing", drops & ~moving), ("falling", drops & moving)):
        figures[f"drops kept, {name}"] = kept(scene, skins, FIRST, lambda _, c=chosen: c)[0]
    return figures


def flatness(scene, skin, level):
    """Mean and 95th percentile, by area, of the top's angles to the mean normal within 3 r
    [deg]."""
    r, centers = 0.5 * scene.spacing, skin.centers()
    inner = np.abs(centers[:, 1] - level) < 4 * r
    for axis in (0, 2):
        inner &= np.abs(centers[:, axis] - scene.size[axis] / 2) < scene.size[axis] / 2 - 4 * r
    centers, areas = centers[inner], skin.area_vectors()[inner]
    if len(centers) == 0:
        return np.nan, np.nan
    first, second = pairs_within(centers.T, 3 * r)
    mean = areas.copy()
    for axis in range(3):
        mean[:, axis] += np.bincount(first, areas[second, axis], len(areas))
        mean[:, axis] += np.bincount(second, areas[first, axis], len(areas))
    weights = np.linalg.norm(areas, axis=1)
    cosines = (areas * mean).sum(axis=1) / (weights * np.linalg.norm(mean, axis=1) + 1e-300)
    angles = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    order = np.argsort(angles)
    reached = np.searchsorted(np.cumsum(weights[order]), 0.95 * weights.sum())
    return np.average(angles, weights=weights), angles[order[min(reached, len(order) - 1)]]


def kept(scene, skins, step, choose):
    """Fractions of the chosen particles inside, and outside by more than r."""
    inside = outside = total = 0
    for index in range(len(skins) - 1, 0, -step):
        chosen = choose(scene.frames[index])
        distances = skins[index].distances(scene.frames[index][0][chosen])
        inside += (distances < 0).sum()
        outside += (distances > 0.5 * scene.spacing).sum()
        total += len(distances)
    return (inside / total, outside / total) if total else (np.nan, np.nan)


def isolated(scene):
    return lambda frame: neighbours(frame[0], 1.6 * scene.spacing) <= 2


def splash(scene, skins, voxel):
    everything = kept(scene, skins, 4, lambda frame: slice(None))
    volumes = [
        skin.volume() / (len(frame[0]) * scene.spacing**3)
        for skin, frame in zip(skins[1:], scene.frames[1:])
    ]
    return {
        "isolated particles inside": kept(scene, skins, 4, isolated(scene))[0],
        "all particles inside": everything[0],
        "outside by more than r": everything[1],
        "volume over rest": np.mean(volumes),
    }


def sheet(scene, skins, voxel):
    across = round(len(scene.frames[0][0]) ** 0.5)
    amounts = {"whole": [0.0, 0.0], "torn": [0.0, 0.0]}
    for (places, _, _), skin in list(zip(scene.frames, skins))[1:]:
        grid = places.reshape(across, across, 3)
        sides = np.linalg.norm(np.diff(grid, axis=0), axis=2)
        longest = np.maximum(sides[:, 1:], sides[:, :-1]).ravel() / scene.spacing
        middles = (grid[1:, 1:] + grid[1:, :-1] + grid[:-1, 1:] + grid[:-1, :-1]).reshape(-1, 3) / 4
        inside = skin.distances(middles) < 0
        for name, chosen in (("whole", longest <= 1.3), ("torn", longest > 2.0)):
            amounts[name][0] += longest[chosen & inside].sum()
            amounts[name][1] += longest[chosen].sum()
    flat = skins[0].area_vectors() if not skins[0].empty else np.zeros((1, 3))
    return {
        "whole sheet kept": amounts["whole"][0] / amounts["whole"][1],
        "torn sheet bridged": amounts["torn"][0] / amounts["torn"][1],
        "area over 2 sheets, first frame": np.abs(flat[:, 1]).sum()
        / (2 * scene.size[0] * scene.size[2]),
    }


def ball(scene, skins, voxel):
    lags = [
        (frame[0][:, 0].mean(dtype=float) - skin.centroid()[0]) / voxel
        if not skin.empty
        else np.nan
        for frame, skin in list(zip(scene.frames, skins))[-5:]
    ]
    volume = skins[-1].volume() / (len(scene.frames[-1][0]) * scene.spacing**3)
    return {"lag at 2 r per frame [voxels]": np.mean(lags), "volume over rest": volume}


def flicker(scene, skins, voxel):
    r, level = 0.5 * scene.spacing, rest_height(scene, len(scene.frames[0][0]))
    columns = columns_of(scene, 20)
    heights = np.array([skin.heights(columns, level + 12 * r, 0.0) for skin in skins[FIRST:]])
    changes = np.diff(heights, n=2, axis=0) / r
    return {"flicker, rms [r]": np.sqrt(np.nanmean(changes * changes))}


def births(scene, skins, voxel):
    """Frames until new particles are inside (0: in the frame of their birth)."""
    seen, born, inside_at, near, last_age = set(scene.frames[0][2].tolist()), {}, {}, set(), {}
    for index in range(1, len(skins)):
        places, _, ids = scene.frames[index]
        new = set(ids.tolist()) - seen
        born |= dict.fromkeys(new, index)
        seen |= new
        young = [k for k, i in enumerate(ids) if index - born.get(i, -99) <= BIRTH_FRAMES]
        distances = skins[index].distances(places[young])
        for particle, distance in zip(ids[young].tolist(), distances):
            last_age[particle] = index - born[particle]
            if distance < 0.5 * scene.spacing:
                near.add(particle)
            if distance < 0:
                inside_at.setdefault(particle, last_age[particle])
    watched = [i for i in born if i in inside_at or last_age[i] >= BIRTH_FRAMES // 2]
    waits = [inside_at[i] for i in watched if i in inside_at]
    return {
        "births: frames until inside, median": np.median(waits) if waits else np.nan,
        "births: frames until inside, worst": max(waits, default=np.nan),
        "births: never inside": 1 - len(waits) / len(watched),
        "births: never within r of it": sum(i not in near for i in watched) / len(watched),
    }


def rain(scene, skins, voxel):
    return births(scene, skins, voxel) | first_volumes(scene, skins)


def first_volumes(scene, skins, later=4):
    """Compares the volume of each new drop's part of the skin with that `later` frames later."""
    ratios, sizes, seen = [], [], set(scene.frames[0][2].tolist())
    for index in range(1, len(skins) - later):
        places, _, ids = scene.frames[index]
        new = np.array([i not in seen for i in ids.tolist()])
        seen.update(ids.tolist())
        if not new.any():
            continue
        labels = clusters(places[new], 1.6 * scene.spacing)
        for label in np.unique(labels):
            drop = ids[new][labels == label]
            volumes = [
                part_volume(scene, skins[frame], scene.frames[frame], drop)
                for frame in (index, index + later)
            ]
            sizes.append(volumes[1] / (len(drop) * scene.spacing**3))
            if volumes[1] > 0:
                ratios.append(volumes[0] / volumes[1])
    return {
        "births: first volume over later one": np.mean(ratios) if ratios else np.nan,
        "drops: later volume over rest": np.mean(sizes),
    }


def part_volume(scene, skin, frame, drop):
    """Returns 0 if the part nearest to the drop extends beyond the drop."""
    places = frame[0][np.isin(frame[2], drop)].astype(float)
    if skin.empty or len(places) == 0:
        return 0.0
    middle = places.mean(axis=0)
    part = skin.part_at(middle)
    reach = np.linalg.norm(places - middle, axis=1).max() + 4 * scene.spacing
    near = np.linalg.norm(part.centers() - middle, axis=1) < reach
    return part.volume() if near.all() else 0.0


MEASURES = {
    "pool": pool,
    "jitter": flicker,
    "slosh": flicker,
    "splash": splash,
    "dam": splash,
    "fountain": births,
    "rain": rain,
    "sheet": sheet,
    "ball": ball,
}
