"""What a run against a server is asked to do."""

from __future__ import annotations

import os
from dataclasses import dataclass
from urllib.parse import urlsplit

from planner_ft.support.errors import PlannerError

CHAT = "/chat/completions"


@dataclass(frozen=True)
class EndpointSettings:
    """A server that speaks the OpenAI chat completions API, and how it is asked.

    `url` is the API's root ("http://127.0.0.1:8000/v1"), `model` the name that the server knows.
    `api_key_env` names the environment variable that holds the key; the key itself stands nowhere.
    At most `concurrency` questions are open at a time, each for at most `timeout` seconds, and
    asked again up to `retries` times.
    """

    url: str
    model: str
    api_key_env: str | None = None
    concurrency: int = 4
    timeout: float = 60.0
    retries: int = 5

    def __post_init__(self) -> None:
        """Raise PlannerError that lists every setting that cannot be used."""
        problems = (
            []
            if self.model.strip()
            else ["--model: give the name by which the server knows the model"]
        )
        problems += _url_problems(self.url)
        bounds = (
            ("concurrency", self.concurrency, 1, 256),
            ("timeout", self.timeout, 0.1, 86400),
            ("retries", self.retries, 0, 100),
        )
        problems += [
            f"--{flag} {value}: must be between {low} and {high}"
            for flag, value, low, high in bounds
            if not low <= value <= high
        ]
        if problems:
            raise PlannerError("; ".join(problems))

    @property
    def root(self) -> str:
        """The URL that paths such as /chat/completions are appended to."""
        return self.url.strip().rstrip("/").removesuffix(CHAT).rstrip("/")

    @property
    def host(self) -> str:
        """Host and port, as tables name the server."""
        return urlsplit(self.root).netloc

    def api_key(self) -> str | None:
        """The key, if one is used. Raises PlannerError when the variable is not set or holds no
        header text.
        """
        if self.api_key_env is None:
            return None
        key = os.environ.get(self.api_key_env, "").strip()
        if not key:
            raise PlannerError(
                f"--api-key-env {self.api_key_env}: this environment variable is not set; export"
                " the server's key in it"
            )
        if not key.isascii() or not key.isprintable():
            raise PlannerError(
                f"--api-key-env {self.api_key_env}: holds characters that no key has; export the"
                " server's key in it"
            )
        return key


def _url_problems(url: str) -> list[str]:
    """What is wrong with a URL. It is not repeated where it may hold a password."""
    try:
        parts = urlsplit(url.strip())
        port_is_number = parts.port is None or parts.port > 0
    except ValueError:
        return ["--endpoint: no URL; give the API's root, such as http://127.0.0.1:8000/v1"]
    if parts.username or parts.password or parts.query or parts.fragment:
        return [
            "--endpoint: give the URL without user, password or query (it is written into"
            " manifests), and a key with --api-key-env"
        ]
    if parts.scheme not in ("http", "https") or not parts.hostname or not port_is_number:
        return [
            f"--endpoint {url}: no http URL; give the API's root, such as http://127.0.0.1:8000/v1"
        ]
    return []
