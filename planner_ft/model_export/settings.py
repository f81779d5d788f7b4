"""Settings of an export."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import LEVELS, Level, check_level

OutType = Literal["f32", "f16"]


@dataclass(frozen=True)
class ExportSettings:
    """An export of `candidate` into the folder `out`. `merge` folds the adapter of `level` in:
    `adapter` ("DIR" or "LEVEL=DIR"), or the candidate's own. `gguf` writes a GGUF file, too, its
    matrices in `outtype`. `checks` commands are answered before and after: those of `data`, or of
    the level's validation set.
    """

    candidate: str
    out: Path
    level: Level = "mission"
    merge: bool = False
    adapter: str | None = None
    gguf: bool = False
    outtype: OutType = "f32"
    checks: int = 8
    data: Path | None = None
    vocabulary: str = "usv"
    overwrite: bool = False

    def __post_init__(self) -> None:
        """Raise PlannerError that lists every setting that cannot be used."""
        problems = []
        if self.adapter is not None and not self.merge:
            problems.append("--adapter: an adapter is exported by folding it in; give --merge, too")
        if self.outtype not in get_args(OutType):
            problems.append(f"--outtype {self.outtype}: must be {' or '.join(get_args(OutType))}")
        if not 1 <= self.checks <= 10000:
            problems.append(f"--checks {self.checks}: must be between 1 and 10000")
        if problems:
            raise PlannerError("; ".join(problems))

    @property
    def named_adapter(self) -> tuple[Level, Path | None]:
        """The level whose agent is exported, and the adapter's folder where one is named."""
        level, separator, folder = (self.adapter or "").partition("=")
        if separator and level in LEVELS:
            return check_level(level), Path(folder)
        return self.level, Path(self.adapter) if self.adapter else None
