"""Adds the licences of bundled libraries to a wheel.

Run: python3 add_licences.py WHEEL FOLDER. WHEEL is the output of auditwheel repair; the new wheel
is written to FOLDER. Licences come from the Debian packages of the libraries.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

CHANGED_NAME = re.compile(r"-[0-9a-f]{8}(?=\.)")  # auditwheel puts a hash there


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def installed_libraries():
    """Returns this machine's libraries by file name, with links resolved as by auditwheel."""
    found = re.findall(r"=> (\S+)$", output_of("/sbin/ldconfig", "-p"), re.MULTILINE)
    paths = [Path(path).resolve() for path in reversed(found)]  # the first of a name counts
    return {path.name: path for path in paths}


def package_of(path):
    """Returns the Debian package of a file, its version, and its source package with version."""
    for name in (str(path), str(path).removeprefix("/usr")):  # as Debian has merged these folders
        try:
            package = output_of("dpkg-query", "-S", name).partition(":")[0]
        except subprocess.CalledProcessError:
            continue
        version, source = output_of(
            "dpkg-query", "-W", "-f", "${Version}\t${source:Package} ${source:Version}", package
        ).split("\t")
        return package, version, source
    sys.exit(f"{path} belongs to no Debian package, so no licence was found for it.")


def copy_licences(libraries, folder):
    """Writes a licence file for each package, and BUNDLED.txt; returns the names of the files."""
    installed, lines, names = installed_libraries(), [], set()
    for library in sorted(libraries):
        original = CHANGED_NAME.sub("", library)
        if original not in installed:
            sys.exit(f"{library} is not one of this machine's libraries ({original}).")
        package, version, source = package_of(installed[original])
        text = Path("/usr/share/doc", package, "copyright").read_bytes()
        (folder / f"{package}.txt").write_bytes(text)
        names.add(f"{package}.txt")
        lines.append(f"{library}: Debian package {package} {version}, source package {source}")
    head = "Libraries in this wheel, as Debian has them but for their names (snapshot.debian.org):"
    (folder / "BUNDLED.txt").write_text("\n".join([head, *lines]) + "\n")
    return sorted({*names, "BUNDLED.txt"})


def main(wheel, output):
    with tempfile.TemporaryDirectory() as temporary:
        tool = (sys.executable, "-m", "wheel")
        subprocess.run([*tool, "unpack", "-d", temporary, wheel], check=True)
        (root,) = Path(temporary).iterdir()
        (information,) = root.glob("*.dist-info")
        (bundled,) = root.glob("*.libs")
        folder = information / "licenses" / "bundled"
        folder.mkdir(parents=True)
        names = copy_licences([path.name for path in bundled.iterdir()], folder)
        metadata = information / "METADATA"
        lines = "".join(f"License-File: bundled/{name}\n" for name in names)
        first = "License-File: LICENSE\n"
        text = metadata.read_text()
        assert first in text
        metadata.write_text(text.replace(first, first + lines))
        Path(output).mkdir(parents=True, exist_ok=True)
        subprocess.run([*tool, "pack", "-d", output, str(root)], check=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
