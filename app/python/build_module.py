"""Builds the module with CMake and packs it as a wheel (PEP 517), with Python alone.

The environment variable DOLLYTRACK_BUILD names a build folder to use or to make, for example
build/release; without it the module is built in build/python.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TAG = "cp{0}{1}-cp{0}{1}-{2}".format(*sys.version_info[:2],
                                     sysconfig.get_platform().replace("-", "_").replace(".", "_"))


def version():
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"project\(dollytrack VERSION ([0-9.]+)", text).group(1)


def metadata():
    return ("Metadata-Version: 2.1\nName: dollytrack\n"
            f"Version: {version()}\n"
            "Summary: Plans camera trajectories in indoor 3D scenes and renders them as labelled "
            "datasets\nLicense: GPL-3.0-or-later\nRequires-Python: >=3.9\nRequires-Dist: numpy\n")


def base_interpreter():
    """The Python that the virtual environment was made from, which has the headers."""
    return pathlib.Path(getattr(sys, "_base_executable", None) or sys.executable).resolve()


def build():
    """Returns the folder with the finished package, its files as links."""
    folder = pathlib.Path(os.environ.get("DOLLYTRACK_BUILD") or ROOT / "build" / "python")
    folder = folder if folder.is_absolute() else ROOT / folder
    if not (folder / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja",
                        "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
                        "-DCMAKE_UNITY_BUILD_BATCH_SIZE=12", "-DDOLLYTRACK_EDITOR=OFF",
                        "-DDOLLYTRACK_TESTS=OFF", "-DDOLLYTRACK_PYTHON=ON",
                        f"-DDOLLYTRACK_PYTHON_INTERPRETER={base_interpreter()}"], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "dollytrack_python"], check=True)
    return folder / "python" / "dollytrack"


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    name = f"dollytrack-{version()}.dist-info"
    folder = pathlib.Path(metadata_directory) / name
    folder.mkdir()
    (folder / "METADATA").write_text(metadata())
    return name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    package = build()
    info = f"dollytrack-{version()}.dist-info"
    wheel = pathlib.Path(wheel_directory) / f"dollytrack-{version()}-{TAG}.whl"
    extension = "_core" + sysconfig.get_config_var("EXT_SUFFIX")
    if not (package / extension).exists():
        raise SystemExit(f"There is no {extension} in {package}; build the module for this Python.")
    files = {f"dollytrack/{file.name}": file.read_bytes() for file in sorted(package.iterdir())
             if file.suffix in (".py", ".pyi") or file.name in (extension, "py.typed",
                                                                      "dollytrack-import")}
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: dollytrack\n"
                              f"Root-Is-Purelib: false\nTag: {TAG}\n").encode()
    record = f"{info}/RECORD"
    lines = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            add(archive, name, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            lines.append(f"{name},sha256={digest},{len(data)}")
        add(archive, record, "\n".join([*lines, f"{record},,"]).encode() + b"\n")
    return wheel.name


def add(archive, name, data):
    entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
    entry.compress_type = zipfile.ZIP_DEFLATED
    program = name.endswith(("dollytrack-import", ".so"))
    entry.external_attr = (0o100755 if program else 0o100644) << 16
    archive.writestr(entry, data)


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("The module is built from the whole project; make a wheel.")
