"""What pip calls (PEP 517): a wheel of what `cmake --install` installs, a source archive of what git knows.

Settings (pip: --config-settings NAME=VALUE): build-dir, a build folder to use, default build/wheel; one that is configured
already is only brought up to date. jobs, of the compiler, default: all processors.
"""

import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
VERSION = re.search(r"project\(voussoir VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
DIST_INFO = f"voussoir-{VERSION}.dist-info"
DATA = f"voussoir-{VERSION}.data"
TAG = f"cp{sys.version_info[0]}{sys.version_info[1]}-cp{sys.version_info[0]}{sys.version_info[1]}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def metadata():
    lines = ["Metadata-Version: 2.1", "Name: voussoir", f"Version: {VERSION}", f"Summary: {PROJECT['description']}",
             f"License: {PROJECT['license']['text']}", f"Requires-Python: {PROJECT['requires-python']}"]
    lines += [f"Requires-Dist: {name}" for name in PROJECT["dependencies"]]
    for extra, names in PROJECT["optional-dependencies"].items():
        lines.append(f"Provides-Extra: {extra}")
        lines += [f"Requires-Dist: {name}; extra == '{extra}'" for name in names]
    return "\n".join(lines + ["Description-Content-Type: text/markdown", "", (ROOT / PROJECT["readme"]).read_text()])


def run(*words):
    print("+", *words, flush=True)
    subprocess.run([str(w) for w in words], check=True)


def build(settings):
    """The build folder, up to date."""
    folder = pathlib.Path(settings.get("build-dir", ROOT / "build" / "wheel")).resolve()
    if not (folder / "CMakeCache.txt").exists():
        run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            "-DCMAKE_CXX_FLAGS_RELEASE=-O3", f"-DPython_EXECUTABLE={sys.executable}")
    if not any((folder / "CMakeFiles").glob("voussoir_python.dir")):
        raise SystemExit(f"{folder} was configured without the Python package: install python3-dev and pybind11-dev "
                         "(tools/install-packages), and remove that folder")
    jobs = ["-j", settings["jobs"]] if "jobs" in settings else []
    run("cmake", "--build", folder, "--target", "installed", *jobs)
    return folder


def laid_out(installed, wheel):
    """Moves what was installed below a prefix to where a wheel has it."""
    packages = installed / "lib" / "python3" / "dist-packages"
    shutil.move(packages / "voussoir", wheel / "voussoir")
    shutil.rmtree(packages.parent)
    (wheel / DATA).mkdir()
    shutil.move(installed / "bin", wheel / DATA / "scripts")
    shutil.move(installed, wheel / DATA / "data")


def add_info(wheel):
    info = wheel / DIST_INFO
    info.mkdir()
    (info / "METADATA").write_text(metadata())
    (info / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: voussoir\nRoot-Is-Purelib: false\nTag: {TAG}\n")
    shutil.copy(ROOT / "LICENSE", info)


def zipped(wheel, file):
    """RECORD last: the digest of every file."""
    record = []
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(p for p in wheel.rglob("*") if p.is_file()):  # links are followed: a wheel has none
            name = path.relative_to(wheel).as_posix()
            data = path.read_bytes()
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record.append(f'"{name}",sha256={digest},{len(data)}')
            entry = zipfile.ZipInfo(name)
            entry.external_attr = (0o100755 if os.access(path, os.X_OK) else 0o100644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
        archive.writestr(f"{DIST_INFO}/RECORD", "\n".join(record + [f"{DIST_INFO}/RECORD,,"]) + "\n")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    folder = build(config_settings or {})
    name = f"voussoir-{VERSION}-{TAG}.whl"
    with tempfile.TemporaryDirectory() as scratch:
        installed, wheel = pathlib.Path(scratch) / "installed", pathlib.Path(scratch) / "wheel"
        wheel.mkdir()
        for component in ("runtime", "python"):
            run("cmake", "--install", folder, "--prefix", installed, "--component", component, "--strip")
        laid_out(installed, wheel)
        add_info(wheel)
        zipped(wheel, pathlib.Path(wheel_directory) / name)
    return name


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    add_info(pathlib.Path(metadata_directory))
    return DIST_INFO


def build_sdist(sdist_directory, config_settings=None):
    name = f"voussoir-{VERSION}"
    tracked = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z"], check=True, capture_output=True).stdout
    with tarfile.open(pathlib.Path(sdist_directory) / f"{name}.tar.gz", "w:gz") as archive:
        for path in filter(None, tracked.decode().split("\0")):
            archive.add(ROOT / path, f"{name}/{path}")
        with tempfile.NamedTemporaryFile("w", delete=False) as info:
            info.write(metadata())
        archive.add(info.name, f"{name}/PKG-INFO")
        os.unlink(info.name)
    return f"{name}.tar.gz"
