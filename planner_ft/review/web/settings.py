"""What the browser review is asked to do."""

from __future__ import annotations

import ipaddress
from dataclasses import dataclass, field
from pathlib import Path

from planner_ft.planning.settings import PlanSettings
from planner_ft.support.errors import PlannerError

LOOPBACK = "127.0.0.1"
LAST_PORT = 65535


@dataclass(frozen=True)
class WebSettings:
    """Where the page is served, and what stands behind it.

    `port` 0 takes a free one. `log` is the approval log: beside the plan by default. `folder` is
    where new plans are written: that of the plan by default, else the current one. `planning` says
    which agents plan and which vehicle this is about.
    """

    host: str = LOOPBACK
    port: int = 0
    open_browser: bool = True
    log: Path | None = None
    folder: Path | None = None
    planning: PlanSettings = field(default_factory=PlanSettings)

    def __post_init__(self) -> None:
        """Raise PlannerError for a value that no setting has."""
        if not 0 <= self.port <= LAST_PORT:
            raise PlannerError(
                f"--port {self.port}: must lie between 0 (any free port) and {LAST_PORT}"
            )

    @property
    def is_loopback(self) -> bool:
        """Whether only programs on this machine can reach the page."""
        if self.host == "localhost":
            return True
        try:
            return ipaddress.ip_address(self.host).is_loopback
        except ValueError:
            return False
