"""The exception of the package."""
import os


class Error(Exception):
    """A refusal of bake, in one line: what is wrong, and how to mend it.

    exit_code: that of the command, 1 over a limit that was given, 2 wrong options, 3 unreadable input, 4 unsuitable input,
        5 output that cannot be written
    file: the file that the line names, or None
    result: of a verb, the object that the command prints as --json; of an exit code 1 it has the whole result; else None
    """

    def __init__(self, message, exit_code=4, result=None):
        super().__init__(message)
        self.exit_code = exit_code
        self.file = _named_file(message, exit_code)
        self.result = result


def _named_file(message, exit_code):
    """The lines that name a file begin with it. Wrong options are named in the same way."""
    name, colon, _ = message.partition(": ")
    if not colon or name.startswith("-"):
        return None
    return name if exit_code in (3, 4, 5) or os.path.exists(name) else None
