import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

class Log:
    folder: Path
    is_whole: bool
    frame_count: int
    run: dict[str, Any]
    frames: NDArray[np.void]
    states: NDArray[np.void]
    wrenches: NDArray[np.void]
    contacts: NDArray[np.void]
    energies: NDArray[np.void] | None
    def __init__(self, folder: str | os.PathLike[str]) -> None: ...
    @property
    def time(self) -> NDArray[np.float64]: ...
    @property
    def bodies(self) -> list[str]: ...
    @property
    def events(self) -> list[dict[str, Any]]: ...
    def contacts_of(self, frame: int) -> NDArray[np.void]: ...
    def primitive(self, index: int) -> str: ...
