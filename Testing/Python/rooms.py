"""Which room of Filters may include which: what test_layering.py holds the tree against."""

# Room: the rooms, and the single files of other rooms, that it may include besides its own. A
# module's own folder, "NarrowBand" say, is a room as well.
NUMERICS = [
    "NarrowBand/OpenVDB",
    "NarrowBand/CompilerBuiltins",
    "NarrowBand/InstructionSets",
    "NarrowBand/Motion",
    "NarrowBand/Obstacle",
    "NarrowBand/PortableMath",
    "NarrowBand/Target",
    "NarrowBand/TargetRegion",
]
MAY_INCLUDE = {
    "NarrowBand/Leaves": [
        "NarrowBand/OpenVDB",
        "NarrowBand/CompilerBuiltins",
        "NarrowBand/InstructionSets",
    ],
    "NarrowBand/Parts": [
        *NUMERICS,
        "NarrowBand/Leaves",
        "NarrowBand/State",
        "NarrowBand/InitialFunction",
    ],
    "NarrowBand/Substep": [
        *NUMERICS,
        "NarrowBand/Leaves",
        "NarrowBand/Parts",
        "NarrowBand/CubeTriangles",
        "NarrowBand/Trilinear",
        "NarrowBand/Walls",
    ],
    "NarrowBand/Implicit": [
        *NUMERICS,
        "NarrowBand/Leaves",
        "NarrowBand/Parts",
        "NarrowBand/Substep",
    ],
    "NarrowBand/State": [
        *NUMERICS,
        "NarrowBand/Leaves",
        "NarrowBand/InitialFunction",
    ],
    "NarrowBand/Ranks": [],
    "NarrowBand/Arrival": [
        *NUMERICS,
        "NarrowBand/Leaves",
    ],
    "NarrowBand": [
        "NarrowBand/Arrival",
        "NarrowBand/Leaves",
        "NarrowBand/Ranks",
        "NarrowBand/Substep",
        "NarrowBand/Implicit",
        "NarrowBand/State",
        "NarrowBand/Parts",
    ],
    "VDB/Validation": ["NarrowBand/OpenVDB", "NarrowBand/CompilerBuiltins"],
    "VDB": ["VDB/Validation", "NarrowBand"],
    "Potentials/Skeleton": [
        "NarrowBand/PortableMath",
        "Potentials/Skeleton",
        "Potentials/SkeletonCells",
        "Potentials/BallCells",
        "Potentials/FinitePlaces",
        "Potentials/PlaceGroups",
        "Potentials/ParallelTasks",
        "Potentials/SkeletonKernel",
        "Potentials/ElementIndex",
        "Potentials/ParticleModel",
    ],
    "Potentials/Grid": [
        "Potentials/GridSamples",
        "Potentials/MeshTriangles",
        "Potentials/SurfaceSample",
        "VDB",
        "NarrowBand",
    ],
    "Potentials": ["Potentials/Skeleton", "Potentials/Grid", "VDB", "NarrowBand"],
    "Surfaces/Targets": ["Potentials", "VDB", "NarrowBand"],
    "Surfaces/Simulation": ["Surfaces/Targets", "Potentials", "VDB", "NarrowBand"],
    "Surfaces/Ranks": ["VDB", "NarrowBand"],
    "Surfaces/Pipeline": [
        "Surfaces/Ranks",
        "Surfaces/Simulation",
        "Surfaces/Targets",
        "Potentials",
        "VDB",
        "NarrowBand",
    ],
    "Surfaces": ["Surfaces/Pipeline", "Surfaces/Ranks", "Surfaces/Simulation", "Potentials"],
    "IO/EXR": ["IO/FileError", "VDB"],
    "IO/Grids": ["IO/FileError", "Potentials", "VDB", "NarrowBand"],
    "IO": ["IO/EXR", "IO/Grids", "Potentials", "VDB", "NarrowBand"],
}
MODULES = ("NarrowBand", "VDB", "Potentials", "Surfaces", "IO")
