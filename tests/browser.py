"""A headless chromium for tests; chromium and chromedriver come from the system."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from typing import Any

import pytest

SCRIPT_SECONDS = 300


def headless_chromium(*reachable: str) -> Iterator[Any]:
    """A browser that may reach these hosts and no other; the test is skipped where there is none
    (PLANNERFT_REQUIRE_BROWSER=1: it fails).
    """
    reason = _missing()
    if reason and os.environ.get("PLANNERFT_REQUIRE_BROWSER") == "1":
        pytest.fail(reason)
    if reason:
        pytest.skip(reason)
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = str(shutil.which("chromium"))
    hosts = ", ".join(
        ["--host-resolver-rules=MAP * ~NOTFOUND", *(f"EXCLUDE {host}" for host in reachable)]
    )
    for argument in (
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-dev-shm-usage",
        hosts,
    ):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
    driver.set_script_timeout(SCRIPT_SECONDS)
    yield driver
    driver.quit()


def _missing() -> str | None:
    try:
        import selenium  # noqa: F401
    except ImportError:
        return "selenium is not installed (the extra `browser`)"
    absent = [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]
    return (
        f"{' and '.join(absent)} not found (Debian: apt-get install chromium chromium-driver)"
        if absent
        else None
    )
