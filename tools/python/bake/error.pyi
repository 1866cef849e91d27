from typing import Any, Optional

class Error(Exception):
    exit_code: int
    file: Optional[str]
    result: Optional[dict[str, Any]]
    def __init__(self, message: str, exit_code: int = ..., result: Optional[dict[str, Any]] = ...) -> None: ...
