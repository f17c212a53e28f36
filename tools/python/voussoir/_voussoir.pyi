# The compiled module, of which the package makes what users see.
from typing import Any

def __getattr__(name: str) -> Any: ...
