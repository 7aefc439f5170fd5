"""The rooms of Filters, for test_layering.py: one stack. A room may include those below it."""

# Rooms from the bottom up. A module's own folder, such as "Surfaces", is a room as well.
STACK = (
    "LevelSet/Base",
    "LevelSet/Ranks",
    "LevelSet/Leaves",
    "LevelSet/Start",
    "LevelSet/Front",
    "LevelSet/Nodes",
    "LevelSet/State",
    "LevelSet",
    "LevelSet/Surface",
    "LevelSet/March",
    "Files/Validation",
    "Files",
    "Particles/Index",
    "Particles/Nodes",
    "Particles/Frames",
    "Particles",
    "Shapes/Input",
    "Shapes/Grid",
    "Shapes",
    "IO/Common",
    "IO/EXR",
    "IO/Grids",
    "IO",
    "Surfaces/Ranks",
    "Surfaces/Targets",
    "Surfaces/Simulation",
    "Surfaces/Pipeline",
    "Surfaces",
)
# Only their own module may include these.
PRIVATE = {
    "LevelSet/Leaves",
    "LevelSet/Start",
    "LevelSet/Front",
    "LevelSet/Nodes",
    "LevelSet/State",
    "Files/Validation",
    "Particles/Nodes",
}
# Pairs of modules: the first one must not include the second.
APART = {("Surfaces", "IO")}
# Rooms that include no other headers of the project than these.
ALONE = {
    "Files/Validation": ("LevelSet/Base/OpenVDB", "LevelSet/Base/CompilerBuiltins"),
    "IO/EXR": ("IO/Common/FileError", "Files/FileReplacement"),
}
MODULES = ("LevelSet", "Files", "Particles", "Shapes", "Surfaces", "IO")
