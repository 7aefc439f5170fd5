"""Whether a binary .stl is whole."""

from __future__ import annotations

from pathlib import Path


def check_stl(path: Path) -> None:
    """Raises OSError unless a binary file has as many triangles as it says: VTK takes any."""
    with path.open("rb") as file:
        head = file.read(84)
    size, count = path.stat().st_size, int.from_bytes(head[80:84], "little")
    if not head.lstrip().startswith(b"solid") and size < 84 + 50 * count:
        raise OSError(
            f"{path} cannot be read: it is damaged; it has {size} bytes, and its {count} triangles "
            f"take {84 + 50 * count}."
        )
