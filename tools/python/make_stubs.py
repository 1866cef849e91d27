"""Writes bake/__init__.pyi of the built package from the options of the verbs: make_stubs.py FOLDER_OF_THE_PACKAGE."""
import sys
from pathlib import Path

folder = Path(sys.argv[1])
sys.path.insert(0, str(folder))
sys.dont_write_bytecode = True

from bake import _bake, _verbs  # noqa: E402

head = '''"""Made from the options of the command."""
import os
from typing import Any, Callable, Literal, Optional, Sequence, Union

from . import arrays as arrays
from .error import Error as Error

__version__: str
commit: str

Progress = Callable[[str, int, int], object]
Path = Union[str, "os.PathLike[str]"]
Value = Union[str, int, float, "os.PathLike[str]", Sequence[Union[str, int, float, "os.PathLike[str]"]]]
'''


def annotation(option):
    if not option["value"]:
        return "bool"
    if option["choices"]:
        words = ", ".join(repr(word) for word in option["choices"])
        # Numbers are words as well: depth=16.
        return f"Union[Literal[{words}], int, bool]"
    return "Value"


def stub(verb, job, options):
    lines = [f"def {verb.replace('-', '_')}(", "    *inputs: Path,"]
    for option in _verbs.keyword_options(options):
        lines.append(f"    {_verbs.parameter_name(option)}: Optional[{annotation(option)}] = ...,")
    lines += ["    progress: Optional[Progress] = ...,", ") -> dict[str, Any]:", f'    """{job}."""', ""]
    return "\n".join(lines)


text = head
for verb, job, _, options in _bake.verbs():
    text += "\n" + stub(verb, job, options)
(folder / "bake" / "__init__.pyi").write_text(text)
