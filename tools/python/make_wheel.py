"""Packs the built package as a wheel: make_wheel.py PACKAGE VERSION LICENCE OUT_FOLDER. The same package gives the same bytes."""
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

package, version, licence, out = Path(sys.argv[1]), sys.argv[2], sys.argv[3], Path(sys.argv[4])
tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
staged = out / "wheel"
shutil.rmtree(staged, ignore_errors=True)
# The helper program goes in beside the module, where it is found first.
shutil.copytree(package, staged / "bake", ignore=shutil.ignore_patterns("__pycache__"))
for program in [*(staged / "bake").glob("*.so"), staged / "bake" / "bake_formats"]:
    subprocess.run(["strip", program], check=True)

info = staged / f"bake-{version}.dist-info"
info.mkdir()
(info / "METADATA").write_text(f"""Metadata-Version: 2.1
Name: bake
Version: {version}
Summary: Normal maps, bump tables, displaced meshes and environment maps
License: {licence}
Requires-Python: >=3.{sys.version_info.minor}
Requires-Dist: numpy
""")
(info / "WHEEL").write_text(f"""Wheel-Version: 1.0
Generator: bake {version}
Root-Is-Purelib: false
Tag: {tag}-{tag}-{platform}
""")
# zip has no times before 1980; without SOURCE_DATE_EPOCH all files are of that day.
os.environ.setdefault("SOURCE_DATE_EPOCH", "315532800")
subprocess.run([sys.executable, "-m", "wheel", "pack", "--dest-dir", out, staged], check=True, stdout=subprocess.DEVNULL)
print(next(out.glob(f"bake-{version}-{tag}-*.whl")))
