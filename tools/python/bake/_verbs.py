"""Makes a function of each verb, from the options of the command."""
import inspect
import json
import keyword
import numbers
import os

from . import _bake
from .error import Error

# Python always takes the object, and has its own ways to be quiet.
_left_out = {"--json", "--quiet", "--help"}


def parameter_name(option):
    name = option["name"].lstrip("-").replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


def keyword_options(options):
    return [option for option in options if not option["positional"] and option["name"] not in _left_out]


def _word(value, option):
    """A value as the command line has it."""
    if isinstance(value, (tuple, list)):
        between = "x" if "WxH" in option["value"] else ","
        return between.join(_word(part, option) for part in value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (str, bytes, os.PathLike)):
        return os.fsdecode(value)
    if isinstance(value, numbers.Integral):  # also those of numpy
        return str(int(value))
    return repr(float(value))


def _option_words(option, value):
    name = option["name"]
    if value is None:
        return []
    if not option["value"]:  # a flag
        return [name] if value else []
    if option["many"] and isinstance(value, (tuple, list)):
        return [name, *(_word(part, option) for part in value)]
    return [f"{name}={_word(value, option)}"]


def _words(verb, inputs, options, values):
    known = {parameter_name(option): option for option in options}
    words = [verb, *(os.fsdecode(value) for value in inputs)]
    for name, value in values.items():
        if name not in known:
            raise TypeError(f"{verb.replace('-', '_')}() got an unexpected keyword argument '{name}'")
        words += _option_words(known[name], value)
    return [*words, "--json"]


def _result(code, out, err):
    result = json.loads(out) if out.strip() else {}
    if code == 0:
        return result
    reason = result.get("error") or err.strip().removeprefix("bake: ")
    raise Error(reason or "the result is over a limit", code, result)


def _signature(options):
    kind = inspect.Parameter
    parameters = [kind("inputs", kind.VAR_POSITIONAL)]
    parameters += [kind(parameter_name(option), kind.KEYWORD_ONLY, default=None) for option in options]
    return inspect.Signature([*parameters, kind("progress", kind.KEYWORD_ONLY, default=None)])


def _text(job, options, all_options):
    lines = [job + ".", ""]
    for option in (option for option in all_options if option["positional"]):
        lines.append(f"*{option['name']}: {option['description']}")
    for option in options:
        value = f" ({option['value']})" if option["value"] else ""
        default = f" [{option['default']}]" if option["default"] else ""
        lines.append(f"{parameter_name(option)}{value}: {option['description']}{default}")
    return "\n".join(lines)


def _function(verb, job, all_options):
    options = keyword_options(all_options)

    def call(*inputs, progress=None, **values):
        return _result(*_bake.run(_words(verb, inputs, options, values), progress))

    call.__name__ = call.__qualname__ = verb.replace("-", "_")
    call.__module__ = "bake"
    call.__doc__ = _text(job, options, all_options)
    call.__signature__ = _signature(options)
    return call


def make_verbs():
    functions = (_function(verb, job, options) for verb, job, _, options in _bake.verbs())
    return {function.__name__: function for function in functions}
